//! Lit shading, eight paths at a time: the same pictures, bit for bit, sooner.
//!
//! [`simd_paths`] follows the paths; what it does not know (mirrors, glass, a tree over many primitives) it asks of the
//! walk that the plain way takes.

use crate::lit::{put_together, sample_pixel};
use crate::textures::Textures;
use crate::walk::Walk;
use crate::{Accel, Job, LightSettings, Looking, Rendered, SceneWorld};
use global::roulette::FIRST_GAME;
use kit::effects::Effect;
use kit::film::{self, Cell};
use kit::{
    Hit, LitScene, PixelEstimate, PixelSampler, PrimId, Ray, Scattering, Spectrum, TriangleHit,
    Vec3,
};
use simd_bvh::{WideBvh, Work};
use simd_paths::{Counts, Neighbours, Path, PathBatch, PathScene, PathSettings, Start, View};
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

/// So many paths fill the lanes well: as many pixels are begun together as have them.
const BATCH: u32 = 64;

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
            && settings.lens.radius == 0.0
            && !settings.force_effects
            && textures.is_empty();
        if !fits {
            return None;
        }
        let world = SceneWorld::new(&lit.scene);
        Some(Octet {
            lit,
            textures,
            accel,
            tree,
            job,
            settings,
            scene: PathScene::new(lit, |id| world.geometric_normal(id))?,
            view: View {
                camera: job.camera,
                film: job.film,
                centered: job.samples == 1 && settings.adaptive.is_none(),
            },
            paths: PathSettings {
                light_samples: settings.light_samples,
                max_depth: settings.max_depth,
                first_game: settings.roulette.then_some(FIRST_GAME),
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
        for pixels in pixels.chunks(BATCH.div_ceil(first) as usize) {
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
        let decided = match self.settings.adaptive {
            Some((batch, _)) => left.min(batch.max(1)),
            None => left,
        };
        decided.min(4 * BATCH)
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
        };
        self.scene
            .follow(&self.view, &self.paths, &starts, work, &mut others)
    }
}

/// The plain way, for what lanes do not know.
struct Others<'b, 'a> {
    walk: &'b mut Walk<'a>,
    tree: &'a WideBvh,
}

impl Neighbours for Others<'_, '_> {
    #[inline]
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        self.walk.world.borrow().test(id, ray)
    }

    #[inline]
    fn closest(&mut self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        let world = self.walk.world.get_mut();
        let mut work = Work::default();
        let found = self.tree.closest(
            ray,
            left,
            &mut |id, ray: &Ray| world.test(id, ray),
            &mut work,
        );
        world.counters.add_work(work);
        found
    }

    #[inline]
    fn occluded(&mut self, ray: &Ray, left: Option<PrimId>) -> bool {
        let world = self.walk.world.get_mut();
        let mut work = Work::default();
        let blocked = self.tree.occluded(
            ray,
            left,
            &mut |id, ray: &Ray| world.test(id, ray),
            &mut work,
        );
        world.counters.add_work(work);
        blocked
    }

    fn go_on(&mut self, path: &mut Path, d: Vec3, hit: &Hit) -> Option<(Ray, Option<PrimId>)> {
        let walk = &self.walk;
        walk.at.set(Some((hit.prim, hit.ng)));
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
