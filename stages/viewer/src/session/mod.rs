//! The state of the window, without the window: what it shows, and what commands do to it.
//!
//! Everything here works without a display. [`Session::apply`] executes a command;
//! [`Session::update`] takes the results of background work. Reading order: this file, `state` (what
//! is read of it), then `loading` (scenes), `cameras`, `kept_cameras`, `selecting` and `editing`,
//! `tree`, `rendering`, `heat`, `comparison`, `pointer`, `reports`, `files` (what is written).

mod cameras;
mod comparison;
mod cutting;
mod editing;
mod files;
mod heat;
mod kept_cameras;
mod loading;
mod luminance;
mod pointer;
pub mod progress;
mod rendering;
mod reports;
mod selecting;
mod state;
mod tree;
mod typed_path;

pub use comparison::{Compared, Comparison};
pub use files::Saved;
pub use heat::{Heat, HeatKind};
pub use loading::Loading;

use rendering::CameraRays;

use crate::command::Command;
use crate::compare::Reference;
use crate::cut::Cut;
use crate::features::MissingFeatures;
use crate::inspector::Inspector;
use crate::luminance_view::LuminanceView;
use crate::orbit::Orbit;
use crate::path_use::PathUse;
use crate::picture_pair::PairDisplay;
use crate::remembered::KeptCamera;
use crate::render_control::RenderControl;
use crate::report::OpenReport;
use crate::scene_data::SceneData;
use crate::settings::RenderSettings;
use crate::task::{Task, Wake};
use crate::topology::Element;
use crate::tree_walk::{NodeStatistics, TreeWalk};
use crate::view3d::{Patience, View3d};
use editing::{Edit, FoundTopology};
use kit::Vec2;
use pathtracer::args::Args;
use pathtracer::tone::Tone;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What the window is for at the moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// The scene: select and move its parts.
    Edit,
    /// The tree over the scene.
    Bvh,
    /// The picture.
    Render,
    /// The failing cases of a report.
    Report,
}

impl Mode {
    /// All modes.
    pub const ALL: [Mode; 4] = [Mode::Edit, Mode::Bvh, Mode::Render, Mode::Report];

    /// The name in the window.
    pub fn name(self) -> &'static str {
        match self {
            Mode::Edit => "Edit",
            Mode::Bvh => "BVH",
            Mode::Render => "Render",
            Mode::Report => "Report",
        }
    }
}

/// The state of the window.
pub struct Session {
    /// The flags of the program.
    args: Args,
    wake: Wake,
    /// How radiance becomes the bytes of pictures.
    pub tone: Tone,
    /// How long an update may wait for background work.
    pub patience: Patience,
    /// Where files are written.
    pub output_folder: PathBuf,
    scene: Option<Arc<SceneData>>,
    loading: Option<Loading>,
    /// The scenes that were open, the newest first.
    recent: Vec<PathBuf>,
    last_look_at_file: Option<Instant>,
    mode: Mode,
    /// The render camera, which edit and BVH mode move.
    orbit: Option<Orbit>,
    /// The camera of the view of the replay in render mode.
    spy: Option<Orbit>,
    settings: Option<RenderSettings>,
    edges: bool,
    cut: Option<Cut>,
    topology: Option<FoundTopology>,
    selection: Option<Element>,
    edit: Edit,
    walk: TreeWalk,
    shows_wide: bool,
    statistics: Vec<(Arc<SceneData>, NodeStatistics)>,
    render: Option<RenderControl>,
    camera_rays: CameraRays,
    cell_mode: bool,
    show_rate: bool,
    heat: Heat,
    luminance: LuminanceView,
    comparison: Option<Comparison>,
    /// The pictures to compare with.
    kept: Vec<Arc<Reference>>,
    /// The number of comparisons so far.
    comparisons: u64,
    /// The replay of a pixel.
    pub inspector: Inspector,
    report: Option<OpenReport>,
    finding_features: Option<Task<MissingFeatures>>,
    missing: MissingFeatures,
    /// The picture of the 3D view.
    pub view: View3d,
    pointer_in_view: Option<Vec2>,
    pointer_pixel: Option<(u32, u32)>,
    message: String,
    /// Why the last scene was not loaded: the whole text, with the line of the file.
    problem: Option<String>,
    /// The scenes that come with the course.
    course_scenes: Vec<PathBuf>,
    saved: Vec<Saved>,
    kept_cameras: Vec<KeptCamera>,
    asks_for_file: bool,
    /// The path that is being typed.
    typed_path: Option<(PathUse, String)>,
    overlay: bool,
    help: bool,
    dark: bool,
    asks_to_quit: bool,
    quits: bool,
}

impl Session {
    /// A session with the flags `args`, which opens their scene, if there is one. `wake` is called
    /// when background work has something to show.
    pub fn new(args: Args, wake: Wake) -> Session {
        let path = args.scene.clone();
        let mut session = Session {
            tone: args.tone(),
            args,
            wake,
            patience: Patience::WINDOW,
            output_folder: PathBuf::new(),
            scene: None,
            loading: None,
            recent: Vec::new(),
            last_look_at_file: None,
            mode: Mode::Edit,
            orbit: None,
            spy: None,
            settings: None,
            edges: true,
            cut: None,
            topology: None,
            selection: None,
            edit: Edit::default(),
            walk: TreeWalk::default(),
            shows_wide: false,
            statistics: Vec::new(),
            render: None,
            camera_rays: CameraRays::default(),
            cell_mode: false,
            show_rate: false,
            heat: Heat::default(),
            luminance: LuminanceView::default(),
            comparison: None,
            kept: Vec::new(),
            comparisons: 0,
            inspector: Inspector::default(),
            report: None,
            finding_features: None,
            missing: MissingFeatures::default(),
            view: View3d::default(),
            pointer_in_view: None,
            pointer_pixel: None,
            message: String::new(),
            problem: None,
            course_scenes: loading::course_scenes(),
            saved: Vec::new(),
            kept_cameras: Vec::new(),
            asks_for_file: false,
            typed_path: None,
            overlay: true,
            help: false,
            dark: true,
            asks_to_quit: false,
            quits: false,
        };
        let task = Task::spawn(Arc::clone(&session.wake), |_| MissingFeatures::find());
        session.finding_features = Some(task);
        if !path.as_os_str().is_empty() {
            session.open(path);
        }
        session
    }

    /// Executes a command. What it cannot do is said in [`Session::message`].
    pub fn apply(&mut self, command: Command) {
        match command {
            Command::Mode(mode) => {
                // What was said of another mode is not true here: "Selected vertex 7".
                if self.mode != mode {
                    self.say("");
                }
                self.mode = mode;
            }
            Command::Render => self.start_render(),
            Command::Orbit(by) => self.with_camera(|orbit| {
                orbit.rotate(
                    cameras::ROTATION_PER_VIEW * by.x,
                    cameras::ROTATION_PER_VIEW * by.y,
                );
            }),
            Command::Pan(by) => self.with_camera(|orbit| orbit.pan(by.x, by.y)),
            Command::Zoom(steps) => self.with_camera(|orbit| orbit.zoom(steps)),
            Command::ResetView => self.with_camera(Orbit::reset),
            Command::ToggleEdges => self.edges = !self.edges,
            Command::NextCut => self.next_cut(),
            Command::FlipCut => self.flip_cut(),
            Command::MoveCut(at) => self.move_cut(at),
            Command::Select => self.select(),
            Command::SelectNext { kind, forward } => self.select_next(kind, forward),
            Command::MoveVertex(by) => self.move_vertex(by),
            Command::NudgeVertex(by) => {
                self.move_vertex(by);
                self.edit.end_move();
            }
            Command::EndMove => self.edit.end_move(),
            Command::UndoMove => self.undo_move(),
            Command::RedoMove => self.redo_move(),
            Command::Descend(side) => self.with_tree(|walk, tree| walk.descend(tree, side)),
            Command::Ascend => self.with_tree(|walk, _| walk.ascend()),
            Command::GoToDepth(depth) => {
                self.with_tree(|walk, tree| walk.go_to_depth(tree, depth));
            }
            Command::GoToNode(node) => self.with_tree(|walk, tree| walk.go_to(tree, node)),
            Command::ToggleWideTree => self.toggle_wide_tree(),
            Command::Samples(change) => self.change_settings(|s| s.change_samples(change)),
            Command::LightSamples(change) => {
                self.change_settings(|s| s.change_light_samples(change));
            }
            Command::Depth(change) => self.change_settings(|s| s.change_depth(change)),
            Command::ToggleHemisphere => {
                self.change_settings(RenderSettings::toggle_hemisphere);
            }
            Command::ToggleMis => self.change_settings(RenderSettings::toggle_mis),
            Command::ToggleAdaptive => self.change_settings(RenderSettings::toggle_adaptive),
            Command::NextSampler => self.change_settings(RenderSettings::next_sampler),
            Command::ToggleCell => self.toggle_cell(),
            Command::SetCell(cell) => self.set_cell(cell),
            Command::StopOrResume => self.stop_or_resume(),
            Command::AddSamples => self.add_samples(),
            Command::ToggleRate => self.toggle_rate(),
            Command::NextHeat => self.next_heat(),
            Command::ToggleFalseColor => self.toggle_false_color(),
            Command::ShowLayer(place) => self.show_layer(place),
            Command::GoToCostliest => self.go_to_costliest(),
            Command::KeepForComparison => self.keep_for_comparison(),
            Command::CompareWith(path) => self.compare_with_file(&path),
            Command::EndComparison => self.comparison = None,
            Command::Flicker => self.with_pair(PairDisplay::toggle_flicker),
            Command::ShowPair(view) => self.with_pair(|display| display.view = view),
            Command::NextPairView => self.with_pair(|display| display.view = display.view.next()),
            Command::NextCompared => self.next_compared(),
            Command::SwapCompared => self.swap_compared(),
            Command::Inspect(x, y) => self.inspect(x, y),
            Command::InspectNext(x, y) => self.inspect_next(x, y),
            Command::InspectUnderPointer => self.inspect_under_pointer(),
            Command::StepTest { forward } => match self.walked_case() {
                Some(opened) => opened.step_test(forward),
                None => self.inspector.step_test(forward),
            },
            Command::StepRay { forward } => self.inspector.step_ray(forward),
            Command::SelectSample(sample) => self.inspector.select_sample(sample),
            Command::SelectRay(ray) => self.inspector.select_ray(ray),
            Command::SelectTest(test) => self.inspector.go_to_test(test),
            Command::SaveRayAsTest => self.save_ray_as_test(),
            Command::CloseInspector => {
                self.inspector.close();
                self.spy = None;
            }
            Command::Screenshot => self.screenshot(),
            Command::DumpCamera => self.dump_camera(),
            Command::ToggleOverlay => self.overlay = !self.overlay,
            Command::ToggleTheme => self.dark = !self.dark,
            Command::ToggleHelp => self.help = !self.help,
            Command::KeepCamera => self.keep_camera(),
            Command::NextKeptCamera => self.next_kept_camera(),
            Command::GoToKeptCamera(place) => self.go_to_kept_camera(place),
            Command::ForgetCamera(place) => self.forget_camera(place),
            Command::LoadCamera(path) => self.load_camera(&path),
            Command::ChooseFile => self.asks_for_file = true,
            Command::UseTypedPath => self.use_typed_path(),
            Command::SaveScene => self.ask_where_to_save(),
            Command::Open(path) => self.open(path),
            Command::Reload => self.reload(),
            Command::CloseProblem => self.problem = None,
            Command::ShowReport => self.show_report(),
            Command::OpenCase(case) => self.open_case(case),
            Command::NeighbourCase { forward } => self.open_neighbour(forward),
            Command::ShowPart(part) => {
                if let Some(opened) = self.opened_case_mut() {
                    opened.show(part);
                }
            }
            Command::GoToEvent(step) => {
                if let Some(opened) = self.opened_case_mut() {
                    opened.go_to_event(step);
                }
            }
            Command::FrameEvent(step) => {
                if let Some(opened) = self.opened_case_mut() {
                    opened.go_to_event(step);
                    opened.orbit = None;
                }
            }
            Command::SaveCaseAsTest => self.save_case_as_test(),
            Command::Escape => self.escape(),
            Command::SaveAndQuit => {
                self.screenshot();
                self.quits = true;
            }
            Command::Quit => self.quits = true,
            Command::DoNotQuit => self.asks_to_quit = false,
        }
    }

    /// Takes the results of background work. Returns whether more is to come.
    pub fn update(&mut self, now: Instant) -> bool {
        let wait = if self.patience.always_sharp {
            self.patience.per_frame
        } else {
            Duration::ZERO
        };
        if let Some(Ok(missing)) = self
            .finding_features
            .as_ref()
            .and_then(|task| task.wait(wait))
        {
            self.missing = missing;
            self.finding_features = None;
        }
        self.update_loading(now, wait);
        self.update_editing(wait);
        if let Some(render) = &mut self.render {
            render.update(wait);
        }
        self.update_heat(wait);
        self.inspector.update(wait);
        self.update_camera_rays(wait);
        let runs_case = self.update_case(wait);
        let shows_rays = self.inspector.inspected().is_some() || !self.camera_rays().is_empty();
        if shows_rays && self.spy.is_none() {
            self.spy = self.orbit.map(cameras::beside);
        }
        self.loading.is_some()
            || runs_case
            || self.edit.is_rebuilding()
            || self.heat.is_counting()
            || self.inspector.running().is_some()
            || self.render.as_ref().is_some_and(RenderControl::is_running)
    }

    /// Closes what is open; asks before a render in progress is lost.
    fn escape(&mut self) {
        let is_rendering = self.render.as_ref().is_some_and(RenderControl::is_running);
        if self.typed_path.is_some() {
            self.typed_path = None;
        } else if self.help {
            self.help = false;
        } else if is_rendering && !self.asks_to_quit {
            self.asks_to_quit = true;
        } else {
            self.quits = true;
        }
    }

    /// The window was asked to close, by its frame. Returns whether it may close now.
    pub fn may_close(&mut self) -> bool {
        if !self.quits {
            self.help = false;
            self.escape();
        }
        self.quits
    }

    /// Changes how the visible pair of pictures is shown.
    fn with_pair(&mut self, change: impl FnOnce(&mut PairDisplay)) {
        if let Some(opened) = self.walked_case() {
            change(&mut opened.display);
        } else if let Some(comparison) = &mut self.comparison {
            change(&mut comparison.display);
        }
    }
}
