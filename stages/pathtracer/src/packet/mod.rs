//! Lit shading with paths in packets of eight: the same pictures, bit for bit, in less time.
//!
//! The stage [`simd_paths`] traces the packets. For what it does not handle it calls
//! [`Fallback`], which is the scalar [`PathIntegrator`].

mod blocks;
mod fallback;
mod photons;

use crate::clamp::clamp_indirect;
use crate::exact_sum::PixelSum;
use crate::integrator::PathIntegrator;
use crate::lit::sample_pixel;
use crate::pixel_contents::PixelContents;
use crate::rendered::RenderedTile;
use crate::textures::Textures;
use crate::tiles;
use crate::{Accel, Counters, DirectSampling, Job, LightSettings};
use fallback::Fallback;
use global::roulette::MIN_BOUNCES;
use kit::effects::Effect;
use kit::film::Cell;
use kit::{LitScene, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec3};
pub use photons::Guide;
use simd_bvh::{StreamMemory, WideBvh};
use simd_paths::{BATCH_SIZE, Counts, PathMemory, PathScene, PathSettings, PathStart, View};
use std::cell;
use std::slice;
use std::sync::atomic::{AtomicBool, Ordering};

/// Renders one picture with paths in packets.
pub(crate) struct PacketRenderer<'a> {
    lit: &'a LitScene,
    textures: &'a Textures,
    accel: &'a Accel,
    tree: &'a WideBvh,
    job: &'a Job,
    settings: &'a LightSettings,
    contents: &'a PixelContents,
    scene: PathScene<'a>,
    view: View,
    paths: PathSettings,
}

impl<'a> PacketRenderer<'a> {
    /// `None` if the picture has to be rendered one path at a time.
    pub(crate) fn new(
        lit: &'a LitScene,
        textures: &'a Textures,
        accel: &'a Accel,
        job: &'a Job,
        settings: &'a LightSettings,
        contents: &'a PixelContents,
        guide: &'a Guide,
    ) -> Option<PacketRenderer<'a>> {
        let Accel::Simd(tree) = accel else {
            return None;
        };
        let is_supported = lit.has_light()
            && settings.max_depth > 0
            && job.samples > 0
            && settings.direct_sampling != DirectSampling::Hemisphere
            && !settings.force_effects
            // One or two samples at a time would leave most lanes idle.
            && settings.adaptive.is_none_or(|(batch, _)| batch > 2);
        if !is_supported {
            return None;
        }
        let is_guided = settings.guides_caustics();
        let caustics = is_guided.then(|| guide.get(lit, accel)).flatten();
        Some(PacketRenderer {
            lit,
            textures,
            accel,
            tree,
            job,
            settings,
            contents,
            scene: PathScene::new(lit, tree.apart())?.guided(caustics),
            view: View {
                camera: job.camera,
                film: job.film,
                has_lens: settings.lens.radius > 0.0,
                centered: job.samples == 1 && settings.adaptive.is_none(),
            },
            paths: PathSettings {
                light_samples: settings.light_samples,
                max_depth: settings.max_depth,
                has_textures: !textures.is_empty(),
                samples_bsdf: settings.direct_sampling == DirectSampling::Mis,
                min_bounces: settings.roulette.then_some(MIN_BOUNCES),
                roulette_factor: settings.roulette_factor,
                soft_terminator: settings.soft_terminator,
                keeps_direct: settings.shares_paths()
                    || settings.clamp.is_some() && settings.max_depth > 1,
                reuses_paths: settings.shares_paths(),
            },
        })
    }

    /// Renders `tiles` as [`crate::lit::render_lit_tiles`] does.
    pub(crate) fn render<R: Send>(
        &self,
        tiles: &[Cell],
        stop: &AtomicBool,
        finish: &(dyn Fn(RenderedTile) -> R + Sync),
    ) -> Vec<R> {
        tiles::render_tiles(
            tiles,
            || PathIntegrator::new(self.lit, self.textures, self.accel, self.settings),
            |integrator, tile| match self.paths.reuses_paths {
                true => self.tile_in_blocks(integrator, tile, stop),
                false => self.tile(integrator, tile, stop),
            },
            |tile, pixels, integrator| finish(integrator.into_tile(tile, pixels)),
        )
    }

    fn tile(
        &self,
        integrator: &mut PathIntegrator<'a>,
        tile: Cell,
        stop: &AtomicBool,
    ) -> Vec<PixelEstimate> {
        let mut memory = Memory::default();
        let mut estimates = Vec::with_capacity(tile.area() as usize);
        let pixels: Vec<(u32, u32)> = tile.pixels().collect();
        let first = self.certain_samples(0);
        for pixels in pixels.chunks(MAX_SAMPLES.div_ceil(first as usize)) {
            if stop.load(Ordering::Relaxed) {
                let none = |_| integrator.finish_pixel(PixelSum::default(), Tally::default());
                estimates.extend(pixels.iter().map(none));
                continue;
            }
            let mut starts = self.starts(pixels);
            let removed = vec![cell::Cell::default(); starts.len()];
            let samples = self.trace(integrator, &mut memory, &mut starts, first, &removed);
            let pixels = samples.chunks(first as usize).zip(&mut starts).zip(removed);
            for ((samples, start), removed) in pixels {
                integrator.removed = removed;
                let estimate = self.pixel(integrator, &mut memory, start, samples);
                estimates.push(estimate);
            }
        }
        integrator.add_counts(memory.paths.counts);
        estimates
    }

    fn starts(&self, pixels: &[(u32, u32)]) -> Vec<PathStart> {
        let start = |&(x, y): &(u32, u32)| PathStart {
            pixel: (x, y),
            sampler: PixelSampler::new(x, y, self.job.sampling),
        };
        pixels.iter().map(start).collect()
    }

    /// The pixels of `tile`. Blocks that are partly outside of it are traced as a whole, so that a
    /// pixel is the same in every cell of the picture.
    fn tile_in_blocks(
        &self,
        integrator: &mut PathIntegrator<'a>,
        tile: Cell,
        stop: &AtomicBool,
    ) -> Vec<PixelEstimate> {
        let mut memory = Memory::default();
        let mut finished = vec![(PixelSum::default(), Tally::default()); tile.area() as usize];
        let pixels = blocks::pixels_of_blocks(tile);
        let at_once = (self.job.samples as usize).min(MAX_SAMPLES / blocks::BLOCK_AREA);
        for pixels in pixels.chunks((MAX_SAMPLES / at_once).next_multiple_of(blocks::BLOCK_AREA)) {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let mut starts = self.starts(pixels);
            let removed = vec![cell::Cell::default(); starts.len()];
            let mut left = self.job.samples;
            while left > 0 {
                let count = left.min(at_once as u32);
                let samples = self.trace(integrator, &mut memory, &mut starts, count, &removed);
                for (&pixel, samples) in pixels.iter().zip(samples.chunks(count as usize)) {
                    let Some(place) = blocks::place_in(tile, pixel) else {
                        continue;
                    };
                    let (sum, luminance) = &mut finished[place];
                    for &radiance in samples {
                        luminance.push(radiance.luminance());
                        sum.push(radiance);
                    }
                }
                left -= count;
            }
        }
        integrator.add_counts(memory.paths.counts);
        let pixels = finished.into_iter();
        pixels
            .map(|(sum, luminance)| integrator.finish_pixel(sum, luminance))
            .collect()
    }

    /// Estimates the pixel of `start`, whose first samples have the radiances `first`.
    fn pixel(
        &self,
        integrator: &mut PathIntegrator<'a>,
        memory: &mut Memory,
        start: &mut PathStart,
        first: &[Spectrum],
    ) -> PixelEstimate {
        if self.settings.adaptive.is_none()
            && first.len() == self.job.samples as usize
            && let Some((sum, luminance)) = exact_sum_of(first)
        {
            return integrator.finish_pixel(sum, luminance);
        }
        let mut used = 0;
        let mut ready = first.to_vec();
        let (sum, luminance) = sample_pixel(
            self.job,
            self.settings,
            self.contents,
            start.pixel,
            // The packets draw the sample positions and generate the camera rays.
            &mut PixelSampler::new(0, 0, 0),
            &mut |_| Ray::new(Vec3::ZERO, Vec3::Z),
            &mut |_, _| {
                if used == ready.len() {
                    let started = start.sampler.samples_started();
                    let count = self.certain_samples(started - self.job.sampling.first_sample);
                    let (start, removed) =
                        (slice::from_mut(start), slice::from_ref(&integrator.removed));
                    ready = self.trace(integrator, memory, start, count, removed);
                    used = 0;
                }
                used += 1;
                ready[used - 1]
            },
        );
        integrator.finish_pixel(sum, luminance)
    }

    /// How many further samples a pixel with `samples` samples needs for certain, and at most a few
    /// batches.
    fn certain_samples(&self, samples: u32) -> u32 {
        let remaining = self.job.samples - samples;
        let certain = match self.settings.adaptive {
            Some((batch, _)) => remaining.min(batch - samples % batch),
            None => remaining,
        };
        certain.min(MAX_SAMPLES as u32)
    }

    /// Traces the next `count` samples of each pixel. Adds what clamping removes from them to
    /// `removed`.
    fn trace(
        &self,
        integrator: &PathIntegrator<'a>,
        memory: &mut Memory,
        pixels: &mut [PathStart],
        count: u32,
        removed: &[cell::Cell<PixelSum>],
    ) -> Vec<Spectrum> {
        let mut fallback = Fallback {
            integrator,
            tree: self.tree,
            camera: &self.job.camera,
            counters: Counters::default(),
            stream: &mut memory.stream,
        };
        let mut samples = self.scene.trace(
            &self.view,
            &self.paths,
            pixels,
            count,
            &mut memory.paths,
            &mut fallback,
        );
        integrator.counting(|counters| *counters += fallback.counters);
        if let (Some(limit), true) = (self.settings.clamp, self.paths.keeps_direct) {
            for (i, radiance) in samples.iter_mut().enumerate() {
                let direct = memory.paths.direct[i];
                *radiance = clamp_indirect(limit, *radiance, direct, &removed[i / count as usize]);
            }
        }
        for (start, samples) in pixels.iter_mut().zip(samples.chunks_mut(count as usize)) {
            // Blocks may have pixels outside of the cell, of which nothing is known.
            let is_inside = blocks::place_in(self.job.cell, start.pixel).is_some();
            if is_inside
                && let Some(edge) = integrator.lamp_edge(self.job, self.contents, start.pixel)
            {
                edge.smooth_all(integrator, &start.sampler, samples);
            }
            start.sampler.start_samples(count);
        }
        samples
    }
}

/// The memory that a thread reuses.
#[derive(Debug, Default)]
struct Memory {
    paths: PathMemory,
    stream: StreamMemory,
}

/// The samples that are traced at once, a few batches of them.
const MAX_SAMPLES: usize = 16 * BATCH_SIZE;

/// The sum of all samples of a pixel, and the tally of their luminances: what the sampling loop of
/// stage `raygen` leads to. `None` if the sum cannot be exact and depends on the loop.
fn exact_sum_of(samples: &[Spectrum]) -> Option<(PixelSum, Tally)> {
    if samples.iter().all(|&radiance| radiance == Spectrum::BLACK) {
        let count = samples.len() as u32;
        return Some((PixelSum::black(count), Tally::of_equal(0.0, count.into())));
    }
    let (mut sum, mut luminance) = (PixelSum::default(), Tally::default());
    for &radiance in samples {
        luminance.push(radiance.luminance());
        sum.push(radiance);
    }
    matches!(sum, PixelSum::Exact { .. }).then_some((sum, luminance))
}

impl PathIntegrator<'_> {
    /// Adds what the packets counted.
    fn add_counts(&self, counts: Counts) {
        self.counting(|counters| {
            counters.rays += counts.rays;
            counters.prim_tests += counts.prim_tests;
            counters.reuse_rays += counts.reuse_rays;
        });
        self.materials
            .count_more(Effect::DirectLight, counts.light_rays);
        self.materials
            .count_more(Effect::Background, counts.background);
        for (effect, count) in [
            (Effect::Bounces, counts.bounces),
            (Effect::Mirror, counts.mirrors),
            (Effect::Refraction, counts.refractions),
            (Effect::Fresnel, counts.fresnel),
        ] {
            self.materials.count_more(effect, count);
        }
    }
}

// BEGIN SOLUTION(part6.task2)
#[cfg(test)]
mod tests {
    use super::*;
    use crate::AccelKind;
    use kit::FilmSize;
    use kit::scene::NamedLight;
    use kit::{Light, Scene};

    /// If packets were never used, the tests that compare pictures would compare scalar paths with
    /// themselves.
    #[test]
    fn packets_are_used_unless_a_setting_rules_them_out() {
        let point = Light::Point {
            position: Vec3::ZERO,
            intensity: Spectrum::WHITE,
        };
        let lights = vec![NamedLight {
            name: String::new(),
            light: point,
        }];
        let lit = LitScene::new(
            Scene {
                lights,
                ..Scene::default()
            },
            None,
        );
        let film = FilmSize { w: 1, h: 1 };
        let job = Job {
            camera: scenes::placement::place(&lit.scene, film).camera,
            film,
            cell: film.whole(),
            samples: 1,
            sampling: 0.into(),
        };
        let (textures, contents) = (Textures::default(), PixelContents::default());
        let guide = Guide::default();
        let uses_packets = |kind, settings: LightSettings| {
            let accel = Accel::build(kind, &lit.scene);
            PacketRenderer::new(&lit, &textures, &accel, &job, &settings, &contents, &guide)
                .is_some()
        };
        let lights = LightSettings::default();
        let adaptive = |batch| LightSettings {
            adaptive: Some((batch, 0.1)),
            ..lights
        };
        assert!(
            uses_packets(AccelKind::Simd, lights) && uses_packets(AccelKind::Simd, adaptive(3))
        );
        let mis = LightSettings {
            direct_sampling: DirectSampling::Mis,
            ..lights
        };
        assert!(uses_packets(AccelKind::Simd, mis));
        assert!(!uses_packets(AccelKind::Bvh, lights) && !uses_packets(AccelKind::Brute, lights));
        let ruled_out = [
            adaptive(2),
            LightSettings {
                max_depth: 0,
                ..lights
            },
            LightSettings {
                direct_sampling: DirectSampling::Hemisphere,
                ..lights
            },
            LightSettings {
                force_effects: true,
                ..lights
            },
        ];
        for settings in ruled_out {
            assert!(!uses_packets(AccelKind::Simd, settings), "{settings:?}");
        }
    }
}
// END SOLUTION(part6.task2)
