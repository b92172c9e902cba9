//! Caustic rays: from diffuse surfaces towards light behind mirrors and smooth glass, where the
//! [`CausticGuide`](crate::CausticGuide) says.
//!
//! The light that leaves such a surface after mirrors and glass is found by two rays: one in a
//! direction that the BSDF has sampled, which is the path's next one, and one into a lobe of the
//! guide. The balance heuristic divides it between them by their densities (Veach and Guibas,
//! 1995). What the second ray finds ends there, unless it is a mirror or smooth glass.

use crate::PathMemory;
use crate::caustic_guide::MAX_CAUSTIC_RAYS;
use crate::lane_mask::lanes;
use crate::packet::PathPacket;
use crate::queue::PathLanes;
use crate::samplers::{next_1d, next_2d};
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::LANES;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Vec2;
use lanes::diffuse::{lambert_f, lambert_pdf, on_same_side};

impl<S: Simd> PathPacket<'_, S> {
    /// Adds the caustic rays of the paths in the lanes of `diffuse`, as many as the guide says.
    #[inline(never)]
    pub(crate) fn send_caustic_rays(
        &self,
        surfaces: &SurfacePacket<S>,
        wo_z: f64x8<S>,
        diffuse: u64,
        memory: &mut PathMemory,
    ) {
        let Some(guide) = self.scene.guide else {
            return;
        };
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let zero = f64x8::splat(simd, 0.0);
                let (o, skip) = surfaces.leave(simd, -self.paths.d);
                let mut samplers = self.samplers.branched();
                let number = next_1d(simd, &mut samplers);
                let lobes: [_; LANES] = std::array::from_fn(|lane| guide.lobes_at(o.lane(lane)));
                let mut counts = [0; LANES];
                for lane in lanes(diffuse) {
                    let count = (lobes[lane].rays() + number[lane]) as usize;
                    counts[lane] = count.min(MAX_CAUSTIC_RAYS);
                }
                let f = self.paths.throughput * lambert_f(surfaces.color);
                for i in 0..MAX_CAUSTIC_RAYS {
                    let mut sent = 0;
                    for (lane, count) in counts.into_iter().enumerate() {
                        sent |= u64::from(count > i) << lane;
                    }
                    if sent == 0 {
                        break;
                    }
                    let choice = next_1d(simd, &mut samplers);
                    let u = next_2d(simd, &mut samplers);
                    let (mut d, mut density) = (surfaces.n, zero);
                    for lane in lanes(sent) {
                        let u = Vec2::new(u[0][lane], u[1][lane]);
                        let choice = (i as f64 + choice[lane]) / counts[lane] as f64;
                        match lobes[lane].sample(choice, u) {
                            Some(wi) => {
                                d.set(lane, wi.to_array());
                                density[lane] = lobes[lane].density(wi);
                            }
                            None => sent &= !(1 << lane),
                        }
                    }
                    let wi_z = d.dot(surfaces.n);
                    let scatters = mask64x8::from_bitmask(simd, sent)
                        & on_same_side(wo_z, wi_z)
                        & on_same_side(self.wo_ng(surfaces), d.dot(surfaces.departure.ng));
                    let cos_by_pdf = wi_z.abs() / (lambert_pdf(wo_z, wi_z) + density);
                    let paths = PathLanes {
                        o,
                        d,
                        throughput: f * cos_by_pdf,
                        skip,
                        emission_counts: zero,
                        index: self.paths.index,
                    };
                    let queue = &mut memory.caustics;
                    queue.store(queue.count, &paths, scatters);
                    for lane in lanes(scatters.to_bitmask()) {
                        // Also for idle lanes, whose samplers need its pattern.
                        let idle = queue.count..(queue.count + 1).next_multiple_of(LANES);
                        queue.samplers[idle].fill(samplers.get(lane));
                        queue.count += 1;
                    }
                }
            },
        )
    }

    /// [`PathLanes::emission_counts`] behind the mirror or smooth glass that the ray in a lane has
    /// hit.
    pub(crate) fn emission_behind(&self, lane: usize) -> f64 {
        let before = self.paths.emission_counts[lane];
        match self.scene.guide {
            _ if before > 0.0 => before,
            Some(guide) if before < 0.0 => {
                let lobes = guide.lobes_at(self.paths.o.lane(lane));
                let density = lobes.density(self.paths.d.lane(lane));
                before / (before - density)
            }
            _ => 1.0,
        }
    }
}
