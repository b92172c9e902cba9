//! The replay of the pixel that was clicked, and a walk through it.

use crate::scene_data::SceneData;
use crate::task::{StageFailure, Task, Wake};
use crate::truth::{PixelTruth, check_pixel};
use kit::{PixelEstimate, Vec2};
use pathtracer::replay::text::is_same;
use pathtracer::replay::{PixelReplay, RayRecord, SampleRecord};
use pathtracer::{Job, LightSettings, RayRole, replay_pixel};
use std::sync::Arc;
use std::time::Duration;

/// A replayed pixel.
#[derive(Clone, Debug)]
pub struct Inspected {
    /// The scene of the replay.
    pub scene: Arc<SceneData>,
    /// The job of the picture.
    pub job: Job,
    /// Its light transport.
    pub light: LightSettings,
    /// The passes of the picture, each with all samples of the job.
    pub passes: u32,
    /// The replay.
    pub replay: PixelReplay,
    /// The pixel of the picture, if it was rendered.
    pub rendered: Option<PixelEstimate>,
    /// Where the stages and the truth part.
    pub truth: PixelTruth,
}

impl Inspected {
    /// Whether the replay and the picture agree, bit for bit; `None` without a picture.
    pub fn agrees(&self) -> Option<bool> {
        let rendered = self.rendered?;
        Some(is_same(rendered, self.replay.estimate))
    }

    /// The most samples that the pixel can take.
    pub fn most_samples(&self) -> usize {
        self.job.samples as usize * self.passes as usize
    }

    /// Where the samples are in the pixel, in [0, 1]² from the bottom left.
    pub fn positions(&self) -> impl Iterator<Item = Vec2> {
        let (x, y) = self.replay.pixel;
        let corner = Vec2::new(f64::from(x), f64::from(y));
        let film = self.job.film;
        let size = Vec2::new(f64::from(film.w), f64::from(film.h));
        let samples = self.replay.samples.iter();
        samples.map(move |sample| sample.sensor * size - corner)
    }
}

/// Which rays are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayFilter {
    /// Camera rays.
    pub camera: bool,
    /// Rays that continue a path.
    pub bounce: bool,
    /// Shadow rays and rays sampled to find light.
    pub light: bool,
    /// Only rays of this depth.
    pub depth: Option<u32>,
    /// Only the selected sample.
    pub one_sample: bool,
    /// The scattering where the selected ray hits.
    pub lobe: bool,
}

impl Default for RayFilter {
    fn default() -> RayFilter {
        RayFilter {
            camera: true,
            bounce: true,
            light: true,
            depth: None,
            one_sample: true,
            lobe: true,
        }
    }
}

impl RayFilter {
    /// Whether a ray is shown.
    pub fn shows(&self, ray: &RayRecord) -> bool {
        let of_role = match ray.role {
            RayRole::Camera => self.camera,
            RayRole::Bounce => self.bounce,
            RayRole::Shadow | RayRole::Light => self.light,
        };
        of_role && self.depth.is_none_or(|depth| depth == ray.depth)
    }
}

/// The inspector: at most one replay, and the selected ray and test.
#[derive(Default)]
pub struct Inspector {
    running: Option<((u32, u32), Task<Inspected>)>,
    inspected: Option<Inspected>,
    failure: Option<StageFailure>,
    /// Which rays are shown.
    pub filter: RayFilter,
    sample: usize,
    ray: usize,
    /// The number of tests of the selected ray that have been walked: from 0 to all of them.
    step: usize,
}

impl Inspector {
    /// Replays the pixel `(x, y)` of the picture that `job` and `settings` describe, after `passes`
    /// passes.
    #[allow(
        clippy::too_many_arguments,
        reason = "the picture, the pixel, and whom to wake"
    )]
    pub fn inspect(
        &mut self,
        scene: &Arc<SceneData>,
        job: Job,
        settings: LightSettings,
        passes: u32,
        rendered: Option<PixelEstimate>,
        (x, y): (u32, u32),
        wake: &Wake,
    ) {
        let scene = Arc::clone(scene);
        self.failure = None;
        let task = Task::spawn(Arc::clone(wake), move |_| {
            let prepared = &scene.prepared;
            let replay = replay_pixel(
                &prepared.picture,
                &prepared.textures,
                &scene.tree,
                &job,
                &settings,
                passes,
                (x, y),
            );
            let has_lens = settings.lens.radius > 0.0;
            let truth = check_pixel(scene.scene(), &job.camera, has_lens, &replay);
            Inspected {
                scene,
                job,
                light: settings,
                passes,
                replay,
                rendered,
                truth,
            }
        });
        self.running = Some(((x, y), task));
    }

    /// Takes a finished replay. Waits for it at most `wait`.
    pub fn update(&mut self, wait: Duration) {
        let Some(result) = self.running.as_ref().and_then(|(_, task)| task.wait(wait)) else {
            return;
        };
        self.running = None;
        match result {
            Ok(inspected) => {
                (self.sample, self.ray, self.step) = (0, 0, 0);
                if let Some((sample, ray, _)) = &inspected.truth.first_wrong {
                    (self.sample, self.ray) = (*sample, *ray);
                }
                self.inspected = Some(inspected);
            }
            Err(failure) => {
                self.inspected = None;
                self.failure = Some(failure);
            }
        }
    }

    /// Forgets the replay.
    pub fn close(&mut self) {
        self.running = None;
        self.inspected = None;
        self.failure = None;
    }

    /// The pixel whose replay is in progress.
    pub fn running(&self) -> Option<(u32, u32)> {
        self.running.as_ref().map(|(pixel, _)| *pixel)
    }

    /// The replay.
    pub fn inspected(&self) -> Option<&Inspected> {
        self.inspected.as_ref()
    }

    /// Why there is no replay.
    pub fn failure(&self) -> Option<&StageFailure> {
        self.failure.as_ref()
    }

    /// The indices of the selected sample and ray, and the number of tests that were walked.
    pub fn position(&self) -> (usize, usize, usize) {
        (self.sample, self.ray, self.step)
    }

    /// The selected sample.
    pub fn sample(&self) -> Option<&SampleRecord> {
        self.inspected.as_ref()?.replay.samples.get(self.sample)
    }

    /// The selected ray.
    pub fn ray(&self) -> Option<&RayRecord> {
        self.sample()?.rays.get(self.ray)
    }

    /// Selects a sample, and its first ray.
    pub fn select_sample(&mut self, sample: usize) {
        let samples = self
            .inspected
            .as_ref()
            .map_or(0, |i| i.replay.samples.len());
        if sample < samples {
            (self.sample, self.ray, self.step) = (sample, 0, 0);
        }
    }

    /// Selects a ray of the selected sample, with no test walked.
    pub fn select_ray(&mut self, ray: usize) {
        if self.sample().is_some_and(|sample| ray < sample.rays.len()) {
            (self.ray, self.step) = (ray, 0);
        }
    }

    /// Walks to the next or the previous shown ray, also of the next or previous sample.
    pub fn step_ray(&mut self, forward: bool) {
        let Some(inspected) = &self.inspected else {
            return;
        };
        let shown: Vec<(usize, usize)> = inspected
            .replay
            .samples
            .iter()
            .enumerate()
            .flat_map(|(s, sample)| {
                let rays = sample.rays.iter().enumerate();
                rays.filter(|(_, ray)| self.filter.shows(ray))
                    .map(move |(r, _)| (s, r))
            })
            .collect();
        let at = (self.sample, self.ray);
        let next = if forward {
            shown.iter().find(|&&ray| ray > at)
        } else {
            shown.iter().rev().find(|&&ray| ray < at)
        };
        if let Some(&(sample, ray)) = next {
            (self.sample, self.ray, self.step) = (sample, ray, 0);
        }
    }

    /// Walks one test forward or back.
    pub fn step_test(&mut self, forward: bool) {
        let tests = self.ray().map_or(0, |ray| ray.tests.len());
        self.step = if forward {
            (self.step + 1).min(tests)
        } else {
            self.step.saturating_sub(1)
        };
    }

    /// Walks to the test with this index.
    pub fn go_to_test(&mut self, test: usize) {
        let tests = self.ray().map_or(0, |ray| ray.tests.len());
        self.step = (test + 1).min(tests);
    }
}
