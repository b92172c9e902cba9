// BEGIN SOLUTION(part6.task2)
//! Traces a batch of paths from the camera to their ends.

use crate::beam::BEAM_SIZE;
use crate::lane_mask::lanes;
use crate::packet::PathPacket;
use crate::vec3x8::LANES;
use crate::{PathScene, PathSettings, ScalarFallback, View, Workspace};
use fearless_simd::{Simd, mask64x8, prelude::*};
use kit::Spectrum;
use std::mem;

/// Traces all paths of the queue, bounce by bounce, and adds their radiance to `radiance`, which is
/// black.
///
/// After each packet the surviving paths move up in the queue, so that few lanes are idle in the
/// next bounce. The shadow rays of a bounce are traced after its last packet.
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
    let mut nearby = mem::take(&mut workspace.nearby);
    let mut shadows = mem::take(&mut workspace.shadows);
    for bounce in 1..=settings.max_depth {
        // Rays from the camera, and from what they hit to the lights, are close to each other.
        let are_coherent = bounce == 1;
        let mut range = [0.0, f64::INFINITY];
        let mut list = None;
        if are_coherent {
            range = [view.camera.n_clip, view.camera.f_clip];
        }
        shadows.clear(scene.lit.emitters.len());
        let mut kept = 0;
        for first in (0..workspace.queue.count).step_by(LANES) {
            if are_coherent && first % BEAM_SIZE == 0 {
                list = nearby.find(simd, scene, &workspace.queue.rays(first, range), fallback);
            }
            let mut packet = PathPacket {
                simd,
                scene,
                settings,
                list: list.or(scene.list.as_ref()),
                alive: (1 << (workspace.queue.count - first).min(LANES)) - 1,
                paths: workspace.queue.load(simd, first),
                samplers: workspace.queue.samplers(first),
            };
            let survivors =
                packet.bounce(bounce, range, workspace, &mut shadows, fallback, radiance);
            let mask = mask64x8::from_bitmask(simd, survivors);
            workspace.queue.store(kept, &packet.paths, mask);
            for lane in lanes(survivors) {
                workspace.queue.samplers[kept] = packet.samplers.get(lane);
                kept += 1;
            }
        }
        workspace.queue.count = kept;
        shadows.trace(simd, scene, are_coherent, &mut nearby, workspace, fallback);
        shadows.trace_bsdf(simd, scene, workspace, fallback);
        shadows.add_light(simd, scene, settings, radiance);
        if kept == 0 {
            break;
        }
    }
    workspace.nearby = nearby;
    workspace.shadows = shadows;
}
// END SOLUTION(part6.task2)
