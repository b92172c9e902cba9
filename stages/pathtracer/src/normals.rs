//! Normal shading: each pixel shows the shading normal at the first hit.

use crate::exact_sum::PixelSum;
use crate::rendered::RenderedTile;
use crate::tiles;
use crate::tracer::{RayRole, RayTracer, SceneTracer};
use crate::{Accel, Counters, Job};
use kit::effects::EffectCounts;
use kit::film::Cell;
use kit::{PixelEstimate, PixelSampler, Ray, Scene, Spectrum, Vec3};
use raygen::{generate_ray, raytrace_pixel};
use std::sync::atomic::{AtomicBool, Ordering};

/// The colour of a unit normal in world space, `n/2 + 1/2`: x in red, y in green, z in blue.
pub fn normal_color(n: Vec3) -> Spectrum {
    let c = 0.5 * n + 0.5;
    Spectrum::new(c.x, c.y, c.z)
}

/// Renders some tiles of a picture of normals on rayon's current thread pool. Rays that miss are
/// black. `accel` has to be built over `scene`. `finish` is called with each tile and returns what
/// to keep of it. A tile that is in progress when `stop` is set has black pixels without samples.
pub fn render_normal_tiles<R: Send>(
    scene: &Scene,
    accel: &Accel,
    job: &Job,
    tiles: &[Cell],
    stop: &AtomicBool,
    finish: &(dyn Fn(RenderedTile) -> R + Sync),
) -> Vec<R> {
    let tracer = SceneTracer { scene, accel };
    tiles::render(
        tiles,
        job.sampling,
        || (Counters::default(), Vec::new()),
        |(counters, sums), x, y, sampler| {
            let sum = if stop.load(Ordering::Relaxed) {
                PixelSum::default()
            } else {
                sum_of_pixel(&tracer, job, (x, y), sampler, counters)
            };
            sums.push(sum);
            sum.mean()
        },
        |cell, pixels, (counters, sums)| {
            finish(RenderedTile {
                cell,
                pixels,
                luminance: Vec::new(),
                sums,
                removed: Vec::new(),
                counters,
                effects: EffectCounts::default(),
            })
        },
    )
}

/// Estimates the normal in the pixel `(x, y)`.
pub(crate) fn normal_pixel(
    tracer: &impl RayTracer,
    job: &Job,
    pixel: (u32, u32),
    sampler: &mut PixelSampler,
    counters: &mut Counters,
) -> PixelEstimate {
    sum_of_pixel(tracer, job, pixel, sampler, counters).mean()
}

/// Sums the samples of [`normal_pixel`].
fn sum_of_pixel(
    tracer: &impl RayTracer,
    job: &Job,
    (x, y): (u32, u32),
    sampler: &mut PixelSampler,
    counters: &mut Counters,
) -> PixelSum {
    let mut sum = PixelSum::default();
    let estimate = raytrace_pixel(
        x,
        y,
        job.film,
        job.samples,
        sampler,
        &mut |sensor| {
            tracer.sample_starts(sensor);
            generate_ray(&job.camera, sensor)
        },
        &mut |ray: &Ray, _| {
            counters.rays += 1;
            let color = match tracer.closest(RayRole::Camera, ray, None, counters) {
                Some(hit) => normal_color(hit.n),
                None => Spectrum::BLACK,
            };
            tracer.sample_ends(color, color);
            sum.push(color);
            color
        },
    );
    sum.of_loop(estimate)
}
