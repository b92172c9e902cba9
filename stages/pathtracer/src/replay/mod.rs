//! Replays of single pixels: the same samples again, with every ray and every test recorded.
//!
//! Reading order: [`record`] (what is recorded), `recorder` (the [`World`](kit::World) that records
//! it, for pixels and with [`record_ray`] for single rays), [`heat`] (the number of tests of every
//! pixel), [`text`] (a replay as text).

pub mod heat;
pub mod record;
mod recorder;
pub mod text;

pub use heat::{HeatMap, heat_map};
pub use record::{
    Outcome, PixelReplay, PrimAnswer, RayRecord, Roulette, SampleRecord, Test, Visit,
};
pub use recorder::record_ray;

use crate::integrator::PathIntegrator;
use crate::normals::normal_pixel;
use crate::progressive::job_of_pass;
use crate::rendered::mean;
use crate::{Accel, Counters, Job, LightSettings, Picture, Textures};
use kit::{PixelEstimate, PixelSampler, Tally};
use recorder::Recorder;

/// The number of samples of a replay whose rays are recorded. The others are traced, too, because
/// they are part of the pixel.
pub const MAX_RECORDED_SAMPLES: usize = 256;

/// Traces the samples of the pixel `(x, y)` of `job` again, of all `passes` passes of a
/// [`ProgressiveRender`](crate::ProgressiveRender).
///
/// Paths are traced one at a time, through `accel`: the binary tree or brute force, because the
/// tests of the wide tree do not go through [`World`](kit::World). The estimate is the pixel of the
/// picture, bit for bit, because all trees find the same hits. Panics if `accel` is the wide tree.
pub fn replay_pixel(
    picture: &Picture,
    textures: &Textures,
    accel: &Accel,
    job: &Job,
    settings: &LightSettings,
    passes: u32,
    (x, y): (u32, u32),
) -> PixelReplay {
    let recorder = Recorder::new(picture.scene(), accel);
    let contents = picture.pixel_contents(job, settings);
    let mut estimate = PixelEstimate::default();
    let mut luminance = Tally::default();
    let mut counters = Counters::default();
    for pass in 0..passes {
        let job = job_of_pass(job, pass);
        let mut sampler = PixelSampler::new(x, y, job.sampling);
        let of_pass = match picture {
            Picture::Normals(_) => {
                normal_pixel(&&recorder, &job, (x, y), &mut sampler, &mut counters)
            }
            Picture::Lit(lit) => {
                let mut paths = PathIntegrator::with_tracer(lit, textures, &recorder, settings);
                let estimate = paths.pixel(&job, &contents, (x, y), &mut sampler);
                counters += paths.counters();
                paths
                    .luminance
                    .iter()
                    .for_each(|tally| luminance.merge(tally));
                estimate
            }
        };
        estimate = mean(estimate, of_pass).unwrap_or_default();
    }
    PixelReplay {
        pixel: (x, y),
        estimate,
        luminance: picture.is_lit().then_some(luminance),
        counters,
        samples: recorder.into_samples(),
    }
}
