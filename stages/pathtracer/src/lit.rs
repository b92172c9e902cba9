//! Lit shading: each pixel shows the light that reaches it.
//!
//! A camera sample with scalar paths: `raygen` generates its ray, and `PathIntegrator` traces it
//! with the stage `global`, which calls the stage `direct` for the direct light at each surface. A
//! ray depth of 0 or 1 needs `direct` only. With `--accel simd`, `PacketRenderer` traces most
//! pictures instead, in packets of eight paths.

use crate::integrator::PathIntegrator;
use crate::packet::PacketRenderer;
use crate::textures::Textures;
use crate::tiles;
use crate::{Accel, Job, Lens, Rendered};
use adaptive::{has_converged, has_surely_converged, raytrace_pixel_adaptive};
use kit::effects::{EffectSettings, Requirement};
use kit::film::Cell as Tile;
use kit::{Budget, Film, LitScene, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};
use raygen::{generate_ray, raytrace_pixel};
use std::sync::atomic::{AtomicBool, Ordering};

/// How direct light is sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirectSampling {
    /// Sample the lights (part 3, task 3).
    Lights,
    /// Sample the hemisphere uniformly (part 3, task 2; the flag `-H`).
    Hemisphere,
    /// Sample the lights and the BSDF, combined by multiple importance sampling (`--mis`).
    Mis,
}

/// How light transport is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSettings {
    /// Samples per area light (`-l`); with [`DirectSampling::Hemisphere`] directions per area
    /// light.
    pub light_samples: u32,
    /// Ray depth (`-m`): 0 is emission only, 1 is direct light.
    pub max_depth: u32,
    /// How direct light is sampled.
    pub direct_sampling: DirectSampling,
    /// Whether Russian roulette ends dim paths.
    pub roulette: bool,
    /// Adaptive sampling: samples per batch and tolerance (`-a`).
    pub adaptive: Option<(u32, f64)>,
    /// The camera's lens.
    pub lens: Lens,
    /// Whether effects run that the scene does not call for. Changes the counts, but no picture.
    pub force_effects: bool,
    /// Whether there is an environment map that is not from the scene file.
    pub environment: bool,
}

impl Default for LightSettings {
    /// The assignment's defaults.
    fn default() -> LightSettings {
        LightSettings {
            light_samples: 1,
            max_depth: 1,
            direct_sampling: DirectSampling::Lights,
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
    /// Which effects `lit` calls for with these settings, and why.
    pub fn effects(&self, lit: &LitScene) -> Vec<Requirement> {
        lit.effects(EffectSettings {
            max_depth: self.max_depth,
            lens_radius: self.lens.radius,
            environment: self.environment,
        })
    }
}

/// Renders a lit picture on rayon's current thread pool.
///
/// The picture depends on `lit`, `job` and `settings` only, not on the threads. `accel` has to be
/// built over `lit.scene`; `textures` are the textures of that scene. `tile_done` is called with
/// each finished tile and the number of rays traced for it. Once `stop` is set, the remaining
/// pixels stay black.
pub fn render_lit(
    lit: &LitScene,
    textures: &Textures,
    accel: &Accel,
    job: &Job,
    settings: &LightSettings,
    stop: &AtomicBool,
    tile_done: &(dyn Fn(Tile, u64) + Sync),
) -> Rendered {
    if let Some(renderer) = PacketRenderer::new(lit, textures, accel, job, settings) {
        return renderer.render(stop, tile_done);
    }
    let (film, integrators) = tiles::render(
        job.film,
        job.cell,
        job.sampling,
        || PathIntegrator::new(lit, textures, accel, settings),
        |integrator, x, y, sampler| {
            if stop.load(Ordering::Relaxed) {
                return PixelEstimate::default();
            }
            let camera_ray = &mut |sensor| generate_ray(&job.camera, sensor);
            let trace_ray = &mut |ray: &Ray, sampler: &mut PixelSampler| {
                let ray = integrator.through_lens(&job.camera, ray, sampler);
                integrator.radiance(&ray, sampler)
            };
            let (estimate, luminance) =
                sample_pixel(job, settings, (x, y), sampler, camera_ray, trace_ray);
            integrator.luminance.push(((x, y), luminance));
            estimate
        },
        |cell, integrator| tile_done(cell, integrator.counters().rays),
    );
    assemble(film, &integrators)
}

/// Estimates the pixel `(x, y)` with samples that `trace_ray` traces, and tallies their luminances.
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

/// Combines the film with what the integrator of each tile counted.
pub(crate) fn assemble(film: Film, integrators: &[PathIntegrator<'_>]) -> Rendered {
    let width = film.size().w as usize;
    let mut luminance = vec![Tally::default(); film.pixels().len()];
    for ((x, y), tally) in integrators.iter().flat_map(|i| &i.luminance) {
        luminance[*y as usize * width + *x as usize] = *tally;
    }
    Rendered {
        film,
        luminance,
        counters: integrators.iter().map(PathIntegrator::counters).sum(),
        effects: integrators.iter().map(|i| i.materials.counts()).sum(),
    }
}
