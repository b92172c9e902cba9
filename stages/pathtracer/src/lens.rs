//! Depth of field: a thin lens instead of a pinhole.

use kit::{Camera, Ray, Vec2, Vec3, math};
use std::f64::consts::TAU;

/// A thin lens at the camera position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius in scene units; 0 is a pinhole.
    pub radius: f64,
    /// Distance from the lens to the plane of focus, along the viewing direction, `> 0`.
    pub focus: f64,
}

impl Lens {
    /// Replaces the pinhole's `ray` by one through a point of the lens, chosen uniformly by `u` in
    /// [0, 1)².
    ///
    /// All rays through the lens intersect where `ray` intersects the plane of focus: points there
    /// are sharp, others blur to discs (Cook, Porter, Carpenter, "Distributed ray tracing",
    /// SIGGRAPH 1984). With radius 0 the result is `ray`, bit for bit. The range of the ray does
    /// not change.
    pub fn refract(&self, camera: &Camera, ray: &Ray, u: Vec2) -> Ray {
        if self.radius == 0.0 {
            return *ray;
        }
        let (right, up, backward) = (camera.c2w.x_axis, camera.c2w.y_axis, camera.c2w.z_axis);
        let focus = ray.at(self.focus / -ray.d.dot(backward));
        let (sin, cos) = math::sin_cos(TAU * u.y);
        let r = self.radius * u.x.sqrt();
        let o: Vec3 = ray.o + r * cos * right + r * sin * up;
        Ray {
            o,
            d: (focus - o).normalize(),
            ..*ray
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let pos = Vec3::new(1.0, 2.0, 3.0);
        Camera {
            pos,
            c2w: Camera::look_at(pos, Vec3::ZERO, Vec3::Y).expect("a view"),
            h_fov: 50.0,
            v_fov: 40.0,
            n_clip: 0.0,
            f_clip: 100.0,
        }
    }

    #[test]
    fn rays_of_a_pixel_intersect_in_the_plane_of_focus() {
        let camera = camera();
        let lens = Lens {
            radius: 0.3,
            focus: 2.5,
        };
        let pinhole = Ray::new(
            camera.pos,
            camera.c2w * Vec3::new(0.2, -0.1, -1.0).normalize(),
        );
        let focus = camera.pos + camera.c2w * (2.5 * Vec3::new(0.2, -0.1, -1.0));
        for i in 0..64 {
            let u = Vec2::new(f64::from(i) / 64.0, f64::from(i * 37 % 64) / 64.0);
            let ray = lens.refract(&camera, &pinhole, u);
            let distance = (focus - ray.o).cross(ray.d).length();
            assert!(distance < 1e-14 && (ray.d.length() - 1.0).abs() < 1e-15);
            let on_lens = camera.c2w.transpose() * (ray.o - camera.pos);
            assert!(on_lens.z.abs() < 1e-15 && on_lens.length() <= 0.3);
        }
    }

    #[test]
    fn radius_zero_is_the_pinhole() {
        let lens = Lens {
            radius: 0.0,
            focus: 1.0,
        };
        let ray = Ray::new(camera().pos, Vec3::X);
        assert_eq!(lens.refract(&camera(), &ray, Vec2::splat(0.7)), ray);
    }
}
