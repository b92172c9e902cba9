//! Projects the corners of a polygon onto a plane.

use kit::{Vec2, Vec3};

/// The projection along the axis that is nearest to a polygon's normal (Newell's method), such that
/// the winding order is counter-clockwise. Coordinates are relative to the first corner and to the
/// size of the polygon, so that nothing underflows or overflows.
pub(super) struct Projection {
    origin: Vec3,
    size: f64,
    normal: Vec3,
}

impl Projection {
    /// `None` if the polygon has no area.
    pub(super) fn of(corners: &[Vec3]) -> Option<Projection> {
        let origin = corners[0];
        let size = corners.iter().fold(0.0, |size: f64, p| {
            size.max((*p - origin).abs().max_element())
        });
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let unit: Vec<Vec3> = corners.iter().map(|p| (*p - origin) / size).collect();
        let next = |i: usize| unit[(i + 1) % unit.len()];
        let normal: Vec3 = (0..unit.len()).map(|i| unit[i].cross(next(i))).sum();
        let has_area = normal.abs().max_element() > 0.0;
        has_area.then_some(Projection {
            origin,
            size,
            normal,
        })
    }

    /// Drops the coordinate in which the normal is largest, and keeps the winding order.
    pub(super) fn apply(&self, p: Vec3) -> Vec2 {
        let p = (p - self.origin) / self.size;
        let normal = self.normal;
        let magnitude = normal.abs();
        if magnitude.z >= magnitude.x && magnitude.z >= magnitude.y {
            Vec2::new(p.x * normal.z.signum(), p.y)
        } else if magnitude.y >= magnitude.x {
            Vec2::new(p.z * normal.y.signum(), p.x)
        } else {
            Vec2::new(p.y * normal.x.signum(), p.z)
        }
    }
}

/// Twice the signed area of the triangle `a b c`: positive if it is counter-clockwise.
pub(super) fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    (b - a).perp_dot(c - a)
}
