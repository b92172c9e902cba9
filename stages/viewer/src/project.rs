//! From world space to the view: where a point appears, and what hides it.

use kit::camera::half_tan;
use kit::{Aabb, Camera, Vec2, Vec3};
use raygen::generate_ray;

/// The projection of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    camera: Camera,
    /// Tangents of half of the angles of view.
    half: Vec2,
}

/// Points nearer to the camera's plane than this have no projection.
const NEAR: f64 = 1e-9;

impl Projection {
    /// The projection of `camera`.
    pub fn new(camera: &Camera) -> Projection {
        Projection {
            camera: *camera,
            half: Vec2::new(half_tan(camera.h_fov), half_tan(camera.v_fov)),
        }
    }

    /// Where `p` appears on the film, in [0, 1]² from the bottom left if it is visible; `None`
    /// behind the camera.
    pub fn point(&self, p: Vec3) -> Option<Vec2> {
        self.of_camera_space(self.in_camera_space(p))
    }

    /// The ends of the part of the segment from `a` to `b` that is in front of the camera.
    pub fn segment(&self, a: Vec3, b: Vec3) -> Option<(Vec3, Vec3)> {
        let near = NEAR.max(
            1e-4 * (self.camera.pos - a)
                .length()
                .min((self.camera.pos - b).length()),
        );
        let (za, zb) = (-self.in_camera_space(a).z, -self.in_camera_space(b).z);
        let at =
            |from: Vec3, to: Vec3, z0: f64, z1: f64| from + (to - from) * ((near - z0) / (z1 - z0));
        match (za >= near, zb >= near) {
            (true, true) => Some((a, b)),
            (true, false) => Some((a, at(b, a, zb, za))),
            (false, true) => Some((at(a, b, za, zb), b)),
            (false, false) => None,
        }
    }

    /// The distance of `p` from the camera.
    pub fn distance(&self, p: Vec3) -> f64 {
        self.camera.pos.distance(p)
    }

    /// The distance of `p` from the plane of the camera, negative behind it.
    pub fn depth(&self, p: Vec3) -> f64 {
        -self.in_camera_space(p).z
    }

    /// The shift in world space, at the distance of `p`, that appears as `shift` on the film:
    /// between two rays of the stage `raygen`.
    pub fn shift_at(&self, p: Vec3, shift: Vec2) -> Vec3 {
        let depth = self.depth(p);
        let at = |sensor: Vec2| {
            let d = generate_ray(&self.camera, sensor).d;
            d * (depth / d.dot(-self.camera.c2w.z_axis))
        };
        let middle = Vec2::splat(0.5);
        at(middle + shift) - at(middle)
    }

    fn in_camera_space(&self, p: Vec3) -> Vec3 {
        self.camera.c2w.transpose() * (p - self.camera.pos)
    }

    fn of_camera_space(&self, q: Vec3) -> Option<Vec2> {
        let depth = -q.z;
        (depth > NEAR).then(|| {
            let on_plane = Vec2::new(q.x, q.y) / depth / self.half;
            0.5 * on_plane + 0.5
        })
    }
}

/// Whether a box can be drawn: it is neither empty nor endless.
pub fn is_drawn(b: &Aabb) -> bool {
    !b.is_empty() && b.min.is_finite() && b.max.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Mat3;

    fn camera() -> Camera {
        Camera {
            pos: Vec3::new(1.0, 2.0, 3.0),
            c2w: Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y).expect("a view"),
            h_fov: 70.0,
            v_fov: 50.0,
            n_clip: 0.0,
            f_clip: 1e30,
        }
    }

    #[test]
    fn the_target_is_in_the_middle_and_nothing_behind_is_visible() {
        let view = Projection::new(&camera());
        let middle = view.point(Vec3::ZERO).expect("in front");
        assert!(middle.distance(Vec2::splat(0.5)) < 1e-12);
        assert_eq!(view.point(Vec3::new(2.0, 4.0, 6.0)), None);
    }

    #[test]
    fn shifts_agree_with_projections() {
        let view = Projection::new(&camera());
        let p = Vec3::new(0.3, -0.2, 0.1);
        let shift = Vec2::new(0.1, -0.05);
        let moved = p + view.shift_at(p, shift);
        let seen = view.point(moved).expect("in front") - view.point(p).expect("in front");
        assert!(seen.distance(shift) < 1e-12, "{seen}");
    }

    #[test]
    fn segments_are_clipped_at_the_camera() {
        let view = Projection::new(&Camera {
            pos: Vec3::ZERO,
            c2w: Mat3::IDENTITY,
            ..camera()
        });
        let (a, b) = (Vec3::new(0.0, 0.0, -5.0), Vec3::new(0.0, 1.0, 5.0));
        let (from, to) = view.segment(a, b).expect("partly in front");
        assert_eq!(from, a);
        assert!(to.z < 0.0 && to.z > -0.1, "{to}");
        assert_eq!(view.segment(b, b + Vec3::Z), None);
    }
}
