//! A step right and a step up along the camera's own axes.

pub use base::*;
use kit::{Camera, Ray, Vec2};

pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    let right = camera.c2w.x_axis * (camera.h_fov.to_radians() / 2.0).tan();
    let up = camera.c2w.y_axis * (camera.v_fov.to_radians() / 2.0).tan();
    let d = right * (sensor.x * 2.0 - 1.0) + up * (sensor.y * 2.0 - 1.0) - camera.c2w.z_axis;
    let mut ray = Ray::new(camera.pos, d / d.length());
    ray.min_t = camera.n_clip;
    ray.max_t = camera.f_clip;
    ray
}
