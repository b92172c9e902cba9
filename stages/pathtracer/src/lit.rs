//! Lit shading: each pixel shows the light that reaches it.
//!
//! A camera sample with scalar paths: `raygen` generates its ray, and `PathIntegrator` traces it
//! with the stage `global`, which calls the stage `direct` for the direct light at each surface. A
//! ray depth of 0 or 1 needs `direct` only. With `--accel simd`, `PacketRenderer` traces most
//! pictures instead, in packets of eight paths.

use crate::exact_sum::PixelSum;
use crate::integrator::PathIntegrator;
use crate::packet::{Guide, PacketRenderer};
use crate::pixel_contents::PixelContents;
use crate::rendered::RenderedTile;
use crate::textures::Textures;
use crate::tiles;
use crate::tracer::RayTracer;
use crate::{Accel, Job, Lens, Rendered};
use adaptive::{has_converged, has_surely_converged, raytrace_pixel_adaptive};
use kit::effects::{EffectSettings, Requirement};
use kit::film::Cell;
use kit::{Budget, LitScene, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};
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
    /// Samples per area light (`-l`), or of all together with
    /// [`LitScene::with_chosen_lamps`](kit::LitScene::with_chosen_lamps); with
    /// [`DirectSampling::Hemisphere`] directions per area light.
    pub light_samples: u32,
    /// Ray depth (`-m`): 0 is emission only, 1 is direct light.
    pub max_depth: u32,
    /// How direct light is sampled.
    pub direct_sampling: DirectSampling,
    /// Whether Russian roulette ends dim paths.
    pub roulette: bool,
    /// How many times as often as by their throughput alone paths survive, at least 1.
    pub roulette_factor: u32,
    /// Camera rays for each sample that find the light of the lamps in a pixel with the edge of a
    /// lamp, at least 1 (`--lamp-rays`).
    pub lamp_rays: u32,
    /// Whether light fades towards the plane of a triangle (`--soft-terminator`).
    pub soft_terminator: bool,
    /// The largest luminance of a sample's indirect light (`--clamp`).
    pub clamp: Option<f64>,
    /// Whether neighbouring pixels share what their paths find (`--reuse-paths`): see
    /// [`LightSettings::shares_paths`].
    pub reuse_paths: bool,
    /// Whether caustic rays find light behind mirrors and smooth glass (`--guide-caustics`): see
    /// [`LightSettings::guides_caustics`].
    pub guide_caustics: bool,
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
            roulette_factor: 1,
            lamp_rays: 1,
            soft_terminator: false,
            clamp: None,
            reuse_paths: false,
            guide_caustics: false,
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

    /// Whether pixels share what their paths find: not if they have different numbers of samples,
    /// nor where the BSDF or a limit depends on whose path it is.
    pub fn shares_paths(&self) -> bool {
        let is_own = self.adaptive.is_some() || self.clamp.is_some() || self.soft_terminator;
        self.reuse_paths && self.max_depth > 1 && !is_own
    }

    /// Whether only paths in packets do what they say.
    pub fn need_packets(&self) -> bool {
        self.shares_paths() || self.guides_caustics()
    }

    /// Whether caustic rays may be sent: a lamp behind a mirror is found by the third ray of a path
    /// at the earliest.
    pub fn guides_caustics(&self) -> bool {
        let is_limited = self.clamp.is_some() || self.soft_terminator;
        self.guide_caustics && self.max_depth > 2 && !is_limited
    }

    /// What the pixels of `job` can show, as far as it matters: only adaptive sampling asks for
    /// empty pixels. With a lens, whose rays start elsewhere, nothing is known.
    pub(crate) fn pixel_contents(&self, lit: &LitScene, job: &Job) -> PixelContents {
        if self.lens.radius > 0.0 {
            return PixelContents::default();
        }
        PixelContents::new(lit, job, [self.adaptive.is_some(), self.lamp_rays > 1])
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
    tile_done: &(dyn Fn(Cell, u64) + Sync),
) -> Rendered {
    let tiles = job.cell.tiles();
    let finished = |tile: RenderedTile| {
        tile_done(tile.cell, tile.counters.rays);
        tile
    };
    let contents = settings.pixel_contents(lit, job);
    let tiles = render_lit_tiles(
        lit,
        textures,
        accel,
        job,
        settings,
        &contents,
        &Guide::default(),
        &tiles,
        stop,
        &finished,
    );
    let mut rendered = Rendered::black(job.film, true);
    tiles.iter().for_each(|tile| rendered.add_tile(tile));
    rendered
}

/// Renders some tiles of the picture of [`render_lit`], with the same pixels. `contents` must be
/// the [`Picture::pixel_contents`](crate::Picture::pixel_contents) of `job`. `finish` is called
/// with each tile and returns what to keep of it. A tile that is in progress when `stop` is set has
/// black pixels without samples.
#[allow(
    clippy::too_many_arguments,
    reason = "those of `render_lit`, what its pixels can show, and the tiles"
)]
pub fn render_lit_tiles<R: Send>(
    lit: &LitScene,
    textures: &Textures,
    accel: &Accel,
    job: &Job,
    settings: &LightSettings,
    contents: &PixelContents,
    guide: &Guide,
    tiles: &[Cell],
    stop: &AtomicBool,
    finish: &(dyn Fn(RenderedTile) -> R + Sync),
) -> Vec<R> {
    if let Some(renderer) =
        PacketRenderer::new(lit, textures, accel, job, settings, contents, guide)
    {
        return renderer.render(tiles, stop, finish);
    }
    tiles::render(
        tiles,
        job.sampling,
        || PathIntegrator::new(lit, textures, accel, settings),
        |integrator, x, y, sampler| {
            if stop.load(Ordering::Relaxed) {
                return integrator.finish_pixel(PixelSum::default(), Tally::default());
            }
            integrator.pixel(job, contents, (x, y), sampler)
        },
        |cell, pixels, integrator| finish(integrator.into_tile(cell, pixels)),
    )
}

impl<T: RayTracer> PathIntegrator<'_, T> {
    /// Estimates the pixel `(x, y)` with one path at a time, and stores the tally of its
    /// luminances.
    pub(crate) fn pixel(
        &mut self,
        job: &Job,
        contents: &PixelContents,
        (x, y): (u32, u32),
        sampler: &mut PixelSampler,
    ) -> PixelEstimate {
        let this = &*self;
        let edge = this.lamp_edge(job, contents, (x, y));
        let camera_ray = &mut |sensor| {
            this.tracer.sample_starts(sensor);
            generate_ray(&job.camera, sensor)
        };
        let trace_ray = &mut |ray: &Ray, sampler: &mut PixelSampler| {
            let ray = this.through_lens(&job.camera, ray, sampler);
            let radiance = this.radiance(&ray, sampler);
            let smoothed = match &edge {
                Some(edge) => edge.smooth(this, sampler.samples_started(), &ray, radiance),
                None => radiance,
            };
            this.tracer.sample_ends(radiance, smoothed);
            smoothed
        };
        let (sum, luminance) = sample_pixel(
            job,
            this.settings,
            contents,
            (x, y),
            sampler,
            camera_ray,
            trace_ray,
        );
        self.finish_pixel(sum, luminance)
    }

    /// Stores the samples of the next pixel of the tile, the tally of their luminances, and what
    /// clamping has removed. Returns the mean of the samples.
    pub(crate) fn finish_pixel(&mut self, sum: PixelSum, luminance: Tally) -> PixelEstimate {
        self.sums.push(sum);
        if self.settings.clamp.is_some() {
            self.removed_sums.push(self.removed.take());
        }
        self.luminance.push(luminance);
        sum.mean()
    }

    /// The finished tile, and what was counted for it.
    pub(crate) fn into_tile(self, cell: Cell, pixels: Vec<PixelEstimate>) -> RenderedTile {
        RenderedTile {
            cell,
            pixels,
            counters: self.counters(),
            effects: self.materials.counts(),
            luminance: self.luminance,
            sums: self.sums,
            removed: self.removed_sums,
        }
    }
}

/// Sums the samples of the pixel `(x, y)`, which `trace_ray` traces, and tallies their luminances.
/// With adaptive sampling an empty pixel takes one batch.
pub(crate) fn sample_pixel(
    job: &Job,
    settings: &LightSettings,
    contents: &PixelContents,
    (x, y): (u32, u32),
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> (PixelSum, Tally) {
    let mut luminance = Tally::default();
    let mut sum = PixelSum::default();
    let trace_ray = &mut |ray: &Ray, sampler: &mut PixelSampler| {
        let radiance = trace_ray(ray, sampler);
        luminance.push(radiance.luminance());
        sum.push(radiance);
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
                contents.is_empty((x, y))
                    || has_surely_converged(samples, tolerance, &mut has_converged)
            },
        ),
    };
    (sum.of_loop(estimate), luminance)
}
