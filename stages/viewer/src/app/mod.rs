//! Draws the session with egui, and turns its input into commands.
//!
//! Reading order: this file (the layout), `input` (keys and files), `view_panel` (the 3D view and
//! its mouse), `lines` with `scene_lines` and `ray_lines` (grid, boxes, rays), `picture_panel` with
//! `zoom` and `single_picture` (the picture and its mouse), `pair_view` (two pictures), `divider`
//! (between them and the view), `case_panel` with `case_lines` (a case of a report), `side_panel`
//! with `settings_panel`, `compare_panel`, `tree_panel`, `inspector_panel` (with
//! `sample_plots`) and `report_panel`,
//! `text` (short numbers), `scale` (legends and the histogram), `problem_panel` (a scene that is
//! not loaded), `sheets` (help, questions), `file_dialog`.

mod case_lines;
mod case_panel;
mod colors;
mod compare_panel;
mod divider;
mod file_dialog;
mod input;
mod inspector_panel;
mod lines;
mod pair_view;
mod picture_panel;
mod problem_panel;
mod ray_lines;
mod report_panel;
mod sample_lines;
mod sample_plots;
mod scale;
mod scene_lines;
mod settings_panel;
mod sheets;
mod side_panel;
mod single_picture;
mod text;
mod tree_panel;
mod view_panel;
mod zoom;

pub use file_dialog::Picker;

use crate::command::Command;
use crate::features::Feature;
use crate::session::{Mode, Saved, Session};
use crate::snapshot;
use egui::{Align, Key, Layout, ProgressBar, Response, RichText, Role, Stroke, Ui, WidgetInfo};
use std::sync::{Arc, Mutex};
use std::time::Instant;

/// The window's content.
pub struct App {
    /// The state.
    pub session: Session,
    view: view_panel::ViewPanel,
    picture: picture_panel::PicturePanel,
    case: case_panel::CasePanel,
    divider: divider::Divider,
    dialog: file_dialog::FileDialog,
    frames: FrameRate,
    title: String,
    /// Why the last screenshot of the window was not written.
    failed_screenshot: Arc<Mutex<Option<String>>>,
}

/// The least width of the panel at the side.
const SIDE_WIDTH: f32 = 240.0;
/// The widths of the panel at the side before it is dragged.
const FIRST_SIDE_WIDTH: std::ops::RangeInclusive<f32> = 270.0..=340.0;

impl App {
    /// Draws `session`.
    pub fn new(session: Session) -> App {
        App {
            session,
            view: Default::default(),
            picture: Default::default(),
            case: Default::default(),
            divider: Default::default(),
            dialog: Default::default(),
            frames: FrameRate::default(),
            title: String::new(),
            failed_screenshot: Arc::default(),
        }
    }

    /// Lets the user choose files with `picker`.
    pub fn with_picker(mut self, picker: Picker) -> App {
        self.dialog.picker = Some(picker);
        self
    }

    /// Draws one frame, and executes the commands of its input.
    pub fn ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let theme = if self.session.dark() {
            egui::Theme::Dark
        } else {
            egui::Theme::Light
        };
        ctx.set_theme(theme);
        colors::set_style(&ctx);
        if let Some(seconds) = self.frames.next(ctx.input(|input| input.time)) {
            self.session.view.frame(seconds);
        }
        let mut commands = input::commands(&ctx, self.session.mode());
        commands
            .drain(..)
            .for_each(|command| self.session.apply(command));
        let woken = ctx.clone();
        let wake = Arc::new(move || woken.request_repaint());
        self.dialog.update(&mut self.session, wake);
        let mut is_busy = self.session.update(Instant::now());

        egui::Panel::top("top").show(ui, |ui| self.top_bar(ui, &mut commands));
        egui::Panel::bottom("bottom").show(ui, |ui| self.status_bar(ui));
        let width = ui.available_width();
        let first = (0.27 * width).clamp(*FIRST_SIDE_WIDTH.start(), *FIRST_SIDE_WIDTH.end());
        egui::Panel::right("side")
            .resizable(true)
            .default_size(first)
            .size_range(SIDE_WIDTH..=(0.7 * width).max(SIDE_WIDTH))
            .show(ui, |ui| {
                side_panel::show(ui, &mut self.session, &mut commands);
            });
        if let Some(problem) = self.session.problem() {
            problem_panel::show(ui, problem, &mut commands);
        }
        egui::CentralPanel::default()
            .frame(egui::Frame::new())
            .show(ui, |ui| is_busy |= self.central(ui, &mut commands));
        sheets::show(&ctx, &mut self.session, &mut commands);
        commands
            .drain(..)
            .for_each(|command| self.session.apply(command));
        if is_busy {
            // Background work wakes the window; this moves what shows time.
            ctx.request_repaint_after(std::time::Duration::from_millis(30));
        }
        self.talk_to_window(&ctx);
    }

    fn central(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) -> bool {
        // Without a display frames take no time.
        let is_timed = !self.session.patience.always_sharp;
        let fps = if is_timed { self.frames.rate() } else { 0.0 };
        let rect = ui.available_rect_before_wrap();
        let shows_view = matches!(self.session.mode(), Mode::Edit | Mode::Bvh);
        if !shows_view {
            ui.painter().rect_filled(rect, 0.0, colors::backdrop(ui));
        }
        if self.session.mode() == Mode::Report {
            self.case.show(ui, rect, &mut self.session, commands);
            return false;
        }
        if self.session.mode() != Mode::Render {
            return self.view.show(ui, rect, &mut self.session, commands, fps);
        }
        if !self.session.camera_rays().is_empty() {
            // There is no picture, but there are camera rays.
            return self.view.show(ui, rect, &mut self.session, commands, fps);
        }
        if self.session.inspector.inspected().is_none() {
            self.picture.show(ui, rect, &mut self.session, commands);
            return false;
        }
        // The picture, and beside it the rays of the pixel in 3D.
        let [picture, view] = self.divider.show(ui, rect);
        self.picture.show(ui, picture, &mut self.session, commands);
        self.view.show(ui, view, &mut self.session, commands, fps)
    }

    fn top_bar(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            let modes = [
                (Mode::Edit, "E"),
                (Mode::Bvh, "V"),
                (Mode::Render, "R"),
                (Mode::Report, "Y"),
            ];
            let has_report = self.session.report().is_some();
            let modes = modes
                .into_iter()
                .filter(|(m, _)| *m != Mode::Report || has_report);
            for (mode, key) in modes {
                let text = RichText::new(format!("{} ({key})", mode.name())).strong();
                let selected = self.session.mode() == mode;
                // Without camera rays and intersections there is no picture to render.
                let why = self
                    .session
                    .missing()
                    .why(Feature::Pictures)
                    .filter(|_| mode == Mode::Render)
                    .map(ToString::to_string);
                let button = egui::Button::selectable(selected, text);
                let mut response = ui.add_enabled(why.is_none(), button);
                if let Some(why) = why {
                    response = response.on_disabled_hover_text(why);
                }
                if response.clicked() {
                    commands.push(match mode {
                        Mode::Render if self.session.render().is_none() => Command::Render,
                        Mode::Report => Command::ShowReport,
                        mode => Command::Mode(mode),
                    });
                }
            }
            ui.separator();
            match self.session.scene() {
                Some(scene) => ui.label(scene.name()),
                None => ui.weak("no scene"),
            };
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if ui.button("Keys (?)").clicked() {
                    commands.push(Command::ToggleHelp);
                }
                let other = if self.session.dark() {
                    "Light (L)"
                } else {
                    "Dark (L)"
                };
                if ui.button(other).clicked() {
                    commands.push(Command::ToggleTheme);
                }
                if ui.button("Open (Ctrl O)").clicked() {
                    commands.push(Command::ChooseFile);
                }
                if ui.button("Save (S)").clicked() {
                    commands.push(Command::Screenshot);
                }
            });
        });
    }

    fn status_bar(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if let Some(loading) = self.session.loading() {
                let name = loading.path.file_name().unwrap_or_default();
                let seconds = loading.since.elapsed().as_secs_f64();
                if let Some((step, share)) = loading.progress.now() {
                    let bar = ProgressBar::new(share as f32).desired_width(160.0);
                    ui.add(bar.text(format!("{:.0} %", 100.0 * share)));
                    let name = name.to_string_lossy();
                    ui.label(format!("Loading {name}: {step}, {seconds:.1} s"));
                }
                return;
            }
            ui.add(egui::Label::new(self.session.message()).truncate());
        });
    }

    /// Title, screenshots and closing, which the window does.
    fn talk_to_window(&mut self, ctx: &egui::Context) {
        let title = match self.session.scene() {
            Some(scene) => format!("{} - First Light", scene.name()),
            None => "First Light".to_owned(),
        };
        if title != self.title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
        let failed = self
            .failed_screenshot
            .lock()
            .expect("no thread panics here")
            .take();
        if let Some(why) = failed {
            self.session.say(why);
        }
        for saved in self.session.take_saved() {
            if let Saved::Window(path) = saved {
                let failed = Arc::clone(&self.failed_screenshot);
                ctx.request_screenshot(move |picture| {
                    if let Err(why) = snapshot::write(&path, &picture) {
                        *failed.lock().expect("no thread panics here") = Some(why);
                    }
                });
            }
        }
        if ctx.input(|input| input.viewport().close_requested()) && !self.session.may_close() {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
        }
        if self.session.quits() {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
    }
}

/// The number of frames in a second, smoothed.
#[derive(Default)]
struct FrameRate {
    last: Option<f64>,
    seconds: f64,
}

impl FrameRate {
    /// A frame starts at this time. Returns the seconds since the last one started.
    fn next(&mut self, time: f64) -> Option<f64> {
        let seconds = self.last.map(|last| (time - last).max(1e-4));
        // A pause is no slow frame.
        if let Some(seconds) = seconds.filter(|seconds| *seconds < 0.5) {
            self.seconds += 0.1 * (seconds - self.seconds);
        }
        self.last = Some(time);
        seconds
    }

    fn rate(&self) -> f64 {
        if self.seconds > 0.0 {
            1.0 / self.seconds
        } else {
            0.0
        }
    }
}

/// A button with its key.
fn key_button(ui: &mut Ui, label: &str, key: Key) -> bool {
    ui.button(format!("{label} ({})", key.symbol_or_name()))
        .clicked()
}

/// A small button with an arrow; screen readers read its `name`.
fn arrow_button(ui: &mut Ui, arrow: &str, name: &str) -> Response {
    let response = ui.small_button(arrow);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    response
}

/// Adds check boxes with an outline: without it an empty one is hardly seen.
fn outlined<R>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    let outline = Stroke::new(1.0, colors::line(ui));
    let before = std::mem::replace(&mut ui.visuals_mut().widgets.inactive.bg_stroke, outline);
    let added = add(ui);
    ui.visuals_mut().widgets.inactive.bg_stroke = before;
    added
}
