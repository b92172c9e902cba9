//! Glossy surfaces and rough glass: the scalar fallback continues such paths one by one.

use crate::lane_mask::lanes;
use crate::packet::PathPacket;
use crate::ray_packet::{HitPacket, NONE};
use crate::surface_packet::SurfacePacket;
use crate::vec3x8::LANES;
use crate::{NextRay, ScalarFallback, ScalarPath};
use fearless_simd::Simd;
use kit::Spectrum;

/// A path after a bounce of the scalar fallback, and its next ray.
pub(crate) struct ScatteredPath {
    path: ScalarPath,
    next: Option<NextRay>,
}

impl<S: Simd> PathPacket<'_, S> {
    /// Has the fallback continue the paths in the lanes of `other`.
    pub(crate) fn scatter_others(
        &self,
        other: u64,
        bounce: u32,
        surfaces: &SurfacePacket<S>,
        hits: &HitPacket<S>,
        fallback: &mut dyn ScalarFallback,
        radiance: &mut [Spectrum],
    ) -> [Option<ScatteredPath>; LANES] {
        let mut scattered = [const { None }; LANES];
        for lane in lanes(other) {
            let hit = surfaces.hit(lane, hits);
            let radiance = &mut radiance[self.paths.index[lane] as usize];
            let mut path = ScalarPath {
                radiance: *radiance,
                throughput: Spectrum::from(self.paths.throughput.lane(lane).to_array()),
                sampler: self.samplers.get(lane),
                bounce,
                emission_counts: self.paths.emission_counts[lane] > 0.0,
            };
            let next = fallback.scatter(&mut path, self.paths.d.lane(lane), &hit);
            *radiance = path.radiance;
            scattered[lane] = Some(ScatteredPath { path, next });
        }
        scattered
    }

    /// Stores the paths in their lanes. Returns the lanes whose paths continue.
    pub(crate) fn merge(&mut self, scattered: [Option<ScatteredPath>; LANES]) -> u64 {
        let mut survivors = 0;
        for (lane, scattered) in scattered.into_iter().enumerate() {
            let Some(ScatteredPath { path, next }) = scattered else {
                continue;
            };
            self.samplers.set(lane, &path.sampler);
            if let Some(NextRay { ray, skip }) = next {
                let emission = self.emission_behind(lane);
                self.paths.o.set(lane, ray.o.to_array());
                self.paths.d.set(lane, ray.d.to_array());
                self.paths.throughput.set(lane, path.throughput.to_array());
                self.paths.skip[lane] = skip.map_or(NONE, |id| f64::from(id.0));
                self.paths.emission_counts[lane] =
                    if path.emission_counts { emission } else { 0.0 };
                survivors |= 1 << lane;
            }
        }
        survivors
    }
}
