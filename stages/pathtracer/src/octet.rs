//! Lit shading, eight paths at a time: the same pictures, bit for bit, sooner.
//!
//! [`simd_paths`] follows the paths; what it does not know (mirrors, glass, a tree over many primitives) it asks of the
//! walk that the plain way takes.

use crate::accel::{closest_in, occluded_in};
use crate::lit::{put_together, sample_pixel};
use crate::textures::Textures;
use crate::walk::Walk;
use crate::{Accel, Job, LightSettings, Looking, Rendered};
use global::roulette::MIN_BOUNCES;
use kit::effects::Effect;
use kit::film::{self, Cell};
use kit::{
    Camera, Hit, LitScene, PixelEstimate, PixelSampler, PrimId, Ray, Scattering, Spectrum,
    TriangleHit, Vec3,
};
use simd_bvh::WideBvh;
use simd_paths::{
    BATCH, Counts, Neighbours, Path, PathBatch, PathScene, PathSettings, Start, View,
};
use std::sync::atomic::{AtomicBool, Ordering};

/// A picture to be made with eight paths at a time.
pub(crate) struct Octet<'a> {
    lit: &'a LitScene,
    textures: &'a Textures,
    accel: &'a Accel,
    tree: &'a WideBvh,
    job: &'a Job,
    settings: &'a LightSettings,
    scene: PathScene<'a>,
    view: View,
    paths: PathSettings,
}

impl<'a> Octet<'a> {
    /// `None` if the picture is to be made one path at a time.
    pub(crate) fn new(
        lit: &'a LitScene,
        textures: &'a Textures,
        accel: &'a Accel,
        job: &'a Job,
        settings: &'a LightSettings,
    ) -> Option<Octet<'a>> {
        let Accel::Simd(tree) = accel else {
            return None;
        };
        let fits = lit.has_light()
            && settings.max_depth > 0
            && job.samples > 0
            && settings.looking == Looking::Lights
            && !settings.force_effects
            // One or two samples at a time would leave most lanes idle.
            && settings.adaptive.is_none_or(|(batch, _)| batch > 2);
        if !fits {
            return None;
        }
        Some(Octet {
            lit,
            textures,
            accel,
            tree,
            job,
            settings,
            scene: PathScene::new(lit)?,
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
                first_game: settings.roulette.then_some(MIN_BOUNCES),
            },
        })
    }

    /// As [`crate::render_lit`].
    pub(crate) fn render(
        &self,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(Cell, u64) + Sync),
    ) -> Rendered {
        let (film, walks) = film::render_tiles(
            self.job.film,
            self.job.cell,
            || Walk::new(self.lit, self.textures, self.accel, self.settings),
            |walk, tile| self.tile(walk, tile, stop),
            |tile, walk| tile_done(tile, walk.rays()),
        );
        put_together(film, &walks)
    }

    fn tile(&self, walk: &mut Walk<'a>, tile: Cell, stop: &AtomicBool) -> Vec<PixelEstimate> {
        let mut work = PathBatch::default();
        let mut estimates = Vec::with_capacity(tile.area() as usize);
        let pixels: Vec<(u32, u32)> = tile.pixels().collect();
        let first = self.due(0);
        for pixels in pixels.chunks(BATCH.div_ceil(first as usize)) {
            if stop.load(Ordering::Relaxed) {
                estimates.extend(pixels.iter().map(|_| PixelEstimate::default()));
                continue;
            }
            let mut starts: Vec<Start> = pixels
                .iter()
                .map(|&(x, y)| ((x, y), PixelSampler::new(x, y, self.job.sampling)))
                .collect();
            let seen = self.more(walk, &mut work, &mut starts, first);
            for (seen, start) in seen.chunks(first as usize).zip(&mut starts) {
                let estimate = self.pixel(walk, &mut work, start, seen);
                estimates.push(estimate);
            }
        }
        walk.add(work.counts);
        estimates
    }

    /// The pixel of `start`, of which `seen` is the first of its samples.
    fn pixel(
        &self,
        walk: &mut Walk<'a>,
        work: &mut PathBatch,
        start: &mut Start,
        seen: &[Spectrum],
    ) -> PixelEstimate {
        let mut taken = 0;
        let mut ready = seen.to_vec();
        let (estimate, luminance) = sample_pixel(
            self.job,
            self.settings,
            start.0,
            // The lanes draw the places of samples and aim the rays.
            &mut PixelSampler::new(0, 0, 0),
            &mut |_| Ray::new(Vec3::ZERO, Vec3::Z),
            &mut |_, _| {
                if taken == ready.len() {
                    let count =
                        self.due(start.1.samples_started() - self.job.sampling.first_sample);
                    ready = self.more(walk, work, std::slice::from_mut(start), count);
                    taken = 0;
                }
                taken += 1;
                ready[taken - 1]
            },
        );
        walk.luminance.push((start.0, luminance));
        estimate
    }

    /// How many further samples a pixel is sure to take that has taken `samples`; not more than a few batches at once.
    fn due(&self, samples: u32) -> u32 {
        let left = self.job.samples - samples;
        let sure = match self.settings.adaptive {
            Some((batch, _)) => left.min(batch - samples % batch),
            None => left,
        };
        sure.min(4 * BATCH as u32)
    }

    /// The next `count` samples of each pixel.
    fn more(
        &self,
        walk: &mut Walk<'a>,
        work: &mut PathBatch,
        pixels: &mut [Start],
        count: u32,
    ) -> Vec<Spectrum> {
        let mut starts = Vec::with_capacity(pixels.len() * count as usize);
        for start in pixels {
            for _ in 0..count {
                if !self.view.centered {
                    start.1.start_sample();
                }
                starts.push(start.clone());
            }
        }
        let mut others = Others {
            walk,
            tree: self.tree,
            camera: &self.job.camera,
        };
        self.scene
            .follow(&self.view, &self.paths, &starts, work, &mut others)
    }
}

/// The plain way, for what lanes do not know.
struct Others<'b, 'a> {
    walk: &'b mut Walk<'a>,
    tree: &'a WideBvh,
    camera: &'a Camera,
}

impl Neighbours for Others<'_, '_> {
    #[inline]
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        self.walk.world.borrow().test(id, ray)
    }

    #[inline]
    fn record(&self, id: PrimId, ray: &Ray, hit: TriangleHit) -> Hit {
        let record = self.walk.world.borrow().record(id, &mut { *ray }, hit);
        record.expect("what was hit is hit")
    }

    #[inline]
    fn closest(&mut self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        let world = self.walk.world.get_mut();
        world.left = left;
        closest_in(self.tree, ray, world)
    }

    #[inline]
    fn occluded(&mut self, ray: &Ray, left: Option<PrimId>) -> bool {
        let world = self.walk.world.get_mut();
        world.left = left;
        occluded_in(self.tree, ray, world)
    }

    fn aim(&mut self, ray: &Ray, sampler: &mut PixelSampler) -> Ray {
        self.walk.through_lens(self.camera, ray, sampler)
    }

    fn tint(&mut self, hit: &Hit) -> Spectrum {
        self.walk.look_up_texture(hit);
        self.walk.materials.tint()
    }

    fn go_on(&mut self, path: &mut Path, d: Vec3, hit: &Hit) -> Option<(Ray, Option<PrimId>)> {
        let walk = &self.walk;
        walk.come_to(hit);
        let surface = walk.lit.surface(hit);
        let wo = -d;
        if !surface.material.is_delta() {
            path.radiance += path.throughput * walk.direct(&surface, wo, &mut path.sampler);
        }
        if path.bounce == walk.max_depth {
            return None;
        }
        let (u, choice) = (path.sampler.next_2d(), path.sampler.next_1d());
        let local_wo = surface.frame.to_local(wo);
        let sample = walk
            .materials
            .sample(surface.material, local_wo, u, choice)?;
        let u = path.sampler.next_1d();
        path.throughput = walk.play(path.throughput * sample.weight(), path.bounce, u)?;
        path.sees_light = sample.delta;
        let ray = surface.leave(surface.frame.to_world(sample.wi));
        Some((ray, walk.left_by(&ray)))
    }
}

impl Walk<'_> {
    /// Adds what the lanes have done.
    fn add(&mut self, counts: Counts) {
        let counters = &mut self.world.get_mut().counters;
        counters.rays += counts.rays;
        counters.prim_tests += counts.prim_tests;
        self.materials
            .count_more(Effect::DirectLight, counts.light_rays);
        self.materials
            .count_more(Effect::Background, counts.background);
        self.materials.count_more(Effect::Bounces, counts.bounces);
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

    /// Without this, the pictures that are compared would be made one path at a time both times.
    #[test]
    fn pictures_are_made_so_unless_they_call_for_something_else() {
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
        let textures = Textures::default();
        let fits = |kind, settings: LightSettings| {
            let accel = Accel::build(kind, &lit.scene);
            Octet::new(&lit, &textures, &accel, &job, &settings).is_some()
        };
        let lights = LightSettings::default();
        let adaptive = |batch| LightSettings {
            adaptive: Some((batch, 0.1)),
            ..lights
        };
        assert!(fits(AccelKind::Simd, lights) && fits(AccelKind::Simd, adaptive(3)));
        assert!(!fits(AccelKind::Bvh, lights) && !fits(AccelKind::Brute, lights));
        let others = [
            adaptive(2),
            LightSettings {
                max_depth: 0,
                ..lights
            },
            LightSettings {
                looking: Looking::Both,
                ..lights
            },
            LightSettings {
                force_effects: true,
                ..lights
            },
        ];
        for settings in others {
            assert!(!fits(AccelKind::Simd, settings), "{settings:?}");
        }
    }
}
// END SOLUTION(part6.task2)
