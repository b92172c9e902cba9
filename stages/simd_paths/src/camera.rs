// BEGIN SOLUTION(part6.task2)
//! Generates the camera rays of a batch.

use crate::queue::{PathLanes, PathQueue};
use crate::ray_packet::NONE;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathStart, ScalarFallback, View};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Ray, Vec3};
use lanes::camera::CameraAxes;

/// Fills the queue with one path for each of `starts`.
#[inline(always)]
pub(crate) fn generate_paths<S: Simd>(
    simd: S,
    view: &View,
    starts: &[PathStart],
    queue: &mut PathQueue,
    fallback: &mut dyn ScalarFallback,
) {
    let camera = &view.camera;
    let axes = CameraAxes::of(camera, f64x8::splat(simd, 0.0));
    let white = Vec3x8::splat(simd, Vec3::ONE);
    queue.count = starts.len();
    for (first, starts) in (0..).step_by(LANES).zip(starts.chunks(LANES)) {
        let of = |lane: usize| &starts[lane.min(starts.len() - 1)];
        for (lane, sampler) in queue.samplers[first..first + LANES].iter_mut().enumerate() {
            *sampler = of(lane).sampler.clone();
        }
        let mut samplers = queue.samplers(first);
        let position = if view.centered {
            [f64x8::splat(simd, 0.5); 2]
        } else {
            let [x, y] = samplers.next_2d();
            [f64x8::load_array(simd, x), f64x8::load_array(simd, y)]
        };
        let x = f64x8::from_fn(simd, |lane| f64::from(of(lane).pixel.0)) + position[0];
        let y = f64x8::from_fn(simd, |lane| f64::from(of(lane).pixel.1)) + position[1];
        let sensor = [x / f64::from(view.film.w), y / f64::from(view.film.h)];
        let d = axes.direction(sensor);
        let mut paths = PathLanes {
            o: Vec3x8::splat(simd, camera.pos),
            d,
            throughput: white,
            skip: f64x8::splat(simd, NONE),
            emission_counts: f64x8::splat(simd, 1.0),
            index: f64x8::from_fn(simd, |lane| (first + lane) as f64),
        };
        for (lane, sampler) in queue.samplers[first..first + LANES].iter_mut().enumerate() {
            *sampler = samplers.get(lane);
        }
        if view.has_lens {
            let samplers = queue.samplers[first..].iter_mut().take(starts.len());
            for (lane, sampler) in samplers.enumerate() {
                let ray = Ray {
                    o: paths.o.lane(lane),
                    d: paths.d.lane(lane),
                    min_t: camera.n_clip,
                    max_t: camera.f_clip,
                };
                let ray = fallback.through_lens(&ray, sampler);
                paths.o.set(lane, ray.o.to_array());
                paths.d.set(lane, ray.d.to_array());
            }
        }
        queue.store(first, &paths, mask64x8::splat(simd, true));
    }
}
// END SOLUTION(part6.task2)
