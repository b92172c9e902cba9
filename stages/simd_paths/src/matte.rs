// BEGIN SOLUTION(part6.task2)
//! Matte surfaces: what the stage `direct` does at them, and where paths go on from them.

use crate::eight::Eight;
use crate::lamp;
use crate::rays::Rays;
use crate::surfaces::Surfaces;
use crate::turn::sin_cos;
use crate::vec3x8::Vec3x8;
use crate::{Neighbours, PathBatch};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Vec3;
use kit::surface::SHADOW_GAP;
use std::f64::consts::{FRAC_1_PI, TAU};

impl<S: Simd> Eight<'_, S> {
    /// Direct light by sampling the lights, in the lanes of `matte`. `wo_z` is the cosine to the viewer.
    #[inline(always)]
    pub(crate) fn direct(
        &mut self,
        surfaces: &Surfaces<S>,
        wo_z: f64x8<S>,
        matte: u64,
        work: &mut PathBatch,
        others: &mut impl Neighbours,
    ) -> Vec3x8<S> {
        let simd = self.simd;
        let zero = f64x8::splat(simd, 0.0);
        let black = Vec3x8::splat(simd, Vec3::ZERO);
        let f = surfaces.colour * f64x8::splat(simd, FRAC_1_PI);
        let is_black = f.x.simd_eq(zero) & f.y.simd_eq(zero) & f.z.simd_eq(zero);
        let scatters = mask64x8::from_bitmask(simd, matte) & !is_black;
        let mut direct = black;
        for emitter in &self.scene.lit.emitters {
            let samples = if emitter.is_delta() {
                1
            } else {
                self.settings.light_samples
            };
            let mut sum = black;
            for _ in 0..samples {
                let light = lamp::sample(simd, emitter, surfaces.p, self.next_2d(), matte);
                let wi_z = light.wi.dot(surfaces.n);
                let same_side = zero.simd_lt(wo_z * wi_z);
                let asked = (scatters & light.some & same_side).to_bitmask();
                if asked == 0 {
                    continue;
                }
                let (o, left) = surfaces.leave(simd, light.wi);
                let rays = Rays {
                    o,
                    d: light.wi,
                    min_t: zero,
                    max_t: light.distance * (1.0 - SHADOW_GAP),
                };
                let lit = asked & !self.occluded(&rays, asked, left, work, others);
                let more = sum + f * light.radiance * (wi_z.abs() / light.pdf);
                sum = more.or(mask64x8::from_bitmask(simd, lit), sum);
            }
            direct = direct + sum.over(f64x8::splat(simd, f64::from(samples.max(1))));
        }
        direct
    }

    /// Where the paths in the lanes of `matte` go on: which of them do.
    #[inline(always)]
    pub(crate) fn scatter(
        &mut self,
        bounce: u32,
        surfaces: &Surfaces<S>,
        wo_z: f64x8<S>,
        matte: u64,
        work: &mut PathBatch,
    ) -> u64 {
        let simd = self.simd;
        let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
        let u = self.next_2d();
        // Which of its ways a surface takes: a matte one has a single one.
        self.samplers.skip_1d();
        let (sin, cos) = sin_cos(simd, u[1] * TAU);
        let (r, z) = (u[0].sqrt(), (one - u[0]).sqrt());
        let wi = Vec3x8 {
            x: r * cos,
            y: r * sin,
            z: z.copysign(wo_z),
        };
        let f = surfaces.colour * f64x8::splat(simd, FRAC_1_PI);
        let weight = f * (z / (z * FRAC_1_PI));
        // In the plane of the surface there is no light, and no way to go on.
        let mask = mask64x8::from_bitmask(simd, matte);
        let goes_on = mask & wo_z.simd_ne(zero);
        work.counts.bounces += u64::from(goes_on.to_bitmask().count_ones());
        let (throughput, survivors) = self.play(bounce, self.paths.throughput * weight);
        let d = surfaces.to_world(simd, wi);
        let (o, left) = surfaces.leave(simd, d);
        self.paths.o = o.or(mask, self.paths.o);
        self.paths.d = d.or(mask, self.paths.d);
        self.paths.left = mask.select(left, self.paths.left);
        self.paths.throughput = throughput.or(mask, self.paths.throughput);
        self.paths.sees_light = mask.select(zero, self.paths.sees_light);
        (goes_on & survivors).to_bitmask()
    }

    /// Roulette, if it is played: the throughputs to go on with, and who survives.
    #[inline(always)]
    fn play(&mut self, bounce: u32, throughput: Vec3x8<S>) -> (Vec3x8<S>, mask64x8<S>) {
        let simd = self.simd;
        let Some(first_game) = self.settings.first_game else {
            self.samplers.skip_1d();
            return (throughput, mask64x8::splat(simd, true));
        };
        let brightest = throughput
            .x
            .max_precise(throughput.y)
            .max_precise(throughput.z);
        let q = brightest.min_precise(f64x8::splat(simd, 1.0));
        let seen = f64x8::splat(simd, 0.0).simd_lt(q);
        if bounce <= first_game {
            self.samplers.skip_1d();
            return (throughput, seen);
        }
        let u = f64x8::load_array(simd, self.samplers.next_1d());
        (throughput.over(q), seen & u.simd_lt(q))
    }

    #[inline(always)]
    fn next_2d(&mut self) -> [f64x8<S>; 2] {
        let [first, second] = self.samplers.next_2d();
        [
            f64x8::load_array(self.simd, first),
            f64x8::load_array(self.simd, second),
        ]
    }
}
// END SOLUTION(part6.task2)
