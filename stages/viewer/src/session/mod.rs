//! The state of the window, without the window: what it shows, and what commands do to it.
//!
//! Everything here works without a display. [`Session::apply`] executes a command;
//! [`Session::update`] takes the results of background work. Reading order: this file, then
//! `loading` (scenes), `rendering`, `editing`, `pointer`, `files` (what is written).

mod editing;
mod files;
mod loading;
mod pointer;
mod rendering;

pub use files::Saved;
pub use rendering::{Comparison, Heat, HeatKind};

use loading::Loading;
use rendering::CameraRays;

use crate::command::Command;
use crate::features::MissingFeatures;
use crate::inspector::Inspector;
use crate::orbit::Orbit;
use crate::render_control::RenderControl;
use crate::report::OpenReport;
use crate::scene_data::SceneData;
use crate::settings::RenderSettings;
use crate::task::{Task, Wake};
use crate::topology::Element;
use crate::tree_walk::{NodeStatistics, TreeWalk};
use crate::view_picture::{ViewRequest, ViewStyle};
use crate::view3d::{Patience, View3d};
use editing::{Edit, FoundTopology};
use kit::{FilmSize, Vec2};
use pathtracer::args::Args;
use scenes::placement::for_film;
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
}

impl Mode {
    /// All modes.
    pub const ALL: [Mode; 3] = [Mode::Edit, Mode::Bvh, Mode::Render];

    /// The name in the window.
    pub fn name(self) -> &'static str {
        match self {
            Mode::Edit => "Edit",
            Mode::Bvh => "BVH",
            Mode::Render => "Render",
        }
    }
}

/// The state of the window.
pub struct Session {
    /// The flags of the program.
    args: Args,
    wake: Wake,
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
    topology: Option<FoundTopology>,
    selection: Option<Element>,
    edit: Edit,
    walk: TreeWalk,
    statistics: Vec<(Arc<SceneData>, NodeStatistics)>,
    render: Option<RenderControl>,
    camera_rays: CameraRays,
    cell_mode: bool,
    show_rate: bool,
    heat: Heat,
    comparison: Option<Comparison>,
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
    saved: Vec<Saved>,
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
            topology: None,
            selection: None,
            edit: Edit::default(),
            walk: TreeWalk::default(),
            statistics: Vec::new(),
            render: None,
            camera_rays: CameraRays::default(),
            cell_mode: false,
            show_rate: false,
            heat: Heat::default(),
            comparison: None,
            inspector: Inspector::default(),
            report: None,
            finding_features: None,
            missing: MissingFeatures::default(),
            view: View3d::default(),
            pointer_in_view: None,
            pointer_pixel: None,
            message: String::new(),
            saved: Vec::new(),
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
            Command::Mode(mode) => self.mode = mode,
            Command::Render => self.start_render(),
            Command::Orbit(by) => self.with_camera(|orbit| {
                orbit.rotate(ROTATION_PER_VIEW * by.x, ROTATION_PER_VIEW * by.y);
            }),
            Command::Pan(by) => self.with_camera(|orbit| orbit.pan(by.x, by.y)),
            Command::Zoom(steps) => self.with_camera(|orbit| orbit.zoom(steps)),
            Command::ResetView => self.with_camera(Orbit::reset),
            Command::ToggleEdges => self.edges = !self.edges,
            Command::Select => self.select(),
            Command::MoveVertex(by) => self.move_vertex(by),
            Command::EndMove => self.edit.end_move(),
            Command::UndoMove => self.undo_move(),
            Command::Descend(side) => self.with_tree(|walk, tree| walk.descend(tree, side)),
            Command::Ascend => self.walk.ascend(),
            Command::GoToDepth(depth) => {
                self.with_tree(|walk, tree| walk.go_to_depth(tree, depth));
            }
            Command::GoToNode(node) => self.with_tree(|walk, tree| walk.go_to(tree, node)),
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
            Command::ToggleRate => self.show_rate = !self.show_rate,
            Command::NextHeat => self.next_heat(),
            Command::GoToDearest => self.go_to_dearest(),
            Command::KeepForComparison => self.keep_for_comparison(),
            Command::CompareWith(path) => self.compare_with(&path),
            Command::EndComparison => self.comparison = None,
            Command::Flicker => {
                if let Some(comparison) = &mut self.comparison {
                    comparison.flickers = !comparison.flickers;
                }
            }
            Command::Inspect(x, y) => self.inspect(x, y),
            Command::InspectUnderPointer => self.inspect_under_pointer(),
            Command::StepTest { forward } => self.inspector.step_test(forward),
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
            Command::Open(path) => self.open(path),
            Command::Reload => self.reload(),
            Command::OpenCase(case) => self.open_case(case),
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
        let shows_rays = self.inspector.inspected().is_some() || !self.camera_rays().is_empty();
        if shows_rays && self.spy.is_none() {
            self.spy = self.orbit.map(beside);
        }
        self.loading.is_some()
            || self.edit.is_rebuilding()
            || self.heat.is_counting()
            || self.inspector.running().is_some()
            || self.render.as_ref().is_some_and(RenderControl::is_running)
    }

    /// Closes what is open; asks before a render in progress is lost.
    fn escape(&mut self) {
        let is_rendering = self.render.as_ref().is_some_and(RenderControl::is_running);
        if self.help {
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

    fn with_camera(&mut self, change: impl FnOnce(&mut Orbit)) {
        // In render mode the render camera stays; the view of the replay moves.
        let camera = match self.mode {
            Mode::Edit | Mode::Bvh => self.orbit.as_mut(),
            Mode::Render => self.spy.as_mut(),
        };
        if let Some(camera) = camera {
            change(camera);
        }
    }

    fn with_tree(&mut self, change: impl FnOnce(&mut TreeWalk, &kit::Bvh)) {
        if let Some(tree) = self.scene.as_ref().and_then(|scene| scene.bvh()) {
            change(&mut self.walk, tree);
        }
    }

    /// The scene.
    pub fn scene(&self) -> Option<&Arc<SceneData>> {
        self.scene.as_ref()
    }

    /// The file that is being read, and since when.
    pub fn loading(&self) -> Option<(&PathBuf, Instant)> {
        self.loading
            .as_ref()
            .map(|loading| (&loading.path, loading.since))
    }

    /// The scenes that were open, the newest first.
    pub fn recent(&self) -> &[PathBuf] {
        &self.recent
    }

    /// The mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The render camera.
    pub fn orbit(&self) -> Option<&Orbit> {
        self.orbit.as_ref()
    }

    /// The camera of the 3D view that is visible.
    pub fn view_orbit(&self) -> Option<&Orbit> {
        match self.mode {
            Mode::Render => self.spy.as_ref(),
            Mode::Edit | Mode::Bvh => self.orbit.as_ref(),
        }
    }

    /// The settings of renders.
    pub fn settings(&self) -> Option<&RenderSettings> {
        self.settings.as_ref()
    }

    /// The selected element.
    pub fn selection(&self) -> Option<Element> {
        self.selection
    }

    /// The selected node of the tree.
    pub fn walk(&self) -> &TreeWalk {
        &self.walk
    }

    /// The render in progress, or the last one.
    pub fn render(&self) -> Option<&RenderControl> {
        self.render.as_ref()
    }

    /// Whether a drag in the picture selects a cell.
    pub fn cell_mode(&self) -> bool {
        self.cell_mode
    }

    /// Whether the picture shows the number of samples of each pixel.
    pub fn shows_rate(&self) -> bool {
        self.show_rate
    }

    /// The heat map.
    pub fn heat(&self) -> &Heat {
        &self.heat
    }

    /// The comparison with another picture.
    pub fn comparison(&self) -> Option<&Comparison> {
        self.comparison.as_ref()
    }

    /// The comparison, to move its wipe.
    pub fn comparison_mut(&mut self) -> Option<&mut Comparison> {
        self.comparison.as_mut()
    }

    /// The report of a grader and the opened case.
    pub fn report(&self) -> Option<&OpenReport> {
        self.report.as_ref()
    }

    /// Shows a report of the grader.
    pub fn set_report(&mut self, report: OpenReport) {
        self.report = Some(report);
    }

    /// The report, to move the camera of its case.
    pub fn report_mut(&mut self) -> Option<&mut OpenReport> {
        self.report.as_mut()
    }

    /// The statistics of the selected node. They are computed once for each node.
    pub fn node_statistics(&mut self) -> Option<NodeStatistics> {
        self.statistics_of(self.walk.node())
    }

    /// The statistics of the whole tree.
    pub fn root_statistics(&mut self) -> Option<NodeStatistics> {
        self.statistics_of(0)
    }

    fn statistics_of(&mut self, node: u32) -> Option<NodeStatistics> {
        let scene = self.scene.as_ref()?;
        let is_known = |(of, known): &&(Arc<SceneData>, NodeStatistics)| {
            Arc::ptr_eq(of, scene) && known.node == node
        };
        if let Some((_, known)) = self.statistics.iter().find(is_known) {
            return Some(known.clone());
        }
        let statistics = NodeStatistics::of(scene.bvh()?, node)?;
        // Those of the root and of the selected node.
        self.statistics
            .retain(|(of, known)| Arc::ptr_eq(of, scene) && known.node == 0);
        self.statistics
            .push((Arc::clone(scene), statistics.clone()));
        Some(statistics)
    }

    pub(crate) fn take_report(&mut self) -> Option<OpenReport> {
        self.report.take()
    }

    /// What does not work because a task is not written yet.
    pub fn missing(&self) -> &MissingFeatures {
        &self.missing
    }

    /// What happened last, as a sentence.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Says what happened.
    pub fn say(&mut self, message: impl Into<String>) {
        self.message = message.into();
    }

    /// Whether the text in the view is visible.
    pub fn overlay(&self) -> bool {
        self.overlay
    }

    /// Whether the list of keys is visible.
    pub fn help(&self) -> bool {
        self.help
    }

    /// Whether the window is dark.
    pub fn dark(&self) -> bool {
        self.dark
    }

    /// Whether the window asks what to do with the render in progress.
    pub fn asks_to_quit(&self) -> bool {
        self.asks_to_quit
    }

    /// Whether the window is to close.
    pub fn quits(&self) -> bool {
        self.quits
    }

    /// The files that were written or are to be written, in order.
    pub fn take_saved(&mut self) -> Vec<Saved> {
        std::mem::take(&mut self.saved)
    }

    /// What the visible 3D view is to show, with `size` pixels; `None` without a scene.
    pub fn view_request(&self, size: (u32, u32)) -> Option<ViewRequest> {
        let film = FilmSize {
            w: size.0.max(1),
            h: size.1.max(1),
        };
        Some(ViewRequest {
            camera: for_film(&self.view_orbit()?.camera(), film),
            size: (film.w, film.h),
            style: match self.mode {
                Mode::Bvh if self.scene.as_ref()?.bvh().is_some() => {
                    ViewStyle::Node(self.walk.node())
                }
                _ => ViewStyle::Materials { edges: self.edges },
            },
        })
    }

    /// Brings the picture of the 3D view up to date. Returns whether more is to come.
    pub fn update_view(&mut self, size: (u32, u32)) -> bool {
        let (Some(scene), Some(request)) = (self.scene.clone(), self.view_request(size)) else {
            return false;
        };
        let wake = Arc::clone(&self.wake);
        self.view.update(&scene, request, self.patience, &wake)
    }
}

/// The angle that a drag over the height of the view rotates by, in radians.
const ROTATION_PER_VIEW: f64 = std::f64::consts::PI;

/// A view of what `orbit` sees, from its side: its camera and its rays are visible.
fn beside(orbit: Orbit) -> Orbit {
    let mut spy = Orbit::new(orbit.view());
    spy.rotate(-0.7, -0.25);
    spy.zoom(-4.0);
    Orbit::new(spy.view())
}
