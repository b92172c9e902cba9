//! Part 1, task 1: the pixel sampling loop.

use kit::{FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Vec2};

/// Estimates the mean radiance over the pixel in column `x` and row `y`, counted from the bottom
/// left.
///
/// Chapter: stages/book/src/part1/task1.md
///
/// The estimate is the mean of `ns_aa` samples. `camera_ray` generates the ray through a position on
/// the film in film units, where (0, 0) is the bottom left corner of the film and (1, 1) the top
/// right one, whatever its size in pixels. `trace_ray` returns the radiance along the ray, and draws
/// its random numbers from the same sampler.
///
/// - `ns_aa == 1`: one ray through the centre of the pixel. Its position is not random.
/// - `ns_aa > 1`: each sample has its own position in the pixel, uniform in [0, 1)², from
///   [`PixelSampler::get_sample`].
/// - `ns_aa == 0`: no rays. The estimate is black with 0 samples, not 0/0.
///
/// A pixel outside the film is valid: the camera generates rays beyond the film as well.
///
/// See it: `cargo grader picture part1.task1`.
pub fn raytrace_pixel(
    x: u32,
    y: u32,
    film: FilmSize,
    ns_aa: u32,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> PixelEstimate {
    // BEGIN SOLUTION(part1.task1)
    if ns_aa == 0 {
        return PixelEstimate::default();
    }
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let film_size = Vec2::new(f64::from(film.w), f64::from(film.h));
    let mut sum = Spectrum::BLACK;
    for _ in 0..ns_aa {
        let place_in_pixel = if ns_aa == 1 {
            PIXEL_CENTER
        } else {
            sampler.get_sample()
        };
        let ray = camera_ray((corner + place_in_pixel) / film_size);
        sum += trace_ray(&ray, sampler);
    }
    PixelEstimate {
        radiance: sum / f64::from(ns_aa),
        samples: ns_aa,
    }
    // STUB: kit::hole!("part1.task1", x, y, film, ns_aa, sampler, camera_ray, trace_ray)
    // END SOLUTION(part1.task1)
}

// BEGIN SOLUTION(part1.task1)
/// Position of a single sample, relative to the bottom left corner of the pixel.
const PIXEL_CENTER: Vec2 = Vec2::new(0.5, 0.5);
// END SOLUTION(part1.task1)
