// BEGIN SOLUTION(part6.task2)
//! Mirrors, glass and whatever else the lanes do not know: others take such paths one bounce on, one by one.

use crate::eight::Eight;
use crate::lanes::lanes;
use crate::rays::{Hits, NONE};
use crate::surfaces::Surfaces;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{Neighbours, Path};
use fearless_simd::Simd;
use kit::{PrimId, Ray, Spectrum};

/// What others made of a path: how it stands, and its next ray with the primitive that this leaves for good.
pub(crate) struct Taken {
    path: Path,
    way: Option<(Ray, Option<PrimId>)>,
}

impl<S: Simd> Eight<'_, S> {
    /// Has the paths in the lanes of `special` taken on.
    pub(crate) fn take_on(
        &self,
        special: u64,
        bounce: u32,
        surfaces: &Surfaces<S>,
        hits: &Hits<S>,
        others: &mut impl Neighbours,
    ) -> [Option<Taken>; LANES] {
        let mut taken = [const { None }; LANES];
        for lane in lanes(special) {
            let hit = surfaces.hit(lane, hits);
            let colour = |c: Vec3x8<S>| Spectrum::from(c.lane(lane).to_array());
            let mut path = Path {
                radiance: colour(self.paths.radiance),
                throughput: colour(self.paths.throughput),
                sampler: self.samplers.get(lane),
                bounce,
                sees_light: self.paths.sees_light[lane] > 0.5,
            };
            let way = others.go_on(&mut path, self.paths.d.lane(lane), &hit);
            taken[lane] = Some(Taken { path, way });
        }
        taken
    }

    /// Puts them back into their lanes: which of them go on.
    pub(crate) fn give_back(&mut self, taken: [Option<Taken>; LANES]) -> u64 {
        let mut survivors = 0;
        for (lane, taken) in taken.into_iter().enumerate() {
            let Some(Taken { path, way }) = taken else {
                continue;
            };
            self.paths.radiance.set(lane, path.radiance.to_array());
            self.samplers.set(lane, &path.sampler);
            if let Some((ray, left)) = way {
                self.paths.o.set(lane, ray.o.to_array());
                self.paths.d.set(lane, ray.d.to_array());
                self.paths.throughput.set(lane, path.throughput.to_array());
                self.paths.left[lane] = left.map_or(NONE, |id| f64::from(id.0));
                self.paths.sees_light[lane] = f64::from(u8::from(path.sees_light));
                survivors |= 1 << lane;
            }
        }
        survivors
    }
}
// END SOLUTION(part6.task2)
