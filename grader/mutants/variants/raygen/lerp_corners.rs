//! The sensor's corners as the assignment gives them, interpolated.

pub use base::*;
use kit::{Camera, Ray, Vec2, Vec3};

fn lerp(a: f64, b: f64, s: f64) -> f64 {
    a * (1.0 - s) + b * s
}

pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    let w = (camera.h_fov.to_radians() * 0.5).tan();
    let h = (camera.v_fov.to_radians() * 0.5).tan();
    let d = Vec3::new(lerp(-w, w, sensor.x), lerp(-h, h, sensor.y), -1.0);
    Ray { o: camera.pos, d: camera.c2w.mul_vec3(d).normalize(), min_t: camera.n_clip, max_t: camera.f_clip }
}
