//! Casts, early returns and one variable a step, as somebody writes who comes from Java.

pub use base::*;
use kit::{Camera, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Vec2, Vec3};

pub fn raytrace_pixel(
    x: u32,
    y: u32,
    film: FilmSize,
    ns_aa: u32,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> PixelEstimate {
    let mut total = Spectrum::BLACK;
    if ns_aa == 0 {
        return PixelEstimate { radiance: total, samples: 0 };
    }
    let width = film.w as f64;
    let height = film.h as f64;
    if ns_aa == 1 {
        let px = (x as f64 + 0.5) / width;
        let py = (y as f64 + 0.5) / height;
        let ray = camera_ray(Vec2::new(px, py));
        total = trace_ray(&ray, sampler);
        return PixelEstimate { radiance: total, samples: 1 };
    }
    let mut i = 0;
    while i < ns_aa {
        let sample = sampler.get_sample();
        let sx = (x as f64 + sample.x) / width;
        let sy = (y as f64 + sample.y) / height;
        let r = camera_ray(Vec2::new(sx, sy));
        let light = trace_ray(&r, sampler);
        total = total + light;
        i += 1;
    }
    let mean = total / ns_aa as f64;
    return PixelEstimate { radiance: mean, samples: ns_aa };
}

pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    let pi = 3.141592653589793;
    let hor = camera.h_fov * pi / 180.0;
    let ver = camera.v_fov * pi / 180.0;
    let sensor_width = 2.0 * (hor / 2.0).tan();
    let sensor_height = 2.0 * (ver / 2.0).tan();
    let dx = (sensor.x - 0.5) * sensor_width;
    let dy = (sensor.y - 0.5) * sensor_height;
    let dz = -1.0;
    let mut world = camera.c2w.x_axis * dx + camera.c2w.y_axis * dy + camera.c2w.z_axis * dz;
    let length = (world.x * world.x + world.y * world.y + world.z * world.z).sqrt();
    world = Vec3::new(world.x / length, world.y / length, world.z / length);
    let mut ray = Ray::new(camera.pos, world);
    ray.min_t = camera.n_clip;
    ray.max_t = camera.f_clip;
    return ray;
}
