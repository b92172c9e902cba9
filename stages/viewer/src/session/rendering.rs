//! The picture: rendering, cells, and the pixel that is inspected.

use super::{Mode, Session};
use crate::render_control::RenderControl;
use crate::scene_data::SceneData;
use crate::settings::RenderSettings;
use crate::task::Task;
use kit::film::Cell;
use kit::{Camera, PixelEstimate, Ray, Vec2};
use pathtracer::{Job, LightSettings};
use raygen::generate_ray;
use std::sync::Arc;
use std::time::Duration;

/// Camera rays of a render that failed: what is written may be seen.
#[derive(Default)]
pub(super) struct CameraRays {
    /// The number of the render.
    render: Option<u64>,
    running: Option<Task<Vec<Ray>>>,
    rays: Vec<Ray>,
}

/// The rays along each edge of the film that are shown.
const CAMERA_RAYS: u32 = 10;

impl Session {
    /// The camera of renders.
    pub fn render_camera(&self) -> Option<Camera> {
        Some(self.orbit?.camera())
    }

    /// Starts a render from the beginning.
    pub(super) fn start_render(&mut self) {
        self.mode = Mode::Render;
        self.restart_render();
    }

    pub(super) fn restart_render(&mut self) {
        let (Some(scene), Some(camera), Some(settings)) =
            (self.scene.clone(), self.render_camera(), self.settings)
        else {
            self.say("There is no scene to render: drop a .dae file here");
            return;
        };
        let job = settings.job(camera);
        let wake = Arc::clone(&self.wake);
        self.render = Some(RenderControl::start(&scene, job, settings.light, wake));
        self.message = format!("Picture with {}", settings.flags());
    }

    /// Changes the settings. In render mode the render starts again, with the new settings.
    pub(super) fn change_settings(&mut self, change: impl FnOnce(&mut RenderSettings)) {
        let Some(settings) = &mut self.settings else {
            return;
        };
        change(settings);
        self.message = settings.flags();
        if self.mode == Mode::Render {
            self.restart_render();
        }
    }

    /// Sets the settings from a panel.
    pub fn set_settings(&mut self, settings: RenderSettings) {
        if self.settings != Some(settings) {
            self.change_settings(|old| *old = settings);
        }
    }

    pub(super) fn toggle_cell(&mut self) {
        if self.comparison.is_some() {
            return self.say("A and B are shown: end the comparison to draw a cell");
        }
        self.cell_mode = !self.cell_mode;
        if self.cell_mode {
            self.say("Cell mode: drag a rectangle in the picture");
        } else if self
            .settings
            .is_some_and(|settings| settings.cell.is_some())
        {
            self.change_settings(|settings| settings.cell = None);
        }
    }

    pub(super) fn set_cell(&mut self, cell: Cell) {
        if cell.area() > 0 {
            self.change_settings(|settings| settings.cell = Some(cell));
            let (w, h) = (cell.x1 - cell.x0, cell.y1 - cell.y0);
            self.message = format!("Selected cell measures {w}x{h} pixels");
        }
    }

    pub(super) fn toggle_rate(&mut self) {
        if self.comparison.is_some() {
            return self.say("A and B are shown: end the comparison to see the sample rate");
        }
        self.show_rate = !self.show_rate;
    }

    pub(super) fn stop_or_resume(&mut self) {
        let Some(render) = &mut self.render else {
            return self.start_render();
        };
        if render.is_running() {
            render.stop();
            self.say("Stopped: P resumes");
        } else if render.is_done() {
            self.say("The picture is complete: O adds samples, R starts again");
        } else {
            render.resume();
            self.say("Resumed");
        }
    }

    pub(super) fn add_samples(&mut self) {
        if let Some(render) = &mut self.render {
            if render.is_done() {
                render.add_samples();
                self.say("Another pass with as many samples");
            } else {
                self.say("Samples can be added when the picture is complete");
            }
        }
    }

    /// Camera rays through the film of a render that failed; none if it did not, and until
    /// `generate_ray` is written.
    pub fn camera_rays(&self) -> &[Ray] {
        let current = self.render.as_ref().map(RenderControl::number);
        if current == self.camera_rays.render {
            &self.camera_rays.rays
        } else {
            &[]
        }
    }

    pub(super) fn update_camera_rays(&mut self, wait: Duration) {
        let failed = self
            .render
            .as_ref()
            .filter(|render| render.failure().is_some());
        if let Some(render) = failed
            && self.camera_rays.render != Some(render.number())
        {
            let camera = render.job().camera;
            let share = |i: u32| (f64::from(i) + 0.5) / f64::from(CAMERA_RAYS);
            let sensors = (0..CAMERA_RAYS * CAMERA_RAYS)
                .map(move |i| Vec2::new(share(i % CAMERA_RAYS), share(i / CAMERA_RAYS)));
            let task = Task::spawn(Arc::clone(&self.wake), move |_| {
                sensors
                    .map(|sensor| generate_ray(&camera, sensor))
                    .collect()
            });
            self.camera_rays = CameraRays {
                render: Some(render.number()),
                running: Some(task),
                rays: Vec::new(),
            };
        }
        let generated = self
            .camera_rays
            .running
            .as_ref()
            .and_then(|task| task.wait(wait));
        if let Some(generated) = generated {
            self.camera_rays.running = None;
            self.camera_rays.rays = generated.unwrap_or_default();
        }
    }

    /// The job whose pixels are inspected: that of the render, else the one that would start.
    pub(super) fn inspected_job(&self) -> Option<(Arc<SceneData>, Job, LightSettings, u32)> {
        if let Some(render) = self.render.as_ref().filter(|_| self.mode == Mode::Render) {
            let passes = match render.render() {
                Some(done) if done.is_done() => done.passes(),
                Some(stopped) => (stopped.passes() - 1).max(1),
                None => 1,
            };
            return Some((
                Arc::clone(render.scene()),
                *render.job(),
                *render.settings(),
                passes,
            ));
        }
        let settings = self.settings?;
        let job = settings.job(self.render_camera()?);
        Some((self.scene.clone()?, job, settings.light, 1))
    }

    pub(super) fn inspect(&mut self, x: u32, y: u32) {
        let Some((scene, job, settings, passes)) = self.inspected_job() else {
            return;
        };
        if x >= job.film.w || y >= job.film.h {
            return;
        }
        let rendered = self.rendered_pixel(x, y, passes);
        let wake = Arc::clone(&self.wake);
        self.inspector
            .inspect(&scene, job, settings, passes, rendered, (x, y), &wake);
        self.message = format!("Replay of pixel {x} {y}");
    }

    /// Replays the pixel that is `x` columns and `y` rows from the replayed one; without a replay the
    /// one in the middle.
    pub(super) fn inspect_next(&mut self, x: i32, y: i32) {
        let Some((_, job, ..)) = self.inspected_job() else {
            return;
        };
        let replayed = self.inspector.inspected().map(|i| i.replay.pixel);
        let at = self.inspector.running().or(replayed);
        let (x, y) = match at {
            Some(at) => (
                at.0.saturating_add_signed(x).min(job.film.w - 1),
                at.1.saturating_add_signed(y).min(job.film.h - 1),
            ),
            None => (job.film.w / 2, job.film.h / 2),
        };
        self.inspect(x, y);
    }

    /// The pixel of the render, if it has all samples of `passes` passes.
    fn rendered_pixel(&self, x: u32, y: u32, passes: u32) -> Option<PixelEstimate> {
        let render = self.render.as_ref().filter(|_| self.mode == Mode::Render)?;
        let pixel = render.shown().film.get(x, y);
        let is_adaptive = render.settings().adaptive.is_some();
        let expected = passes * render.job().samples;
        (pixel.samples > 0 && (is_adaptive || pixel.samples == expected)).then_some(pixel)
    }
}
