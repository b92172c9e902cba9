//! A window without a display.

use egui::{Color32, Context, FullOutput, Key, Modifiers, PointerButton, Pos2, TexturesDelta};
use egui_kittest::kittest::NodeT;
use egui_kittest::{Harness, TestRenderer};
use image::RgbaImage;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use viewer::app::App;
use viewer::cli::ViewerArgs;
use viewer::raster::Rasteriser;
use viewer::session::Session;
use viewer::view3d::Patience;

/// A window with an app in it.
pub(crate) struct Window {
    pub(crate) harness: Harness<'static, App>,
}

/// The path of a scene of the course.
pub(crate) fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../scenes/dae")
        .join(name)
}

/// A session with the flags `flags`, without a display. Its updates wait until all is done.
pub(crate) fn session(flags: &str, name: &str) -> Session {
    let mut arguments: Vec<OsString> = vec!["viewer".into()];
    arguments.extend(flags.split_whitespace().map(OsString::from));
    if !name.is_empty() {
        arguments.push(scene(name).into_os_string());
    }
    let args = ViewerArgs::parse_from(arguments).expect("the flags are valid");
    let mut session = Session::new(args.render, Arc::new(|| ()));
    session.patience = Patience::COMPLETE;
    session
}

impl Window {
    /// A window of 900 by 600 points with a scene, shown and settled.
    pub(crate) fn open(flags: &str, name: &str) -> Window {
        Window::with(session(flags, name), [900.0, 600.0])
    }

    pub(crate) fn with(session: Session, size: [f32; 2]) -> Window {
        let harness = Harness::builder()
            .with_size(size)
            .renderer(CpuRenderer::default())
            .with_max_steps(60)
            .build_ui_state(|ui, app: &mut App| app.ui(ui), App::new(session));
        let mut window = Window { harness };
        window.settle();
        window
    }

    pub(crate) fn session(&mut self) -> &mut Session {
        &mut self.harness.state_mut().session
    }

    /// The number of controls that a screen reader stops at, each of which must have a name.
    pub(crate) fn named_controls(&mut self, shown: &str) -> usize {
        self.settle();
        let mut controls = 0;
        for node in self.harness.root().children_recursive() {
            let node = node.accesskit_node();
            // A text that can be selected is its own name.
            let is_control = node.role() != egui::Role::Label;
            if !is_control || !node.data().supports_action(egui::accesskit::Action::Focus) {
                continue;
            }
            controls += 1;
            let name = node.label().unwrap_or_default();
            let (role, place) = (node.role(), node.bounding_box());
            // A screen reader reads "<" as "less than".
            let is_name = name.chars().any(char::is_alphabetic);
            assert!(is_name, "{name:?}, {role:?} at {place:?}, {shown}");
        }
        controls
    }

    /// Draws frames until nothing is in progress.
    pub(crate) fn settle(&mut self) {
        self.harness.run_steps(3);
    }

    /// Presses and releases a key.
    pub(crate) fn press(&mut self, key: Key) {
        self.press_with(Modifiers::NONE, key);
    }

    pub(crate) fn press_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.settle();
    }

    /// Drags the mouse.
    pub(crate) fn drag(&mut self, button: PointerButton, from: Pos2, to: Pos2) {
        let press = |pressed, pos| egui::Event::PointerButton {
            pos,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.harness.event(egui::Event::PointerMoved(from));
        self.harness.step();
        self.harness.event(press(true, from));
        self.harness.step();
        for i in 1..=4 {
            let at = from.lerp(to, i as f32 / 4.0);
            self.harness.event(egui::Event::PointerMoved(at));
            self.harness.step();
        }
        self.harness.event(press(false, to));
        self.settle();
    }

    /// Clicks with the left button.
    pub(crate) fn click(&mut self, at: Pos2) {
        self.harness.event(egui::Event::PointerMoved(at));
        self.harness.step();
        for pressed in [true, false] {
            self.harness.event(egui::Event::PointerButton {
                pos: at,
                button: PointerButton::Primary,
                pressed,
                modifiers: Modifiers::NONE,
            });
            self.harness.step();
        }
        self.settle();
    }

    /// Turns the wheel at a point.
    pub(crate) fn scroll(&mut self, at: Pos2, points: f32) {
        self.harness.event(egui::Event::PointerMoved(at));
        self.harness.step();
        self.harness.event(egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: egui::vec2(0.0, points),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Unknown,
            modifiers: Modifiers::NONE,
        });
        self.harness.run_steps(12);
    }
}

/// Draws with the CPU, for [`egui_kittest`].
#[derive(Default)]
struct CpuRenderer {
    rasteriser: Rasteriser,
}

impl TestRenderer for CpuRenderer {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        self.rasteriser.update(delta);
        delta.clear();
    }

    fn render(&mut self, ctx: &Context, output: &FullOutput) -> Result<RgbaImage, String> {
        let scale = output.pixels_per_point;
        let size = ctx.content_rect().size() * scale;
        let size = [size.x.round() as usize, size.y.round() as usize];
        let shapes = ctx.tessellate(output.shapes.clone(), scale);
        let picture = self.rasteriser.draw(size, scale, Color32::BLACK, &shapes);
        let bytes = picture.pixels.iter().flat_map(|pixel| pixel.to_array());
        RgbaImage::from_raw(size[0] as u32, size[1] as u32, bytes.collect())
            .ok_or_else(|| "the picture has another size".to_owned())
    }
}
