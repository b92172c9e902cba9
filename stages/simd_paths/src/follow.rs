// BEGIN SOLUTION(part6.task2)
//! The way of a batch of paths, from the camera to their ends.

use crate::eight::Eight;
use crate::lanes::lanes;
use crate::vec3x8::LANES;
use crate::{Neighbours, PathBatch, PathScene, PathSettings, View};
use fearless_simd::{Simd, mask64x8, prelude::*};
use kit::Spectrum;

/// Follows all paths of the batch and says what each of them saw. Bounce by bounce: those that are over make room, so that
/// few lanes are idle.
#[inline(always)]
pub(crate) fn follow<S: Simd>(
    simd: S,
    scene: &PathScene<'_>,
    settings: &PathSettings,
    view: &View,
    work: &mut PathBatch,
    others: &mut impl Neighbours,
    radiance: &mut [Spectrum],
) {
    for bounce in 1..=settings.max_depth {
        let range = if bounce == 1 {
            [view.camera.n_clip, view.camera.f_clip]
        } else {
            [0.0, f64::INFINITY]
        };
        let mut kept = 0;
        for first in (0..work.batch.count).step_by(LANES) {
            let alive = (1 << (work.batch.count - first).min(LANES)) - 1;
            let mut eight = Eight {
                simd,
                scene,
                settings,
                alive,
                paths: work.batch.load(simd, first),
                samplers: work.batch.samplers(first),
            };
            let survivors = eight.bounce(bounce, range, work, others);
            for lane in lanes(alive & !survivors) {
                let seen = eight.paths.radiance.lane(lane).to_array();
                radiance[eight.paths.slot[lane] as usize] = Spectrum::from(seen);
            }
            let mask = mask64x8::from_bitmask(simd, survivors);
            work.batch.store(kept, &eight.paths, mask);
            for lane in lanes(survivors) {
                work.batch.samplers[kept] = eight.samplers.get(lane);
                kept += 1;
            }
        }
        work.batch.count = kept;
        if kept == 0 {
            break;
        }
    }
}
// END SOLUTION(part6.task2)
