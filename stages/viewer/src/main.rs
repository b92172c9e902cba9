//! The `viewer` program: opens the window, or writes a picture of it.

use base::errln;
use eframe::{CreationContext, Frame, NativeOptions, Storage};
use egui::{Ui, ViewportBuilder};
use pathtracer::args::has_display;
use std::env;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use viewer::app::App;
use viewer::cli::ViewerArgs;
use viewer::command::Command;
use viewer::remembered::Remembered;
use viewer::report::OpenReport;
use viewer::session::Session;
use viewer::snapshot;
use viewer::task::{Wake, silence_holes};
use viewer::view3d::Patience;

/// Exit code for invalid input, and if there is no display.
const BAD_INPUT: u8 = 2;

fn main() -> ExitCode {
    let args = match ViewerArgs::parse_from(env::args_os()) {
        Ok(args) => args,
        Err(why) => why.exit(),
    };
    match run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            errln!("error: {why}");
            ExitCode::from(BAD_INPUT)
        }
    }
}

fn run(args: &ViewerArgs) -> Result<(), String> {
    let shot = args.shot()?;
    // Invalid flags are errors before a window opens.
    args.render.light()?;
    let report = args.report.as_deref().map(OpenReport::load).transpose()?;
    if shot.is_none() && !has_display() {
        return Err(
            "there is no display to open a window on: set DISPLAY or WAYLAND_DISPLAY, or use pathtracer with -f"
                .to_owned(),
        );
    }
    silence_holes();
    let start = |wake: Wake, remembered: Option<Remembered>| {
        let mut session = Session::new(args.render.clone(), wake);
        if let Some(remembered) = remembered {
            session.restore(remembered);
        }
        if let Some(report) = report {
            session.set_report(report);
            session.apply(Command::OpenCase(0));
        }
        for picture in &args.compare {
            session.apply(Command::CompareWith(picture.clone()));
        }
        if args.light && session.dark() {
            session.apply(Command::ToggleTheme);
        }
        session
    };
    if let Some((shot, path)) = shot {
        let mut session = start(Arc::new(|| ()), None);
        session.patience = Patience::COMPLETE;
        let picture = snapshot::take(session, shot, args.window_size());
        return snapshot::write(&path, &picture);
    }
    let [width, height] = args.window_size().map(|size| size as f32);
    let options = NativeOptions {
        viewport: ViewportBuilder::default()
            .with_inner_size([width, height])
            .with_min_inner_size([480.0, 360.0]),
        // Without a graphics card every fragment is computed by the processor, and the window has no
        // gradients that would show steps.
        dithering: false,
        // A flag decides over what was remembered.
        persist_window: args.window.is_empty(),
        ..NativeOptions::default()
    };
    let create = |creation: &CreationContext<'_>| {
        let ctx = creation.egui_ctx.clone();
        let wake: Wake = Arc::new(move || ctx.request_repaint());
        let session = start(wake, creation.storage.and_then(remembered));
        let app = App::new(session).with_picker(choose_file);
        Ok(Box::new(Window { app }) as Box<dyn eframe::App>)
    };
    eframe::run_native("First Light", options, Box::new(create)).map_err(no_window)
}

/// Where the window's storage has what is remembered.
const STORAGE_KEY: &str = "first-light";

/// What the last window remembered; `None` at the first start, and if the text is damaged.
fn remembered(storage: &dyn Storage) -> Option<Remembered> {
    serde_json::from_str(&storage.get_string(STORAGE_KEY)?).ok()
}

/// The desktop's dialog for a file to open.
fn choose_file() -> Option<PathBuf> {
    let dialog = rfd::FileDialog::new()
        .set_title("Open a scene, a picture or a camera")
        .add_filter(
            "Scenes, pictures, cameras",
            &["dae", "png", "jpg", "exr", "hdr", "sums", "txt"],
        )
        .add_filter("All files", &["*"]);
    dialog.pick_file()
}

/// Why there is no window, as a sentence.
fn no_window(why: eframe::Error) -> String {
    let instead = "pathtracer with -f writes a picture without a window";
    match why {
        // Its text is a place in the source of a library.
        eframe::Error::WinitEventLoop(_) | eframe::Error::Winit(_) => {
            let displays = ["WAYLAND_DISPLAY", "DISPLAY"];
            let set = displays.iter().filter_map(|name| {
                let value = env::var(name).ok().filter(|value| !value.is_empty())?;
                Some(format!("{name}={value}"))
            });
            let set: Vec<String> = set.collect();
            format!(
                "cannot open a window: no display answers at {}. Is the variable right, and is the \
                 display yours? {instead}",
                set.join(" and ")
            )
        }
        why => format!("cannot open a window: {why}; {instead}"),
    }
}

/// The window, as eframe sees it.
struct Window {
    app: App,
}

impl eframe::App for Window {
    fn save(&mut self, storage: &mut dyn Storage) {
        if let Ok(text) = serde_json::to_string(&self.app.session.remembered()) {
            storage.set_string(STORAGE_KEY, text);
        }
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut Frame) {
        self.app.ui(ui);
    }
}
