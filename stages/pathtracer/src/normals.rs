//! Normal shading: each pixel shows the shading normal at the first hit.

use crate::tiles;
use crate::{Accel, Counters, Job, Rendered};
use kit::effects::EffectCounts;
use kit::film::Cell;
use kit::{Ray, Scene, Spectrum, Vec3};
use raygen::{generate_ray, raytrace_pixel};
use std::sync::atomic::{AtomicBool, Ordering};

/// The colour of a unit normal in world space, `n/2 + 1/2`: x in red, y in green, z in blue.
pub fn normal_color(n: Vec3) -> Spectrum {
    let c = 0.5 * n + 0.5;
    Spectrum::new(c.x, c.y, c.z)
}

/// Renders normals on rayon's current thread pool. Rays that miss are black.
///
/// The picture depends on `scene` and `job` only, not on the threads. `accel` has to be built over
/// `scene`. `tile_done` is called with each finished tile and the number of rays traced for it.
/// Once `stop` is set, the remaining pixels stay black.
pub fn render_normals(
    scene: &Scene,
    accel: &Accel,
    job: &Job,
    stop: &AtomicBool,
    tile_done: &(dyn Fn(Cell, u64) + Sync),
) -> Rendered {
    let (film, counters) = tiles::render(
        job.film,
        job.cell,
        job.sampling,
        Counters::default,
        |counters, x, y, sampler| {
            if stop.load(Ordering::Relaxed) {
                return Default::default();
            }
            raytrace_pixel(
                x,
                y,
                job.film,
                job.samples,
                sampler,
                &mut |sensor| generate_ray(&job.camera, sensor),
                &mut |ray: &Ray, _| {
                    counters.rays += 1;
                    match accel.closest(scene, &mut { *ray }, None, counters) {
                        Some(hit) => normal_color(hit.n),
                        None => Spectrum::BLACK,
                    }
                },
            )
        },
        |tile, counters| tile_done(tile, counters.rays),
    );
    Rendered {
        film,
        luminance: Vec::new(),
        counters: counters.into_iter().sum(),
        effects: EffectCounts::default(),
    }
}
