//! Vectors, rays and shapes, generic over the number type.

use crate::scalar::Scalar;
use std::ops::{Add, Mul, Sub};

/// A vector in world space.
#[derive(Clone, Copy, Debug)]
pub struct Vector3<R> {
    /// First coordinate.
    pub x: R,
    /// Second coordinate.
    pub y: R,
    /// Third coordinate.
    pub z: R,
}

impl<R: Scalar> Vector3<R> {
    /// Rounds each component.
    pub fn from_kit(v: kit::Vec3) -> Vector3<R> {
        Vector3 {
            x: R::from_f64(v.x),
            y: R::from_f64(v.y),
            z: R::from_f64(v.z),
        }
    }

    /// Returns the value in `f64`.
    pub fn to_f64(self) -> kit::Vec3 {
        kit::Vec3::new(self.x.to_f64(), self.y.to_f64(), self.z.to_f64())
    }

    /// Returns the dot product.
    #[inline(always)]
    pub fn dot(self, other: Vector3<R>) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Returns the cross product.
    #[inline(always)]
    pub fn cross(self, other: Vector3<R>) -> Vector3<R> {
        Vector3 {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// Returns the component on an axis: 0, 1 or 2.
    #[inline(always)]
    pub fn component(self, axis: usize) -> R {
        [self.x, self.y, self.z][axis]
    }

    /// Permutes the axes cyclically so that `axis` becomes z.
    #[inline(always)]
    pub fn permuted(self, axis: usize) -> Vector3<R> {
        let Vector3 { x, y, z } = self;
        match axis {
            0 => Vector3 { x: y, y: z, z: x },
            1 => Vector3 { x: z, y: x, z: y },
            _ => self,
        }
    }

    /// Returns the axis of the component that is largest in size; the last one of equal ones.
    #[inline(always)]
    pub fn longest_axis(self) -> usize {
        let (x, y, z) = (self.x.abs(), self.y.abs(), self.z.abs());
        let y_or_x = usize::from(y >= x);
        if (z >= x) & (z >= y) { 2 } else { y_or_x }
    }
}

impl<R: Scalar> Add for Vector3<R> {
    type Output = Vector3<R>;
    #[inline(always)]
    fn add(self, other: Vector3<R>) -> Vector3<R> {
        Vector3 {
            x: self.x + other.x,
            y: self.y + other.y,
            z: self.z + other.z,
        }
    }
}

impl<R: Scalar> Sub for Vector3<R> {
    type Output = Vector3<R>;
    #[inline(always)]
    fn sub(self, other: Vector3<R>) -> Vector3<R> {
        Vector3 {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }
}

impl<R: Scalar> Mul<R> for Vector3<R> {
    type Output = Vector3<R>;
    #[inline(always)]
    fn mul(self, s: R) -> Vector3<R> {
        Vector3 {
            x: self.x * s,
            y: self.y * s,
            z: self.z * s,
        }
    }
}

/// The points `o + t·d` with `min_t <= t <= max_t`.
#[derive(Clone, Copy, Debug)]
pub struct Ray<R> {
    /// Origin.
    pub o: Vector3<R>,
    /// Direction; its length is arbitrary.
    pub d: Vector3<R>,
    /// Smallest `t` in the range.
    pub min_t: R,
    /// Largest `t` in the range.
    pub max_t: R,
}

impl<R: Scalar> Ray<R> {
    /// Rounds each component.
    pub fn from_kit(ray: &kit::Ray) -> Ray<R> {
        Ray {
            o: Vector3::from_kit(ray.o),
            d: Vector3::from_kit(ray.d),
            min_t: R::from_f64(ray.min_t),
            max_t: R::from_f64(ray.max_t),
        }
    }

    /// Returns the point `o + t·d`.
    #[inline(always)]
    pub fn at(&self, t: R) -> Vector3<R> {
        self.o + self.d * t
    }

    /// Whether `t` is in the range, ends included. False for NaN.
    #[inline(always)]
    pub fn in_range(&self, t: R) -> bool {
        self.min_t <= t && t <= self.max_t
    }
}

/// A triangle, given by its vertices.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<R> {
    /// First vertex.
    pub p0: Vector3<R>,
    /// Second vertex, of barycentric weight `b1`.
    pub p1: Vector3<R>,
    /// Third vertex, of barycentric weight `b2`.
    pub p2: Vector3<R>,
}

/// A sphere.
#[derive(Clone, Copy, Debug)]
pub struct Sphere<R> {
    /// Centre.
    pub center: Vector3<R>,
    /// Radius.
    pub radius: R,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Aabb<R> {
    /// Corner with the smallest coordinates.
    pub min: Vector3<R>,
    /// Corner with the largest coordinates.
    pub max: Vector3<R>,
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

impl<R: Scalar> Vector3<R> {
    /// Converts to `f64`.
    #[inline(always)]
    fn widened(self) -> Vector3<f64> {
        Vector3 {
            x: self.x.to_f64(),
            y: self.y.to_f64(),
            z: self.z.to_f64(),
        }
    }
}

impl Ray<f32> {
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

impl Shape for kit::Triangle {
    type In<R: Scalar> = Triangle<R>;

    fn rounded<R: Scalar>(&self) -> Triangle<R> {
        Triangle {
            p0: Vector3::from_kit(self.p0),
            p1: Vector3::from_kit(self.p1),
            p2: Vector3::from_kit(self.p2),
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
            center: Vector3::from_kit(self.center),
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
            min: Vector3::from_kit(self.min),
            max: Vector3::from_kit(self.max),
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
