//! Rays and shapes over any number type.

use crate::real::Real;
use crate::scalar::Scalar;
use crate::vec3::Vec3;

/// The points `o + t·d` with `min_t <= t <= max_t`.
///
/// ```
/// let exact = kit::Ray::new(kit::Vec3::ZERO, kit::Vec3::new(0.0, 0.0, 0.1));
/// let ray = lanes::Ray::<f32>::from_kit(&exact);
/// assert_eq!(ray.at(10.0).z, 1.0);
/// assert!(ray.in_range(0.0) && !ray.in_range(-1.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Ray<R> {
    /// Origin.
    pub o: Vec3<R>,
    /// Direction; its length is arbitrary.
    pub d: Vec3<R>,
    /// Smallest `t` in the range.
    pub min_t: R,
    /// Largest `t` in the range.
    pub max_t: R,
}

impl<R: Real> Ray<R> {
    /// The point `o + t·d`.
    #[inline(always)]
    pub fn at(&self, t: R) -> Vec3<R> {
        self.o + self.d * t
    }

    /// Whether `t` is in the range, ends included. No for NaN.
    #[inline(always)]
    pub fn in_range(&self, t: R) -> R::Mask {
        self.min_t.at_most(t) & t.at_most(self.max_t)
    }
}

/// A triangle, given by its vertices.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<R> {
    /// First vertex.
    pub p0: Vec3<R>,
    /// Second vertex, of barycentric weight `b1`.
    pub p1: Vec3<R>,
    /// Third vertex, of barycentric weight `b2`.
    pub p2: Vec3<R>,
}

/// A sphere.
#[derive(Clone, Copy, Debug)]
pub struct Sphere<R> {
    /// Centre.
    pub center: Vec3<R>,
    /// Radius.
    pub radius: R,
}

impl<R: Scalar> Ray<R> {
    /// Rounds each number.
    pub fn from_kit(ray: &kit::Ray) -> Ray<R> {
        Ray {
            o: Vec3::from_kit(ray.o),
            d: Vec3::from_kit(ray.d),
            min_t: R::from_f64(ray.min_t),
            max_t: R::from_f64(ray.max_t),
        }
    }

    /// Converts to `f64`.
    #[inline(always)]
    pub fn widened(&self) -> Ray<f64> {
        Ray {
            o: self.o.widened(),
            d: self.d.widened(),
            min_t: self.min_t.to_f64(),
            max_t: self.max_t.to_f64(),
        }
    }
}
