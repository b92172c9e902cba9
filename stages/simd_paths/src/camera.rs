//! Generates the camera rays of a batch.

use crate::queue::{PathLanes, PathQueue};
use crate::ray_packet::NONE;
use crate::samplers::next_2d;
use crate::vec3x8::{LANES, Vec3x8};
use crate::{BATCH_SIZE, PathStart, ScalarFallback, View};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Ray, Vec3};
use lanes::camera::CameraAxes;

/// The paths through pixels: `samples` of them through each.
#[derive(Clone, Copy)]
pub(crate) struct CameraPaths<'a> {
    pub(crate) starts: &'a [PathStart],
    /// The numbers of the pixels, at least one.
    pub(crate) pixels: &'a [u32],
    pub(crate) samples: usize,
}

/// Fills the queue with the paths from number `first`, at most [`BATCH_SIZE`] of them.
#[inline(never)]
pub(crate) fn generate_paths<S: Simd>(
    simd: S,
    view: &View,
    all: CameraPaths<'_>,
    first: usize,
    queue: &mut PathQueue,
    fallback: &mut dyn ScalarFallback,
) {
    simd.vectorize(
        #[inline(always)]
        || {
            let camera = &view.camera;
            let axes = CameraAxes::of(camera, f64x8::splat(simd, 0.0));
            let white = Vec3x8::splat(simd, Vec3::ONE);
            queue.count = (all.pixels.len() * all.samples - first).min(BATCH_SIZE);
            let (mut number, mut sample) = (first / all.samples, first % all.samples);
            for first in (0..queue.count).step_by(LANES) {
                let (mut x, mut y, mut index) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
                for lane in 0..LANES {
                    // Lanes after the last path repeat some path of the last pixel.
                    let pixel = all.pixels[number.min(all.pixels.len() - 1)] as usize;
                    let start = &all.starts[pixel];
                    (x[lane], y[lane]) = (f64::from(start.pixel.0), f64::from(start.pixel.1));
                    index[lane] = (pixel * all.samples + sample) as f64;
                    let sampler = &mut queue.samplers[first + lane];
                    *sampler = start.sampler.clone();
                    if !view.centered {
                        sampler.start_samples(sample as u32 + 1);
                    }
                    sample += 1;
                    if sample == all.samples {
                        (number, sample) = (number + 1, 0);
                    }
                }
                let mut samplers = queue.samplers(first);
                let position = if view.centered {
                    [f64x8::splat(simd, 0.5); 2]
                } else {
                    next_2d(simd, &mut samplers)
                };
                let x = f64x8::load_array(simd, x) + position[0];
                let y = f64x8::load_array(simd, y) + position[1];
                let sensor = [x / f64::from(view.film.w), y / f64::from(view.film.h)];
                let d = axes.direction(sensor);
                let mut paths = PathLanes {
                    o: Vec3x8::splat(simd, camera.pos),
                    d,
                    throughput: white,
                    skip: f64x8::splat(simd, NONE),
                    emission_counts: f64x8::splat(simd, 1.0),
                    index: f64x8::load_array(simd, index),
                };
                for (lane, sampler) in queue.samplers[first..first + LANES].iter_mut().enumerate() {
                    *sampler = samplers.get(lane);
                }
                if view.has_lens {
                    let samplers = queue.samplers[first..queue.count].iter_mut().take(LANES);
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
        },
    )
}
