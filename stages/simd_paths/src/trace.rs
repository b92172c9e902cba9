// BEGIN SOLUTION(part6.task2)
//! Traces a batch of paths from the camera to their ends.

use crate::lanes::lanes;
use crate::packet::PathPacket;
use crate::vec3x8::LANES;
use crate::{PathScene, PathSettings, ScalarFallback, View, Workspace};
use fearless_simd::{Simd, mask64x8, prelude::*};
use kit::Spectrum;

/// Traces all paths of the queue, bounce by bounce, and stores the radiance of each.
///
/// After each packet the surviving paths move up in the queue, so that few lanes are idle in the
/// next bounce.
#[inline(always)]
pub(crate) fn trace_paths<S: Simd>(
    simd: S,
    scene: &PathScene<'_>,
    settings: &PathSettings,
    view: &View,
    workspace: &mut Workspace,
    fallback: &mut dyn ScalarFallback,
    radiance: &mut [Spectrum],
) {
    for bounce in 1..=settings.max_depth {
        let range = if bounce == 1 {
            [view.camera.n_clip, view.camera.f_clip]
        } else {
            [0.0, f64::INFINITY]
        };
        let mut kept = 0;
        for first in (0..workspace.queue.count).step_by(LANES) {
            let alive = (1 << (workspace.queue.count - first).min(LANES)) - 1;
            let mut packet = PathPacket {
                simd,
                scene,
                settings,
                alive,
                paths: workspace.queue.load(simd, first),
                samplers: workspace.queue.samplers(first),
            };
            let survivors = packet.bounce(bounce, range, workspace, fallback);
            for lane in lanes(alive & !survivors) {
                let result = packet.paths.radiance.lane(lane).to_array();
                radiance[packet.paths.index[lane] as usize] = Spectrum::from(result);
            }
            let mask = mask64x8::from_bitmask(simd, survivors);
            workspace.queue.store(kept, &packet.paths, mask);
            for lane in lanes(survivors) {
                workspace.queue.samplers[kept] = packet.samplers.get(lane);
                kept += 1;
            }
        }
        workspace.queue.count = kept;
        if kept == 0 {
            break;
        }
    }
}
// END SOLUTION(part6.task2)
