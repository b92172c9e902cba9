//! Normal shading: each pixel shows which way its surface faces.

use crate::{Accel, Counters, SceneWorld};
use kit::effects::EffectCounts;
use kit::film::{self, Cell};
use kit::sampler::Sampling;
use kit::{Camera, Film, FilmSize, Ray, Scene, Spectrum, Vec3};
use raygen::{generate_ray, raytrace_pixel};
use std::sync::atomic::{AtomicBool, Ordering};

/// What to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Job {
    /// From where.
    pub camera: Camera,
    /// The whole picture's size.
    pub film: FilmSize,
    /// The part of it that is rendered.
    pub cell: Cell,
    /// Camera rays a pixel.
    pub samples: u32,
    /// Where the random numbers come from.
    pub sampling: Sampling,
}

/// A picture and what it took.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The whole film; black outside the cell.
    pub film: Film,
    /// What was counted.
    pub counters: Counters,
    /// What light transport took.
    pub effects: EffectCounts,
}

impl Rendered {
    /// Pixels with a NaN in them. There should be none.
    pub fn nan_pixels(&self) -> usize {
        let pixels = self.film.pixels().iter();
        pixels
            .filter(|pixel| pixel.radiance.to_array().iter().any(|c| c.is_nan()))
            .count()
    }
}

/// The colour of a unit normal, `n/2 + 1/2`: red to +x, green to +y, blue to +z, in world space.
pub fn normal_color(n: Vec3) -> Spectrum {
    let c = 0.5 * n + 0.5;
    Spectrum::new(c.x, c.y, c.z)
}

/// Renders normals on rayon's current thread pool. What is not hit is black.
///
/// The picture depends on `scene` and `job` alone, not on threads. `tile_done` hears of each finished tile.
/// Once `stop` is set, the pixels that are left stay black.
pub fn render_normals(
    scene: &Scene,
    accel: &Accel,
    job: &Job,
    stop: &AtomicBool,
    tile_done: impl Fn(Cell) + Sync,
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
        |cell, _| tile_done(cell),
    );
    Rendered {
        film,
        counters: worlds.iter().map(|world| world.counters).sum(),
        effects: EffectCounts::default(),
    }
}
