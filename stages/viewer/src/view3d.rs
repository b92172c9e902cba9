//! Keeps the picture of a 3D view up to date, in the background.

use crate::pace::Pace;
use crate::scene_data::SceneData;
use crate::task::{StageFailure, Task, Wake};
use crate::view_picture::{ViewPicture, ViewRequest, trace};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How long the window waits for pictures. [`Pace`] shortens it while the view moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patience {
    /// How long one update may wait for a picture: then it is that of this very frame.
    pub per_frame: Duration,
    /// Whether the first picture has the full resolution already.
    pub always_sharp: bool,
}

impl Patience {
    /// For a window: 60 frames a second.
    pub const WINDOW: Patience = Patience {
        per_frame: Duration::from_millis(14),
        always_sharp: false,
    };

    /// For tests and snapshots: every picture is complete.
    pub const COMPLETE: Patience = Patience {
        per_frame: Duration::from_secs(600),
        always_sharp: true,
    };
}

/// The picture of a 3D view: coarse while something moves, then sharp.
#[derive(Default)]
pub struct View3d {
    picture: Option<(Arc<SceneData>, ViewPicture)>,
    /// Grows with every picture.
    version: u64,
    running: Option<Running>,
    wanted: Option<ViewRequest>,
    /// Whether the newest picture that was asked for is a quick one.
    is_moving: bool,
    pace: Pace,
    /// Rays per second of the last picture.
    rate: f64,
    /// Why a stage traced nothing, and of which scene.
    failure: Option<(Arc<SceneData>, StageFailure)>,
}

struct Running {
    scene: Arc<SceneData>,
    request: ViewRequest,
    size: (u32, u32),
    start: Instant,
    task: Task<ViewPicture>,
}

/// The rate that is assumed before the first picture.
const FIRST_RATE: f64 = 5e5;
/// How much longer than its budget a quick picture is waited for.
const LATE_BY: u32 = 2;
/// The smallest share of the resolution in each direction.
const MIN_SCALE: f64 = 1.0 / 16.0;

impl View3d {
    /// The newest picture of `scene`.
    pub fn picture(&self, scene: &Arc<SceneData>) -> Option<&ViewPicture> {
        let (of, picture) = self.picture.as_ref()?;
        Arc::ptr_eq(of, scene).then_some(picture)
    }

    /// The number of pictures so far.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Why `scene` cannot be traced.
    pub fn failure(&self, scene: &Arc<SceneData>) -> Option<&StageFailure> {
        let (of, failure) = self.failure.as_ref()?;
        Arc::ptr_eq(of, scene).then_some(failure)
    }

    /// Whether the newest picture is that of `request`, in full resolution, or there will be none.
    pub fn is_settled(&self, scene: &Arc<SceneData>, request: &ViewRequest) -> bool {
        self.failure(scene).is_some()
            || self
                .picture(scene)
                .is_some_and(|p| p.request == *request && p.size == request.size)
    }

    /// A frame took this many seconds, from its start to the next one's.
    pub fn frame(&mut self, seconds: f64) {
        if self.is_moving {
            self.pace.frame(seconds);
        }
    }

    /// Asks for a picture, and takes the one that is ready. Returns whether more is to come.
    pub fn update(
        &mut self,
        scene: &Arc<SceneData>,
        request: ViewRequest,
        patience: Patience,
        wake: &Wake,
    ) -> bool {
        self.take(Duration::ZERO);
        if self.failure(scene).is_some() {
            return false;
        }
        let is_still = self.wanted == Some(request);
        self.wanted = Some(request);
        if self.is_settled(scene, &request) {
            self.is_moving = false;
            return false;
        }
        let shown_scale = self
            .picture(scene)
            .filter(|picture| picture.request == request)
            .map(|picture| picture.size);
        let sharp = patience.always_sharp || (is_still && shown_scale.is_some());
        self.is_moving = !sharp;
        let size = if sharp {
            request.size
        } else {
            self.quick_size(request.size, self.pace.budget())
        };
        // A quick picture that is late is shown in the next frame.
        let wait = match sharp {
            true if patience.always_sharp => patience.per_frame,
            // A sharp picture takes many frames: waiting for it would only keep the window busy.
            true => Duration::ZERO,
            false => patience.per_frame.min(LATE_BY * self.pace.budget()),
        };
        let is_useful = self.running.as_ref().is_some_and(|running| {
            let is_wanted = Arc::ptr_eq(&running.scene, scene) && running.request == request;
            // A coarse picture of another camera is nearly done: it shows that something moves.
            is_wanted || running.size != running.request.size
        });
        if !is_useful {
            let data = Arc::clone(scene);
            self.running = Some(Running {
                scene: Arc::clone(scene),
                request,
                size,
                start: Instant::now(),
                task: Task::spawn(Arc::clone(wake), move |stop| {
                    // If it is stopped, nobody takes the picture.
                    trace(&data, &request, size, stop)
                }),
            });
        }
        self.take(wait);
        !self.is_settled(scene, &request)
    }

    /// Takes a finished picture, or waits for it.
    fn take(&mut self, wait: Duration) {
        let Some(running) = &self.running else { return };
        let Some(result) = running.task.wait(wait) else {
            return;
        };
        let running = self.running.take().expect("it is running");
        match result {
            Ok(picture) => {
                let rays = picture.hits.len() as f64;
                self.rate = rays / running.start.elapsed().as_secs_f64().max(1e-6);
                self.picture = Some((running.scene, picture));
                self.version += 1;
            }
            Err(failure) => self.failure = Some((running.scene, failure)),
        }
    }

    /// The size with which a picture takes at most `time`.
    fn quick_size(&self, (w, h): (u32, u32), time: Duration) -> (u32, u32) {
        let rate = if self.rate > 0.0 {
            self.rate
        } else {
            FIRST_RATE
        };
        let rays = rate * time.as_secs_f64();
        let scale = (rays / (f64::from(w) * f64::from(h)))
            .sqrt()
            .clamp(MIN_SCALE, 1.0);
        let scaled = |size: u32| ((f64::from(size) * scale) as u32).max(1);
        (scaled(w), scaled(h))
    }
}
