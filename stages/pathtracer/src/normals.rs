//! Normal shading: each pixel shows which way its surface faces.

use crate::{Accel, Job, Rendered, SceneWorld};
use kit::effects::EffectCounts;
use kit::film::{self, Cell};
use kit::{Ray, Scene, Spectrum, Vec3};
use raygen::{generate_ray, raytrace_pixel};
use std::sync::atomic::{AtomicBool, Ordering};

/// The colour of a unit normal, `n/2 + 1/2`: red to +x, green to +y, blue to +z, in world space.
pub fn normal_color(n: Vec3) -> Spectrum {
    let c = 0.5 * n + 0.5;
    Spectrum::new(c.x, c.y, c.z)
}

/// Renders normals on rayon's current thread pool. What is not hit is black.
///
/// The picture depends on `scene` and `job` alone, not on threads. `tile_done` hears of each finished tile and its rays.
/// Once `stop` is set, the pixels that are left stay black.
pub fn render_normals(
    scene: &Scene,
    accel: &Accel,
    job: &Job,
    stop: &AtomicBool,
    tile_done: &(dyn Fn(Cell, u64) + Sync),
) -> Rendered {
    let (film, worlds) = film::render(
        job.film,
        job.cell,
        job.sampling,
        || SceneWorld::new(scene),
        |world, x, y, sampler| {
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
                    world.counters.rays += 1;
                    match accel.closest(&mut { *ray }, world) {
                        Some(hit) => normal_color(hit.n),
                        None => Spectrum::BLACK,
                    }
                },
            )
        },
        |cell, world| tile_done(cell, world.counters.rays),
    );
    Rendered {
        film,
        luminance: Vec::new(),
        counters: worlds.iter().map(|world| world.counters).sum(),
        effects: EffectCounts::default(),
    }
}
