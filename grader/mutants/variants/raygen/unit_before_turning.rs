//! Brought to length 1 in camera space, then turned component by component.

pub use base::*;
use kit::{Camera, Ray, Vec2, Vec3};

pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    let [half_w, half_h] = [camera.h_fov, camera.v_fov].map(|fov| (fov * std::f64::consts::PI / 360.0).tan());
    let in_camera = Vec3::new((sensor.x - 0.5) * 2.0 * half_w, (sensor.y - 0.5) * 2.0 * half_h, -1.0);
    let unit = in_camera / in_camera.dot(in_camera).sqrt();
    let [right, up, back] = [camera.c2w.x_axis, camera.c2w.y_axis, camera.c2w.z_axis];
    let d = Vec3::new(
        right.x * unit.x + up.x * unit.y + back.x * unit.z,
        right.y * unit.x + up.y * unit.y + back.y * unit.z,
        right.z * unit.x + up.z * unit.y + back.z * unit.z,
    );
    Ray { min_t: camera.n_clip, max_t: camera.f_clip, ..Ray::new(camera.pos, d) }
}
