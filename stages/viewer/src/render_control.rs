//! The picture in progress: started, stopped, resumed and continued in the background.

use crate::scene_data::SceneData;
use crate::task::{StageFailure, Task, Wake};
use kit::film::Cell;
use kit::{Film, FilmSize};
use pathtracer::{Job, LightSettings, ProgressiveRender};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::{Duration, Instant};

/// What the window shows of a render in progress.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The pixels so far; those without samples are not rendered yet.
    pub film: Film,
    /// A coarse picture with one sample per pixel, for where nothing is rendered yet.
    pub preview: Option<Film>,
    /// The share of this pass that is done, in [0, 1].
    pub progress: f64,
    /// The number of the pass in progress, from 1.
    pub pass: u32,
    /// Grows with every change.
    pub version: u64,
    /// The time from the start of the render to the first picture.
    pub first_after: Option<Duration>,
}

/// A render: its scene, its job and its state.
pub struct RenderControl {
    number: u64,
    scene: Arc<SceneData>,
    job: Job,
    settings: LightSettings,
    shown: Arc<Mutex<Shown>>,
    /// In progress.
    task: Option<Task<ProgressiveRender>>,
    /// Between runs.
    idle: Option<ProgressiveRender>,
    failure: Option<StageFailure>,
    start: Instant,
    /// The time of all finished runs.
    spent: Duration,
    wake: Wake,
}

/// The smallest divisor of the preview's resolution in each direction.
const PREVIEW_SCALE: u32 = 8;
/// The most pixels of a preview: one is there within 0.2 s whatever the size of the picture.
const PREVIEW_PIXELS: u32 = 16_000;
/// The time between two changes of the picture that the window shows.
const BATCH_TIME: Duration = Duration::from_millis(60);

impl RenderControl {
    /// Starts to render `job`.
    pub fn start(
        scene: &Arc<SceneData>,
        job: Job,
        settings: LightSettings,
        wake: Wake,
    ) -> RenderControl {
        let render = ProgressiveRender::new(&scene.prepared, job, settings);
        static RENDERS: AtomicU64 = AtomicU64::new(0);
        let mut control = RenderControl {
            number: RENDERS.fetch_add(1, Ordering::Relaxed),
            scene: Arc::clone(scene),
            job,
            settings,
            shown: Arc::new(Mutex::new(Shown {
                film: Film::new(job.film),
                preview: None,
                progress: 0.0,
                pass: 1,
                version: 0,
                first_after: None,
            })),
            task: None,
            idle: Some(render),
            failure: None,
            start: Instant::now(),
            spent: Duration::ZERO,
            wake,
        };
        control.resume();
        control
    }

    /// A number that no other render of this process has.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The scene that is rendered.
    pub fn scene(&self) -> &Arc<SceneData> {
        &self.scene
    }

    /// The job of the first pass.
    pub fn job(&self) -> &Job {
        &self.job
    }

    /// The settings of light transport.
    pub fn settings(&self) -> &LightSettings {
        &self.settings
    }

    /// The picture so far.
    pub fn shown(&self) -> MutexGuard<'_, Shown> {
        self.shown.lock().expect("no thread panics while it shows")
    }

    /// The finished or stopped render; `None` while it runs.
    pub fn render(&self) -> Option<&ProgressiveRender> {
        self.idle.as_ref()
    }

    /// Why a stage rendered nothing.
    pub fn failure(&self) -> Option<&StageFailure> {
        self.failure.as_ref()
    }

    /// Whether it renders at the moment.
    pub fn is_running(&self) -> bool {
        self.task.is_some()
    }

    /// Whether all passes are complete.
    pub fn is_done(&self) -> bool {
        self.idle.as_ref().is_some_and(ProgressiveRender::is_done)
    }

    /// The time spent on rendering.
    pub fn time(&self) -> Duration {
        match self.task {
            Some(_) => self.spent + self.start.elapsed(),
            None => self.spent,
        }
    }

    /// Asks the render to stop, with its finished tiles kept.
    pub fn stop(&self) {
        if let Some(task) = &self.task {
            task.stop();
        }
    }

    /// Continues a stopped render.
    pub fn resume(&mut self) {
        let Some(mut render) = self.idle.take_if(|render| !render.is_done()) else {
            return;
        };
        self.start = Instant::now();
        let scene = Arc::clone(&self.scene);
        let shown = Arc::clone(&self.shown);
        let wake = Arc::clone(&self.wake);
        self.task = Some(Task::spawn(Arc::clone(&self.wake), move |stop| {
            run(&mut render, &scene, &shown, &wake, stop);
            render
        }));
    }

    /// Renders another pass, if the render is done.
    pub fn add_samples(&mut self) {
        if let Some(render) = &mut self.idle {
            render.add_pass();
        }
        self.resume();
    }

    /// Takes the render when it has finished or stopped. Waits for it at most `wait`.
    pub fn update(&mut self, wait: Duration) {
        let Some(result) = self.task.as_ref().and_then(|task| task.wait(wait)) else {
            return;
        };
        self.spent += self.start.elapsed();
        self.task = None;
        match result {
            Ok(render) => self.idle = Some(render),
            Err(failure) => self.failure = Some(failure),
        }
    }
}

/// Renders until done or stopped, and shows what is finished.
fn run(
    render: &mut ProgressiveRender,
    scene: &SceneData,
    shown: &Mutex<Shown>,
    wake: &Wake,
    stop: &AtomicBool,
) {
    let start = Instant::now();
    let show = |change: &mut dyn FnMut(&mut Shown)| {
        let mut shown = shown.lock().expect("no thread panics while it shows");
        change(&mut shown);
        shown.first_after.get_or_insert_with(|| start.elapsed());
        shown.version += 1;
        drop(shown);
        wake();
    };
    if render.passes() == 1 && render.progress() == 0.0 {
        let preview = preview(render, scene, stop);
        show(&mut |shown| shown.preview = Some(preview.clone()));
    }
    // Enough tiles for all threads; more where tiles are quick.
    let mut count = rayon::current_num_threads();
    while !render.is_done() && !stop.load(Ordering::Relaxed) {
        let start = Instant::now();
        let tiles = render.run(&scene.prepared, count, stop);
        if start.elapsed() < BATCH_TIME / 2 {
            count *= 2;
        } else if start.elapsed() > BATCH_TIME {
            count = (count / 2).max(rayon::current_num_threads());
        }
        show(&mut |shown| {
            let film = &render.rendered().film;
            for (x, y) in tiles.iter().flat_map(|tile| tile.pixels()) {
                shown.film.set(x, y, film.get(x, y));
            }
            shown.progress = render.progress();
            shown.pass = render.passes();
        });
    }
}

/// A picture with an eighth of the resolution or less, one sample per pixel and one per light.
fn preview(render: &ProgressiveRender, scene: &SceneData, stop: &AtomicBool) -> Film {
    let FilmSize { w, h } = render.job().film;
    let pixels = u64::from(w) * u64::from(h);
    let scale = (pixels.div_ceil(u64::from(PREVIEW_PIXELS)) as f64).sqrt();
    let scale = (scale.ceil() as u32).max(PREVIEW_SCALE);
    let film = FilmSize {
        w: w.div_ceil(scale),
        h: h.div_ceil(scale),
    };
    let cell = render.job().cell;
    let job = Job {
        film,
        cell: Cell {
            x0: cell.x0 / scale,
            y0: cell.y0 / scale,
            x1: cell.x1.div_ceil(scale),
            y1: cell.y1.div_ceil(scale),
        },
        samples: 1,
        ..*render.job()
    };
    let settings = LightSettings {
        adaptive: None,
        light_samples: 1,
        ..*render.settings()
    };
    let mut preview = ProgressiveRender::new(&scene.prepared, job, settings);
    preview.run(&scene.prepared, usize::MAX, stop);
    preview.rendered().film.clone()
}
