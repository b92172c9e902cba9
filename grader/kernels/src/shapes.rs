//! Boxes, and the shapes of `kit` in other number types.

pub use lanes::{Ray, Sphere, Triangle, Vec3};

use lanes::Scalar;

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Aabb<R> {
    /// Corner with the smallest coordinates.
    pub min: Vec3<R>,
    /// Corner with the largest coordinates.
    pub max: Vec3<R>,
}

/// A shape of `kit` that can be converted to other number types.
pub trait Shape: Copy + Send + Sync + 'static {
    /// The shape with this number type.
    type In<R: Scalar>: Copy + Send + Sync + 'static;

    /// Rounds each number.
    fn rounded<R: Scalar>(&self) -> Self::In<R>;

    /// Converts from `f32` to `f64`, without rounding.
    fn widened(single: &Self::In<f32>) -> Self::In<f64>;
}

impl Shape for kit::Triangle {
    type In<R: Scalar> = Triangle<R>;

    fn rounded<R: Scalar>(&self) -> Triangle<R> {
        Triangle {
            p0: Vec3::from_kit(self.p0),
            p1: Vec3::from_kit(self.p1),
            p2: Vec3::from_kit(self.p2),
        }
    }

    #[inline(always)]
    fn widened(single: &Triangle<f32>) -> Triangle<f64> {
        Triangle {
            p0: single.p0.widened(),
            p1: single.p1.widened(),
            p2: single.p2.widened(),
        }
    }
}

impl Shape for kit::Sphere {
    type In<R: Scalar> = Sphere<R>;

    fn rounded<R: Scalar>(&self) -> Sphere<R> {
        Sphere {
            center: Vec3::from_kit(self.center),
            radius: R::from_f64(self.radius),
        }
    }

    #[inline(always)]
    fn widened(single: &Sphere<f32>) -> Sphere<f64> {
        Sphere {
            center: single.center.widened(),
            radius: single.radius.to_f64(),
        }
    }
}

impl Shape for kit::Aabb {
    type In<R: Scalar> = Aabb<R>;

    fn rounded<R: Scalar>(&self) -> Aabb<R> {
        Aabb {
            min: Vec3::from_kit(self.min),
            max: Vec3::from_kit(self.max),
        }
    }

    #[inline(always)]
    fn widened(single: &Aabb<f32>) -> Aabb<f64> {
        Aabb {
            min: single.min.widened(),
            max: single.max.widened(),
        }
    }
}
