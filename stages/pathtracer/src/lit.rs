//! Lit shading: each pixel shows the light that reaches it.
//!
//! One camera sample goes like this: `raygen` makes its ray, and a walk follows it with the stage `global`, which
//! asks the stage `direct` for the light at each surface on the way. With a depth of 0 or 1 there is no way to follow,
//! and `direct` alone does it.

use crate::octet::Octet;
use crate::textures::Textures;
use crate::walk::Walk;
use crate::{Accel, Job, Lens, Rendered};
use adaptive::{has_converged, has_surely_converged, raytrace_pixel_adaptive};
use kit::effects::{Asked, Call};
use kit::film::{self, Cell as Tile};
use kit::{Budget, Film, LitScene, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};
use raygen::{generate_ray, raytrace_pixel};
use std::sync::atomic::{AtomicBool, Ordering};

/// How direct light is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Looking {
    /// At the lights (part 3, task 3).
    Lights,
    /// Around, at random (part 3, task 2; the flag `-H`).
    Hemisphere,
    /// Both, weighed by how good each is.
    Both,
}

/// How light is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSettings {
    /// Samples per light with an extent (`-l`); also directions per light when looking around.
    pub light_samples: u32,
    /// Ray depth (`-m`): 0 is emission only, 1 is direct light.
    pub max_depth: u32,
    /// How direct light is looked for.
    pub looking: Looking,
    /// Whether dim paths play roulette for their life.
    pub roulette: bool,
    /// Samples per batch and tolerance (`-a`).
    pub adaptive: Option<(u32, f64)>,
    /// The camera's lens.
    pub lens: Lens,
    /// Whether effects run that the scene does not call for. It changes no picture, only the counts.
    pub force_effects: bool,
    /// Whether the environment was asked for by a flag.
    pub environment: bool,
}

impl Default for LightSettings {
    /// The assignment's defaults.
    fn default() -> LightSettings {
        LightSettings {
            light_samples: 1,
            max_depth: 1,
            looking: Looking::Lights,
            roulette: true,
            adaptive: None,
            lens: Lens {
                radius: 0.0,
                focus: 1.0,
            },
            force_effects: false,
            environment: false,
        }
    }
}

impl LightSettings {
    /// What `lit` calls for under these settings.
    pub fn effects(&self, lit: &LitScene) -> Vec<Call> {
        lit.effects(Asked {
            max_depth: self.max_depth,
            lens_radius: self.lens.radius,
            environment: self.environment,
        })
    }
}

/// Renders light on rayon's current thread pool.
///
/// The picture depends on `lit`, `job` and `settings` alone, not on threads. `tile_done` hears of each finished tile and its rays. Once
/// `stop` is set, the pixels that are left stay black. `accel` is built over `lit.scene`, whose pictures are `textures`.
pub fn render_lit(
    lit: &LitScene,
    textures: &Textures,
    accel: &Accel,
    job: &Job,
    settings: &LightSettings,
    stop: &AtomicBool,
    tile_done: &(dyn Fn(Tile, u64) + Sync),
) -> Rendered {
    if let Some(octet) = Octet::new(lit, textures, accel, job, settings) {
        return octet.render(stop, tile_done);
    }
    let (film, walks) = film::render(
        job.film,
        job.cell,
        job.sampling,
        || Walk::new(lit, textures, accel, settings),
        |walk, x, y, sampler| {
            if stop.load(Ordering::Relaxed) {
                return PixelEstimate::default();
            }
            let camera_ray = &mut |sensor| generate_ray(&job.camera, sensor);
            let trace_ray = &mut |ray: &Ray, sampler: &mut PixelSampler| {
                let ray = walk.through_lens(&job.camera, ray, sampler);
                walk.radiance(&ray, sampler)
            };
            let (estimate, luminance) =
                sample_pixel(job, settings, (x, y), sampler, camera_ray, trace_ray);
            walk.luminance.push(((x, y), luminance));
            estimate
        },
        |cell, walk| tile_done(cell, walk.rays()),
    );
    put_together(film, &walks)
}

/// The pixel `(x, y)` from samples that `trace_ray` traces, and the tally of their luminances.
pub(crate) fn sample_pixel(
    job: &Job,
    settings: &LightSettings,
    (x, y): (u32, u32),
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> (PixelEstimate, Tally) {
    let mut luminance = Tally::default();
    let trace_ray = &mut |ray: &Ray, sampler: &mut PixelSampler| {
        let radiance = trace_ray(ray, sampler);
        luminance.push(radiance.luminance());
        radiance
    };
    let estimate = match settings.adaptive {
        None => raytrace_pixel(x, y, job.film, job.samples, sampler, camera_ray, trace_ray),
        Some((batch, tolerance)) => raytrace_pixel_adaptive(
            (x, y),
            job.film,
            Budget {
                ns_aa: job.samples,
                batch,
                tolerance,
            },
            sampler,
            camera_ray,
            trace_ray,
            &mut |samples: &Tally, tolerance| {
                has_surely_converged(samples, tolerance, &mut has_converged)
            },
        ),
    };
    (estimate, luminance)
}

/// The picture of several threads' work.
pub(crate) fn put_together(film: Film, walks: &[Walk<'_>]) -> Rendered {
    let width = film.size().w as usize;
    let mut luminance = vec![Tally::default(); film.pixels().len()];
    for ((x, y), tally) in walks.iter().flat_map(|walk| &walk.luminance) {
        luminance[*y as usize * width + *x as usize] = *tally;
    }
    Rendered {
        film,
        luminance,
        counters: walks.iter().map(|walk| walk.world.borrow().counters).sum(),
        effects: walks.iter().map(|walk| walk.materials.counts()).sum(),
    }
}
