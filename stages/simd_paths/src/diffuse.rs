//! Diffuse surfaces: direct light as in the stage `direct`, and scattering.

use crate::PathMemory;
use crate::light;
use crate::packet::PathPacket;
use crate::ray_packet::RayPacket;
use crate::samplers::{next_1d, next_2d};
use crate::shadow_queue::{ShadowQueue, sample_count};
use crate::sin_cos::sin_cos;
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::Vec3x8;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use lanes::diffuse::{
    DiffuseSample, lambert_f, lambert_pdf, lambert_sample, on_same_side, terminator,
};
use lanes::frame::Frame;
use lanes::mis::power_heuristic;
use lanes::roulette;
use std::f64::consts::TAU;

impl<S: Simd> PathPacket<'_, S> {
    /// Samples the lights at the surfaces in the lanes of `diffuse`, and adds the shadow rays and
    /// the light to `shadows`. `wo_z` is the cosine of the angle between the normal and the viewer.
    #[inline(never)]
    pub(crate) fn sample_lights(
        &mut self,
        surfaces: &SurfacePacket<S>,
        wo_z: f64x8<S>,
        diffuse: u64,
        shadows: &mut ShadowQueue,
    ) {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let zero = f64x8::splat(simd, 0.0);
                let f = lambert_f(surfaces.color);
                let is_black = f.x.simd_eq(zero) & f.y.simd_eq(zero) & f.z.simd_eq(zero);
                let scatters = mask64x8::from_bitmask(simd, diffuse) & !is_black;
                let wo_ng = self.wo_ng(surfaces);
                for (number, emitter) in self.scene.lit.emitters.iter().enumerate() {
                    for _ in 0..sample_count(emitter, self.settings) {
                        let p = surfaces.departure.p;
                        let light = light::sample_light(
                            simd,
                            emitter,
                            p,
                            next_2d(simd, &mut self.samplers),
                            diffuse,
                        );
                        let wi_z = light.wi.dot(surfaces.n);
                        let same_side = on_same_side(wo_z, wi_z)
                            & on_same_side(wo_ng, light.wi.dot(surfaces.departure.ng));
                        let active = (scatters & light.exists & same_side).to_bitmask();
                        if active == 0 {
                            shadows.push_unlit();
                            continue;
                        }
                        let (o, skip) = surfaces.leave(simd, light.wi);
                        let rays = RayPacket {
                            o,
                            d: light.wi,
                            min_t: zero,
                            max_t: surfaces.departure.shadow_end(light.distance),
                        };
                        let mut weight = f64x8::splat(simd, 1.0);
                        if self.settings.samples_bsdf && !emitter.is_delta() {
                            weight = power_heuristic(light.pdf, lambert_pdf(wo_z, wi_z));
                        }
                        let mut f = f;
                        if self.settings.soft_terminator {
                            let frame = Frame::around(surfaces.n);
                            let ng = frame.to_local(surfaces.departure.ng);
                            f = f * terminator(ng, frame.to_local(light.wi));
                        }
                        let light = light.scattered(f, wi_z, weight);
                        shadows.push(number, &rays, skip, active, light);
                    }
                }
            },
        )
    }

    /// Samples the next ray of the paths in the lanes of `diffuse`. Returns the lanes whose paths
    /// continue.
    #[inline(never)]
    pub(crate) fn scatter(
        &mut self,
        bounce: u32,
        surfaces: &SurfacePacket<S>,
        wo_z: f64x8<S>,
        diffuse: u64,
        memory: &mut PathMemory,
    ) -> u64 {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let zero = f64x8::splat(simd, 0.0);
                let DiffuseSample { wi, pdf, weight } = self.sample_diffuse(surfaces, wo_z);
                let d = Frame::around(surfaces.n).to_world(wi);
                // No light is scattered towards a viewer in the plane of the surface, nor through
                // it.
                let mask = mask64x8::from_bitmask(simd, diffuse);
                let continues = mask
                    & wo_z.simd_ne(zero)
                    & on_same_side(self.wo_ng(surfaces), d.dot(surfaces.departure.ng));
                memory.counts.bounces += u64::from(continues.to_bitmask().count_ones());
                let (throughput, survivors) = self.roulette(bounce, self.paths.throughput * weight);
                let (o, skip) = surfaces.leave(simd, d);
                self.paths.o = o.masked_or(mask, self.paths.o);
                self.paths.d = d.masked_or(mask, self.paths.d);
                self.paths.skip = mask.select(skip, self.paths.skip);
                self.paths.throughput = throughput.masked_or(mask, self.paths.throughput);
                let pdf = if self.scene.guide.is_some() {
                    pdf
                } else {
                    zero
                };
                self.paths.emission_counts = mask.select(-pdf, self.paths.emission_counts);
                (continues & survivors).to_bitmask()
            },
        )
    }

    /// The cosine of the angle between the geometric normal and the viewer.
    #[inline(always)]
    pub(crate) fn wo_ng(&self, surfaces: &SurfacePacket<S>) -> f64x8<S> {
        (-self.paths.d).dot(surfaces.departure.ng)
    }

    /// Samples a direction at diffuse surfaces.
    #[inline(never)]
    pub(crate) fn sample_diffuse(
        &mut self,
        surfaces: &SurfacePacket<S>,
        wo_z: f64x8<S>,
    ) -> DiffuseSample<f64x8<S>> {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let u = next_2d(self.simd, &mut self.samplers);
                // The plain path tracer uses this number to choose between reflection and refraction. A
                // diffuse surface does not need it.
                self.samplers.skip_1d();
                let color = surfaces.color;
                let mut sample = lambert_sample(color, wo_z, u[0], sin_cos(u[1] * TAU));
                if self.settings.soft_terminator {
                    let ng = Frame::around(surfaces.n).to_local(surfaces.departure.ng);
                    let f = lambert_f(color) * terminator(ng, sample.wi);
                    sample.weight = f * (sample.wi.z.abs() / sample.pdf);
                }
                sample
            },
        )
    }

    /// Plays Russian roulette, unless it is switched off. Returns the new throughputs and the
    /// surviving lanes.
    #[inline(always)]
    pub(crate) fn roulette(
        &mut self,
        bounce: u32,
        throughput: Vec3x8<S>,
    ) -> (Vec3x8<S>, mask64x8<S>) {
        let simd = self.simd;
        let Some(min_bounces) = self.settings.min_bounces else {
            self.samplers.skip_1d();
            return (throughput, mask64x8::splat(simd, true));
        };
        let factor = f64x8::splat(simd, f64::from(self.settings.roulette_factor));
        let throughput = throughput * factor;
        let q = roulette::survival_probability(throughput);
        let is_positive = f64x8::splat(simd, 0.0).simd_lt(q);
        if bounce <= min_bounces {
            self.samplers.skip_1d();
            return (throughput / factor, is_positive);
        }
        let u = next_1d(simd, &mut self.samplers);
        let (throughput, survives) = roulette::play(throughput, q, u);
        (throughput / factor, is_positive & survives)
    }
}
