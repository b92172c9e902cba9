//! A plane that cuts the scene of a 3D view open.

use bbox::intersect_bbox;
use kit::{Aabb, Ray, Vec3};

/// A plane across an axis. What is on its removed side is not shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The axis: 0, 1 or 2 for x, y or z.
    pub axis: usize,
    /// The coordinate of the plane.
    pub at: f64,
    /// Whether smaller coordinates are kept, else larger ones.
    pub keeps_smaller: bool,
}

impl Cut {
    /// The names of the axes.
    pub const AXES: [&str; 3] = ["x", "y", "z"];

    /// A cut through the middle of `bounds` that removes the side of `camera`.
    pub fn through_middle(axis: usize, bounds: &Aabb, camera: Vec3) -> Cut {
        let at = 0.5 * (bounds.min[axis] + bounds.max[axis]);
        Cut {
            axis,
            at,
            keeps_smaller: camera[axis] > at,
        }
    }

    /// Whether a point is on the kept side.
    pub fn keeps(&self, p: Vec3) -> bool {
        match self.keeps_smaller {
            true => p[self.axis] <= self.at,
            false => p[self.axis] >= self.at,
        }
    }

    /// Limits a ray to the kept side; `None` if it never gets there. The side is a box without ends
    /// elsewhere, and whoever intersects boxes has written this.
    pub fn limit(&self, ray: &Ray) -> Option<Ray> {
        let mut kept = Aabb {
            min: Vec3::NEG_INFINITY,
            max: Vec3::INFINITY,
        };
        match self.keeps_smaller {
            true => kept.max[self.axis] = self.at,
            false => kept.min[self.axis] = self.at,
        }
        let inside = intersect_bbox(&kept, ray)?;
        Some(Ray {
            min_t: inside.min,
            max_t: inside.max,
            ..*ray
        })
    }

    /// The corners of the part of the plane that is in `bounds`, in order.
    pub fn corners(&self, bounds: &Aabb) -> [Vec3; 4] {
        let [u, v] = [(self.axis + 1) % 3, (self.axis + 2) % 3];
        let corner = |a: f64, b: f64| {
            let mut p = Vec3::ZERO;
            p[self.axis] = self.at;
            (p[u], p[v]) = (a, b);
            p
        };
        let (min, max) = (bounds.min, bounds.max);
        [
            corner(min[u], min[v]),
            corner(max[u], min[v]),
            corner(max[u], max[v]),
            corner(min[u], max[v]),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUT: Cut = Cut {
        axis: 1,
        at: 2.0,
        keeps_smaller: true,
    };

    /// Asserts which part of the range [0, 100] of a ray is kept.
    #[track_caller]
    fn assert_kept(cut: Cut, o: Vec3, d: Vec3, expected: Option<[f64; 2]>) {
        let ray = Ray {
            min_t: 0.0,
            max_t: 100.0,
            ..Ray::new(o, d)
        };
        let kept = cut.limit(&ray).map(|ray| [ray.min_t, ray.max_t]);
        // The end of the interval in a box may be a little late.
        let is_near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a == c && (b - d).abs() < 1e-12;
        let is_equal = match (kept, expected) {
            (Some(kept), Some(expected)) => is_near(kept, expected),
            _ => kept == expected,
        };
        assert!(is_equal, "{kept:?} instead of {expected:?}");
    }

    #[test]
    fn rays_end_or_start_at_the_plane() {
        let above = Vec3::new(0.0, 7.0, 0.0);
        assert_kept(CUT, Vec3::ZERO, Vec3::Y, Some([0.0, 2.0]));
        assert_kept(CUT, Vec3::ZERO, -Vec3::Y, Some([0.0, 100.0]));
        assert_kept(CUT, above, -Vec3::Y, Some([5.0, 100.0]));
        assert_kept(CUT, above, Vec3::Y, None);
        let in_plane = Vec3::new(0.0, 2.0, 0.0);
        assert_kept(CUT, in_plane, -Vec3::Y, Some([0.0, 100.0]));
        assert_kept(CUT, in_plane, Vec3::Y, Some([0.0, 0.0]));
        let other_side = Cut {
            keeps_smaller: false,
            ..CUT
        };
        assert_kept(other_side, above, -Vec3::Y, Some([0.0, 5.0]));
    }

    #[test]
    fn rays_along_the_plane_stay_on_their_side() {
        let at = |y| Vec3::new(0.0, y, 0.0);
        assert_kept(CUT, at(0.0), Vec3::X, Some([0.0, 100.0]));
        assert_kept(CUT, at(2.0), Vec3::X, Some([0.0, 100.0]));
        assert_kept(CUT, at(3.0), Vec3::X, None);
    }

    #[test]
    fn a_new_cut_removes_the_side_of_the_camera() {
        let bounds = Aabb {
            min: Vec3::ZERO,
            max: Vec3::ONE,
        };
        let camera = Vec3::new(5.0, -5.0, 0.5);
        let cut = Cut::through_middle(0, &bounds, camera);
        assert_eq!((cut.at, cut.keeps(camera)), (0.5, false));
        assert!(!Cut::through_middle(1, &bounds, camera).keeps(camera));
        assert!(cut.corners(&bounds).iter().all(|corner| corner.x == 0.5));
    }
}
