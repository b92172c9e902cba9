//! A ray/box test for any ray. It is conservative: it never misses a box with a primitive that the
//! ray hits.

use crate::layout::space::{LocalRay, TreeSpace};
use kit::{Aabb, Ray, Vec3};

/// Tests one box after the other in double precision. For any ray.
pub(crate) struct ScalarBoxTest {
    /// The coordinates are finite, or all NaN, which hits every box.
    local: LocalRay,
    min_t: f64,
    max_t: f64,
}

/// The range and the exits are widened by this share: more than the rounding errors of a plane's
/// `t` and of any hit's `t`.
const SLACK: f64 = 64.0 * f64::EPSILON;

impl ScalarBoxTest {
    pub(crate) fn new(ray: &Ray, space: &TreeSpace) -> ScalarBoxTest {
        let mut local = space.ray(ray);
        if !(local.o.is_finite() && local.d.is_finite()) {
            (local.o, local.d) = (Vec3::NAN, Vec3::NAN);
        }
        let min_t = ray.min_t * local.speed;
        let mut test = ScalarBoxTest {
            local,
            // `max` ignores a NaN: such a range has no hits anyway.
            min_t: f64::NEG_INFINITY.max(min_t - SLACK * min_t.abs()),
            max_t: 0.0,
        };
        if test.min_t == f64::INFINITY {
            test.min_t = f64::NEG_INFINITY;
        }
        test.shorten(ray.max_t);
        test
    }

    /// The `t` at which the ray enters the box from `min` to `max`, if it hits. For a direction
    /// component of 0 the quotients are infinite, or NaN for an origin in the plane; comparisons
    /// ignore NaN.
    pub(crate) fn entry(&self, Aabb { min, max }: Aabb) -> Option<f64> {
        let LocalRay { o, d, .. } = self.local;
        let (mut entry, mut exit) = (self.min_t, self.max_t);
        for axis in 0..3 {
            let (first, last) = if d[axis].is_sign_negative() {
                (max[axis], min[axis])
            } else {
                (min[axis], max[axis])
            };
            let (t_first, t_last) = ((first - o[axis]) / d[axis], (last - o[axis]) / d[axis]);
            if t_first > entry {
                entry = t_first;
            }
            if t_last < exit {
                exit = t_last;
            }
        }
        (min.cmple(max).all() && entry <= exit + SLACK * exit.abs()).then_some(entry)
    }

    /// Shortens the range to `max_t` of the ray in world space.
    pub(crate) fn shorten(&mut self, max_t: f64) {
        self.max_t = max_t * self.local.speed;
        if self.max_t.is_nan() {
            self.max_t = f64::INFINITY;
        }
    }

    /// Whether a box that the ray enters at `entry` is still in the range.
    pub(crate) fn is_within(&self, entry: f64) -> bool {
        entry <= self.max_t + SLACK * self.max_t.abs()
    }
}
