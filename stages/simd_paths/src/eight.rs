// BEGIN SOLUTION(part6.task2)
//! One bounce of eight paths: what the stage `global` does along one, operation by operation.

use crate::batch::Paths;
use crate::deed::Does;
use crate::lanes::lanes;
use crate::rays::{Hits, Rays, prim};
use crate::surfaces::Surfaces;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{Neighbours, PathBatch, PathScene, PathSettings};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::sampler::PixelSamplers;
use kit::{Spectrum, Vec3};

/// Eight paths on their way through a scene.
pub(crate) struct Eight<'a, S: Simd> {
    pub(crate) simd: S,
    pub(crate) scene: &'a PathScene<'a>,
    pub(crate) settings: &'a PathSettings,
    /// The lanes that hold a path, one bit each.
    pub(crate) alive: u64,
    pub(crate) paths: Paths<S>,
    pub(crate) samplers: PixelSamplers<LANES>,
}

impl<S: Simd> Eight<'_, S> {
    /// Takes the paths along ray number `bounce`, counted from 1, to what that hits in `range`: which lanes go on.
    #[inline(always)]
    pub(crate) fn bounce(
        &mut self,
        bounce: u32,
        range: [f64; 2],
        work: &mut PathBatch,
        others: &mut impl Neighbours,
    ) -> u64 {
        let simd = self.simd;
        let zero = f64x8::splat(simd, 0.0);
        let rays = Rays {
            o: self.paths.o,
            d: self.paths.d,
            min_t: f64x8::splat(simd, range[0]),
            max_t: f64x8::splat(simd, range[1]),
        };
        let hits = self.closest(&rays, work, others);
        let found = self.alive & !hits.is_none().to_bitmask();
        if self.scene.has_background && found != self.alive {
            self.see_background(self.alive & !found, work);
        }
        if found == 0 {
            return 0;
        }
        let ids: [usize; LANES] = std::array::from_fn(|lane| hits.prim[lane].max(0.0) as usize);
        let deeds = std::array::from_fn(|lane| self.scene.deed_of(ids[lane]));
        let [matte, emits, special] = sort(&deeds, found);
        let colour = Vec3x8::gather(simd, |lane| deeds[lane].1.to_array());
        let mut surfaces =
            Surfaces::at(simd, self.scene, &rays, &hits, &ids, found, colour, others);
        if self.settings.has_textures {
            // A lamp is no brighter for its picture, but it is looked up as that of any surface is.
            for lane in lanes(matte | emits) {
                let tint = others.tint(&surfaces.hit(lane, &hits));
                if matte >> lane & 1 == 1 {
                    let colour = surfaces.colour.lane(lane) * Vec3::from(tint.to_array());
                    surfaces.colour.set(lane, colour.to_array());
                }
            }
        }
        // Before the lanes draw their numbers: these paths draw their own.
        let taken = (special != 0).then(|| self.take_on(special, bounce, &surfaces, &hits, others));
        let wo = -self.paths.d;
        if emits != 0 {
            let counts = f64x8::splat(simd, 0.5).simd_lt(self.paths.sees_light);
            let in_front = zero.simd_lt(wo.dot(surfaces.ng));
            let seen = mask64x8::from_bitmask(simd, emits) & counts & in_front;
            let radiance = self.paths.radiance + self.paths.throughput * surfaces.colour;
            self.paths.radiance = radiance.or(seen, self.paths.radiance);
        }
        let mut survivors = 0;
        if matte != 0 {
            let wo_z = wo.dot(surfaces.n);
            let direct = self.direct(&surfaces, wo_z, matte, work, others);
            let radiance = self.paths.radiance + self.paths.throughput * direct;
            let mask = mask64x8::from_bitmask(simd, matte);
            self.paths.radiance = radiance.or(mask, self.paths.radiance);
            if bounce < self.settings.max_depth {
                survivors = self.scatter(bounce, &surfaces, wo_z, matte, work);
            }
        }
        survivors | taken.map_or(0, |taken| self.give_back(taken))
    }

    #[inline(always)]
    fn closest(
        &self,
        rays: &Rays<S>,
        work: &mut PathBatch,
        others: &mut impl Neighbours,
    ) -> Hits<S> {
        let count = u64::from(self.alive.count_ones());
        work.counts.rays += count;
        let left = self.paths.left;
        if let Some(room) = &self.scene.room {
            work.counts.prim_tests += count * room.len() as u64;
            let scratch = &mut work.scratch;
            return room.closest(self.simd, rays, self.alive, left, scratch, others);
        }
        let mut hits = Hits::none(self.simd, rays.max_t);
        for lane in lanes(self.alive) {
            if let Some((id, hit)) = others.closest(&rays.lane(lane), prim(left[lane])) {
                hits.set(lane, id, hit);
            }
        }
        hits
    }

    /// Which of the lanes in `asked` hit anything but `left`.
    #[inline(always)]
    pub(crate) fn occluded(
        &self,
        rays: &Rays<S>,
        asked: u64,
        left: f64x8<S>,
        work: &mut PathBatch,
        others: &mut impl Neighbours,
    ) -> u64 {
        let count = u64::from(asked.count_ones());
        work.counts.rays += count;
        work.counts.light_rays += count;
        if let Some(room) = &self.scene.room {
            let scratch = &mut work.scratch;
            let (blocked, tests) = room.occluded(self.simd, rays, asked, left, scratch, others);
            work.counts.prim_tests += tests;
            return blocked;
        }
        lanes(asked)
            .filter(|&lane| others.occluded(&rays.lane(lane), prim(left[lane])))
            .map(|lane| 1 << lane)
            .sum()
    }

    /// The light of nothing, where it has not been counted yet.
    fn see_background(&mut self, missed: u64, work: &mut PathBatch) {
        work.counts.background += u64::from(missed.count_ones());
        for lane in lanes(missed).filter(|&lane| self.paths.sees_light[lane] > 0.5) {
            let light = self.scene.lit.background(self.paths.d.lane(lane));
            let throughput = self.paths.throughput.lane(lane);
            let radiance =
                self.paths.radiance.lane(lane) + throughput * Vec3::from(light.to_array());
            self.paths.radiance.set(lane, radiance.to_array());
        }
    }
}

/// The lanes in `found` by what their surfaces do: scatter, emit, or something else.
#[inline(always)]
fn sort(deeds: &[(Does, Spectrum); LANES], found: u64) -> [u64; 3] {
    let mut sorted = [0; 3];
    for (lane, &(does, _)) in deeds.iter().enumerate() {
        sorted[0] |= u64::from(does == Does::Scatter) << lane;
        sorted[1] |= u64::from(does == Does::Emit) << lane;
        sorted[2] |= u64::from(does == Does::Else) << lane;
    }
    [sorted[0] & found, sorted[1] & found, sorted[2] & found]
}
// END SOLUTION(part6.task2)
