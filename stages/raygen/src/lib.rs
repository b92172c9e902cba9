//! Part 1, tasks 1 and 2: where rays come from.

use kit::{Camera, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Vec2};

/// Task 1.
pub fn raytrace_pixel(
    x: u32,
    y: u32,
    film: FilmSize,
    ns_aa: u32,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> PixelEstimate {
    kit::hole!(
        "part1.task1",
        x,
        y,
        film,
        ns_aa,
        sampler,
        camera_ray,
        trace_ray
    )
}

/// Task 2.
pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    kit::hole!("part1.task2", camera, sensor)
}
