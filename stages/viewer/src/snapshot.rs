//! Pictures of the window without a display: `viewer --snapshot MODE OUT.png SCENE.dae`.

use crate::app::App;
use crate::command::Command;
use crate::raster::Rasteriser;
use crate::session::{Mode, Session};
use crate::tree_walk::Side;
use clap::ValueEnum;
use egui::{Color32, ColorImage, Context, Pos2, RawInput, Rect, Vec2};
use kit::Vec2 as Point;
use pathtracer::PartFile;
use std::path::Path;

/// What a snapshot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Shot {
    /// Edit mode, with a face selected
    Edit,
    /// The BVH visualiser, two steps below the root
    Bvh,
    /// A complete picture
    Render,
    /// The replay of a pixel in the middle of the picture
    Replay,
    /// The heat map of box tests
    Heat,
    /// The first failing case of the report
    Report,
    /// The list of keys
    Keys,
}

/// The most frames until everything is drawn.
const MAX_FRAMES: usize = 50;

/// The window's content after the commands of `shot`, drawn without a display.
pub fn take(session: Session, shot: Shot, size: [usize; 2]) -> ColorImage {
    let mut window = Headless::new(session, size);
    window.settle();
    let rect = Point::new(0.42, 0.42);
    let pixel = window
        .app
        .session
        .settings()
        .map(|settings| settings.film)
        .map(|film| Command::Inspect(film.w * 2 / 5, film.h * 2 / 5));
    let commands = match shot {
        Shot::Edit => {
            window.app.session.point_at_view(Some(rect));
            vec![Command::Select]
        }
        Shot::Bvh => vec![
            Command::Mode(Mode::Bvh),
            Command::Descend(Side::Left),
            Command::Descend(Side::Right),
        ],
        Shot::Render => vec![Command::Render],
        Shot::Replay => vec![Command::Render],
        Shot::Heat => vec![Command::Render, Command::NextHeat],
        Shot::Report => vec![Command::OpenCase(0)],
        Shot::Keys => vec![Command::ToggleHelp],
    };
    commands
        .into_iter()
        .for_each(|command| window.app.session.apply(command));
    let mut picture = window.settle();
    if let (Shot::Replay, Some(pixel)) = (shot, pixel) {
        window.app.session.apply(pixel);
        window.settle();
        for _ in 0..4 {
            window
                .app
                .session
                .apply(Command::StepTest { forward: true });
        }
        window
            .app
            .session
            .apply(Command::Orbit(Point::new(0.02, 0.0)));
        picture = window.settle();
    }
    picture
}

/// The window without a display: frames are drawn by [`Rasteriser`].
pub struct Headless {
    /// The content.
    pub app: App,
    ctx: Context,
    rasteriser: Rasteriser,
    size: [usize; 2],
    time: f64,
}

impl Headless {
    /// A window of `size` points and pixels.
    pub fn new(session: Session, size: [usize; 2]) -> Headless {
        Headless {
            app: App::new(session),
            ctx: Context::default(),
            rasteriser: Rasteriser::default(),
            size,
            time: 0.0,
        }
    }

    /// Draws frames until two are equal.
    pub fn settle(&mut self) -> ColorImage {
        let mut last = self.frame();
        for _ in 0..MAX_FRAMES {
            let next = self.frame();
            if next == last {
                return next;
            }
            last = next;
        }
        last
    }

    fn frame(&mut self) -> ColorImage {
        let [width, height] = self.size;
        let size = Vec2::new(width as f32, height as f32);
        self.time += 1.0;
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, size)),
            time: Some(self.time),
            ..RawInput::default()
        };
        let app = &mut self.app;
        let mut output = self.ctx.run_ui(input, |ui| app.ui(ui));
        self.rasteriser.update(&output.textures_delta);
        // What is handled has to be removed: egui checks it when a frame's output is dropped.
        output.textures_delta.clear();
        let primitives = self.ctx.tessellate(output.shapes, output.pixels_per_point);
        self.rasteriser.draw(
            self.size,
            output.pixels_per_point,
            Color32::BLACK,
            &primitives,
        )
    }
}

/// Writes a picture as a png file. The error is a sentence.
pub fn write(path: &Path, picture: &ColorImage) -> Result<(), String> {
    let failed = |why: &dyn std::fmt::Display| format!("cannot write {}: {why}", path.display());
    let bytes: Vec<u8> = picture
        .pixels
        .iter()
        .flat_map(|pixel| [pixel.r(), pixel.g(), pixel.b()])
        .collect();
    let part = PartFile::create(path).map_err(|why| failed(&why))?;
    let size = picture.size.map(|size| size as u32);
    picture_files::write_png(part.file(), &bytes, size).map_err(|why| failed(&why))?;
    part.finish().map_err(|why| failed(&why))
}
