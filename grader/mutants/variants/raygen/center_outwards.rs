//! Samples summed from the last to the first by recursion, seen from the centre of the film.

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
    let pixel = Vec2::new(1.0 / f64::from(film.w), 1.0 / f64::from(film.h));
    let center = (Vec2::new(f64::from(x), f64::from(y)) + 0.5) * pixel;
    let colours: Vec<Spectrum> = (0..ns_aa)
        .map(|_| {
            // Turned by a quarter: as uniform as it was.
            let turned = if ns_aa > 1 { sampler.get_sample().yx_() - 0.5 } else { Vec2::ZERO };
            let ray = camera_ray(center + turned * pixel);
            trace_ray(&ray, sampler)
        })
        .collect();
    let share = 1.0 / colours.len().max(1) as f64;
    PixelEstimate { radiance: colours.iter().rev().map(|c| *c * share).sum(), samples: ns_aa }
}

trait Turned {
    fn yx_(self) -> Vec2;
}

impl Turned for Vec2 {
    fn yx_(self) -> Vec2 {
        Vec2::new(1.0 - self.y, self.x)
    }
}

pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    let depth = 1.0 / (camera.h_fov.to_radians() / 2.0).tan();
    let aspect = (camera.v_fov.to_radians() / 2.0).tan() * depth;
    let s = 2.0 * sensor - Vec2::ONE;
    let target = camera.pos + camera.c2w * Vec3::new(s.x, aspect * s.y, -depth);
    Ray { min_t: camera.n_clip, max_t: camera.f_clip, ..Ray::new(camera.pos, (target - camera.pos).normalize()) }
}
