//! A plane that cuts the scene of a 3D view open.

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

    /// Limits a ray to the kept side; `None` if it never gets there.
    pub fn limit(&self, ray: &Ray) -> Option<Ray> {
        let side = if self.keeps_smaller { 1.0 } else { -1.0 };
        // How far the ray is on the kept side, at its origin, and by how much that grows with t.
        let start = side * (self.at - ray.o[self.axis]);
        let rate = -side * ray.d[self.axis];
        let crossing = -start / rate;
        if start > 0.0 || start == 0.0 && rate >= 0.0 {
            let end = if rate < 0.0 { crossing } else { ray.max_t };
            return Some(Ray {
                max_t: ray.max_t.min(end),
                ..*ray
            });
        }
        (rate > 0.0).then(|| Ray {
            min_t: ray.min_t.max(crossing),
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

    fn range(cut: Cut, o: Vec3, d: Vec3) -> Option<[f64; 2]> {
        let ray = Ray {
            min_t: 0.0,
            max_t: 100.0,
            ..Ray::new(o, d)
        };
        cut.limit(&ray).map(|ray| [ray.min_t, ray.max_t])
    }

    #[test]
    fn rays_end_or_start_at_the_plane() {
        let above = Vec3::new(0.0, 7.0, 0.0);
        assert_eq!(range(CUT, Vec3::ZERO, Vec3::Y), Some([0.0, 2.0]));
        assert_eq!(range(CUT, Vec3::ZERO, -Vec3::Y), Some([0.0, 100.0]));
        assert_eq!(range(CUT, above, -Vec3::Y), Some([5.0, 100.0]));
        assert_eq!(range(CUT, above, Vec3::Y), None);
        // A ray that starts in the plane is on the side where it goes.
        let in_plane = Vec3::new(0.0, 2.0, 0.0);
        assert_eq!(range(CUT, in_plane, -Vec3::Y), Some([0.0, 100.0]));
        assert_eq!(range(CUT, in_plane, Vec3::Y), None);
        let other_side = Cut {
            keeps_smaller: false,
            ..CUT
        };
        assert_eq!(range(other_side, above, -Vec3::Y), Some([0.0, 5.0]));
    }

    #[test]
    fn rays_along_the_plane_stay_on_their_side() {
        assert_eq!(range(CUT, Vec3::ZERO, Vec3::X), Some([0.0, 100.0]));
        assert_eq!(
            range(CUT, Vec3::new(0.0, 2.0, 0.0), Vec3::X),
            Some([0.0, 100.0])
        );
        assert_eq!(range(CUT, Vec3::new(0.0, 3.0, 0.0), Vec3::X), None);
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
