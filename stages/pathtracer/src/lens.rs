//! Depth of field: a camera with a lens instead of a pinhole.

use kit::{Camera, Ray, Vec2, Vec3, math};
use std::f64::consts::TAU;

/// A thin lens in the place of the pinhole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Its radius in scene units; 0 is a pinhole.
    pub radius: f64,
    /// Distance from the lens to the plane that is sharp, along the viewing direction, `> 0`.
    pub focus: f64,
}

impl Lens {
    /// The pinhole's `ray`, sent through a point of the lens instead, which `u` in [0, 1)² picks uniformly.
    ///
    /// Where the ray meets the plane in focus, all rays through the lens meet: a point there is sharp, others spread into
    /// discs (Cook, Porter, Carpenter: "Distributed ray tracing", SIGGRAPH 1984). Radius 0 gives the ray back, bit for bit.
    /// The clip distances stay what they are along the ray.
    pub fn refract(&self, camera: &Camera, ray: &Ray, u: Vec2) -> Ray {
        if self.radius == 0.0 {
            return *ray;
        }
        let (right, up, backward) = (camera.c2w.x_axis, camera.c2w.y_axis, camera.c2w.z_axis);
        let sharp = ray.at(self.focus / -ray.d.dot(backward));
        let (sin, cos) = math::sin_cos(TAU * u.y);
        let r = self.radius * u.x.sqrt();
        let o: Vec3 = ray.o + r * cos * right + r * sin * up;
        Ray {
            o,
            d: (sharp - o).normalize(),
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
    fn rays_of_a_pixel_meet_in_the_plane_in_focus() {
        let camera = camera();
        let lens = Lens {
            radius: 0.3,
            focus: 2.5,
        };
        let pinhole = Ray::new(
            camera.pos,
            camera.c2w * Vec3::new(0.2, -0.1, -1.0).normalize(),
        );
        let sharp = camera.pos + camera.c2w * (2.5 * Vec3::new(0.2, -0.1, -1.0));
        for i in 0..64 {
            let u = Vec2::new(f64::from(i) / 64.0, f64::from(i * 37 % 64) / 64.0);
            let ray = lens.refract(&camera, &pinhole, u);
            let beside = (sharp - ray.o).cross(ray.d).length();
            assert!(beside < 1e-14 && (ray.d.length() - 1.0).abs() < 1e-15);
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
