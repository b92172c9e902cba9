//! Vectors, rays and shapes in numbers of any kind.

use crate::real::Real;
use std::ops::{Add, Mul, Sub};

/// Three coordinates, world space.
#[derive(Clone, Copy, Debug)]
pub struct V3<R> {
    /// First.
    pub x: R,
    /// Second.
    pub y: R,
    /// Third.
    pub z: R,
}

impl<R: Real> V3<R> {
    /// The nearest such vector.
    pub fn of(v: kit::Vec3) -> V3<R> {
        V3 {
            x: R::of(v.x),
            y: R::of(v.y),
            z: R::of(v.z),
        }
    }

    /// Its value.
    pub fn wide(self) -> kit::Vec3 {
        kit::Vec3::new(self.x.wide(), self.y.wide(), self.z.wide())
    }

    /// The scalar product.
    #[inline(always)]
    pub fn dot(self, other: V3<R>) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product.
    #[inline(always)]
    pub fn cross(self, other: V3<R>) -> V3<R> {
        V3 {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// The coordinate on an axis: 0, 1 or 2.
    #[inline(always)]
    pub fn on(self, axis: usize) -> R {
        [self.x, self.y, self.z][axis]
    }

    /// With its axes renamed in a circle, so that `axis` becomes z.
    #[inline(always)]
    pub fn turned(self, axis: usize) -> V3<R> {
        let V3 { x, y, z } = self;
        match axis {
            0 => V3 { x: y, y: z, z: x },
            1 => V3 { x: z, y: x, z: y },
            _ => self,
        }
    }

    /// The axis along which it is longest.
    #[inline(always)]
    pub fn longest_axis(self) -> usize {
        let (x, y, z) = (self.x.abs(), self.y.abs(), self.z.abs());
        let y_or_x = usize::from(y >= x);
        if (z >= x) & (z >= y) { 2 } else { y_or_x }
    }
}

impl<R: Real> Add for V3<R> {
    type Output = V3<R>;
    #[inline(always)]
    fn add(self, other: V3<R>) -> V3<R> {
        V3 {
            x: self.x + other.x,
            y: self.y + other.y,
            z: self.z + other.z,
        }
    }
}

impl<R: Real> Sub for V3<R> {
    type Output = V3<R>;
    #[inline(always)]
    fn sub(self, other: V3<R>) -> V3<R> {
        V3 {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }
}

impl<R: Real> Mul<R> for V3<R> {
    type Output = V3<R>;
    #[inline(always)]
    fn mul(self, s: R) -> V3<R> {
        V3 {
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
    pub o: V3<R>,
    /// Direction, of any length.
    pub d: V3<R>,
    /// Nearest `t` that counts.
    pub min_t: R,
    /// Farthest `t` that counts.
    pub max_t: R,
}

impl<R: Real> Ray<R> {
    /// The nearest such ray.
    pub fn of(ray: &kit::Ray) -> Ray<R> {
        Ray {
            o: V3::of(ray.o),
            d: V3::of(ray.d),
            min_t: R::of(ray.min_t),
            max_t: R::of(ray.max_t),
        }
    }

    /// The point `o + t·d`.
    #[inline(always)]
    pub fn at(&self, t: R) -> V3<R> {
        self.o + self.d * t
    }

    /// Whether `t` counts. False for NaN.
    #[inline(always)]
    pub fn in_range(&self, t: R) -> bool {
        self.min_t <= t && t <= self.max_t
    }
}

/// A triangle by its vertices.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<R> {
    /// First vertex.
    pub p0: V3<R>,
    /// Second vertex, of barycentric weight `b1`.
    pub p1: V3<R>,
    /// Third vertex, of barycentric weight `b2`.
    pub p2: V3<R>,
}

/// A sphere.
#[derive(Clone, Copy, Debug)]
pub struct Sphere<R> {
    /// Centre.
    pub center: V3<R>,
    /// Radius.
    pub radius: R,
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
pub struct Aabb<R> {
    /// Corner with the smallest coordinates.
    pub min: V3<R>,
    /// Corner with the largest coordinates.
    pub max: V3<R>,
}

/// A shape of the kit, which can be had in numbers of any kind.
pub trait Shape: Copy + Send + Sync + 'static {
    /// The same in numbers of this kind.
    type In<R: Real>: Copy + Send + Sync + 'static;

    /// Its nearest likeness.
    fn rounded<R: Real>(&self) -> Self::In<R>;

    /// From single to double, without rounding.
    fn widened(single: &Self::In<f32>) -> Self::In<f64>;
}

impl<R: Real> V3<R> {
    /// The same vector in double.
    #[inline(always)]
    fn widened(self) -> V3<f64> {
        V3 {
            x: self.x.wide(),
            y: self.y.wide(),
            z: self.z.wide(),
        }
    }
}

impl Ray<f32> {
    /// The same ray in double.
    #[inline(always)]
    pub fn widened(&self) -> Ray<f64> {
        Ray {
            o: self.o.widened(),
            d: self.d.widened(),
            min_t: self.min_t.wide(),
            max_t: self.max_t.wide(),
        }
    }
}

impl Shape for kit::Triangle {
    type In<R: Real> = Triangle<R>;

    fn rounded<R: Real>(&self) -> Triangle<R> {
        Triangle {
            p0: V3::of(self.p0),
            p1: V3::of(self.p1),
            p2: V3::of(self.p2),
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
    type In<R: Real> = Sphere<R>;

    fn rounded<R: Real>(&self) -> Sphere<R> {
        Sphere {
            center: V3::of(self.center),
            radius: R::of(self.radius),
        }
    }

    #[inline(always)]
    fn widened(single: &Sphere<f32>) -> Sphere<f64> {
        Sphere {
            center: single.center.widened(),
            radius: single.radius.wide(),
        }
    }
}

impl Shape for kit::Aabb {
    type In<R: Real> = Aabb<R>;

    fn rounded<R: Real>(&self) -> Aabb<R> {
        Aabb {
            min: V3::of(self.min),
            max: V3::of(self.max),
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
