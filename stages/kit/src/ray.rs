//! Rays.

use crate::Vec3;

/// A ray: the points `o + t·d` with `min_t <= t <= max_t`, in world space.
///
/// Both ends of the range count. `d` need not have unit length: `t` counts multiples of the length
/// of `d`.
///
/// ```
/// use kit::{Ray, Vec3};
/// let mut ray = Ray::new(Vec3::ZERO, Vec3::new(0.0, 0.0, 2.0));
/// assert_eq!(ray.at(3.0), Vec3::new(0.0, 0.0, 6.0));
/// ray.max_t = 3.0;
/// assert!(ray.in_range(3.0) && !ray.in_range(3.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// Direction.
    pub d: Vec3,
    /// Smallest `t` of the range.
    pub min_t: f64,
    /// Largest `t` of the range. A hit reduces it to its own `t`, so that farther primitives are
    /// skipped.
    pub max_t: f64,
}

impl Ray {
    /// The ray from `o` along `d` with the range [0, ∞].
    pub fn new(o: Vec3, d: Vec3) -> Ray {
        Ray {
            o,
            d,
            min_t: 0.0,
            max_t: f64::INFINITY,
        }
    }

    /// The point `o + t·d`.
    #[inline]
    pub fn at(&self, t: f64) -> Vec3 {
        self.o + t * self.d
    }

    /// Whether `min_t <= t <= max_t`. False if `t` is NaN.
    #[inline]
    pub fn in_range(&self, t: f64) -> bool {
        self.min_t <= t && t <= self.max_t
    }
}
