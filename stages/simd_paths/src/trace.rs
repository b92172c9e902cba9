//! Traces a batch of paths from the camera to their ends.

use crate::beam::BEAM_SIZE;
use crate::intersection::{HitSource, TracedRays};
use crate::lane_mask::lanes;
use crate::packet::PathPacket;
use crate::primitive_list::NearbyPrimitives;
use crate::shadow_queue::ShadowQueue;
use crate::vec3x8::LANES;
use crate::{BATCH_SIZE, PathMemory, PathScene, PathSettings, ScalarFallback, View};
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
    memory: &mut PathMemory,
    fallback: &mut dyn ScalarFallback,
    radiance: &mut [Spectrum],
) {
    let mut nearby = mem::take(&mut memory.nearby);
    let mut shadows = mem::take(&mut memory.shadows);
    let mut traced = mem::take(&mut memory.traced);
    for bounce in 1..=settings.max_depth {
        // Rays from the camera, and from what they hit to the lights, are close to each other.
        let are_coherent = bounce == 1;
        shadows.clear(scene.lit.emitters.len());
        memory.caustics.count = 0;
        let mut batch = Batch {
            scene,
            settings,
            view,
            nearby: &mut nearby,
            traced: &mut traced,
            shadows: &mut shadows,
        };
        batch.bounce(simd, bounce, false, memory, fallback, radiance);
        if memory.caustics.count > 0 {
            mem::swap(&mut memory.queue, &mut memory.caustics);
            for bounce in bounce + 1..=settings.max_depth {
                batch.bounce(simd, bounce, true, memory, fallback, radiance);
            }
            mem::swap(&mut memory.queue, &mut memory.caustics);
        }
        shadows.trace(
            simd,
            scene,
            are_coherent,
            &mut nearby,
            &mut traced,
            memory,
            fallback,
        );
        shadows.trace_bsdf(simd, scene, &mut traced, memory, fallback);
        shadows.add_light(simd, scene, settings, radiance);
        if settings.keeps_direct {
            for path in memory.queue.scattered() {
                memory.direct[path].get_or_insert(radiance[path]);
            }
        }
        if memory.queue.count == 0 {
            break;
        }
    }
    memory.nearby = nearby;
    memory.shadows = shadows;
    memory.traced = traced;
}

/// What tracing a batch needs.
struct Batch<'a, 'b> {
    scene: &'a PathScene<'a>,
    settings: &'a PathSettings,
    view: &'a View,
    nearby: &'b mut NearbyPrimitives,
    traced: &'b mut TracedRays,
    shadows: &'b mut ShadowQueue,
}

impl Batch<'_, '_> {
    /// Traces ray number `bounce` of each path in the queue and keeps those that continue.
    #[inline(never)]
    fn bounce<S: Simd>(
        &mut self,
        simd: S,
        bounce: u32,
        are_caustic: bool,
        memory: &mut PathMemory,
        fallback: &mut dyn ScalarFallback,
        radiance: &mut [Spectrum],
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let (scene, view) = (self.scene, self.view);
                let are_coherent = bounce == 1;
                let mut range = [0.0, f64::INFINITY];
                let mut list = None;
                let mut misses_all = false;
                if are_coherent {
                    range = [view.camera.n_clip, view.camera.f_clip];
                }
                let mut kept = 0;
                let count = memory.queue.count;
                // The rays of a beam have a list of their own. Those that have none are traced
                // together.
                let chunk = if are_coherent { BEAM_SIZE } else { BATCH_SIZE };
                for first in (0..count).step_by(LANES) {
                    if first % chunk == 0 {
                        let rays = memory.queue.rays(first, chunk, range);
                        list = scene.list.as_ref();
                        if are_coherent {
                            list = self.nearby.find(simd, scene, &rays, fallback).or(list);
                        }
                        if list.is_none() {
                            let (scratch, counts) = (&mut memory.scratch, &mut memory.counts);
                            self.traced
                                .trace(simd, scene, &rays, scratch, counts, fallback);
                        }
                        misses_all =
                            !scene.has_background && list.is_some_and(|list| list.len() == 0);
                    }
                    if misses_all {
                        memory.counts.rays += (count - first).min(LANES) as u64;
                        continue;
                    }
                    let hits = match list {
                        Some(list) => HitSource::List(list),
                        None => HitSource::Found(self.traced, first % chunk),
                    };
                    let mut packet = PathPacket {
                        simd,
                        scene,
                        settings: self.settings,
                        hits,
                        alive: (1 << (count - first).min(LANES)) - 1,
                        are_caustic,
                        paths: memory.queue.load(simd, first),
                        samplers: memory.queue.samplers(first),
                    };
                    let shadows = &mut *self.shadows;
                    let survivors =
                        packet.bounce(bounce, range, memory, shadows, fallback, radiance);
                    let mask = mask64x8::from_bitmask(simd, survivors);
                    memory.queue.store(kept, &packet.paths, mask);
                    for lane in lanes(survivors) {
                        memory.queue.samplers[kept] = packet.samplers.get(lane);
                        kept += 1;
                    }
                }
                memory.queue.count = kept;
            },
        )
    }
}
