// BEGIN SOLUTION(part6.task2)
//! Eight vectors, one per lane. Repeats the arithmetic of [`kit::Vec3`] operation by operation, so
//! every lane has the bits of the scalar vector.

use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Vec3;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number of paths in a packet.
pub(crate) const LANES: usize = 8;

/// A vector or a colour in each lane.
#[derive(Clone, Copy)]
pub(crate) struct Vec3x8<S: Simd> {
    pub(crate) x: f64x8<S>,
    pub(crate) y: f64x8<S>,
    pub(crate) z: f64x8<S>,
}

impl<S: Simd> Vec3x8<S> {
    #[inline(always)]
    pub(crate) fn splat(simd: S, v: Vec3) -> Vec3x8<S> {
        Vec3x8 {
            x: f64x8::splat(simd, v.x),
            y: f64x8::splat(simd, v.y),
            z: f64x8::splat(simd, v.z),
        }
    }

    /// The vectors that `of` returns for each lane.
    #[inline(always)]
    pub(crate) fn gather(simd: S, of: impl Fn(usize) -> [f64; 3]) -> Vec3x8<S> {
        Vec3x8 {
            x: f64x8::from_fn(simd, |lane| of(lane)[0]),
            y: f64x8::from_fn(simd, |lane| of(lane)[1]),
            z: f64x8::from_fn(simd, |lane| of(lane)[2]),
        }
    }

    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, v: [f64; 3]) {
        (self.x[lane], self.y[lane], self.z[lane]) = (v[0], v[1], v[2]);
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Vec3x8<S>) -> f64x8<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8 {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Vec3x8<S> {
        Vec3x8 {
            x: self.x.abs(),
            y: self.y.abs(),
            z: self.z.abs(),
        }
    }

    #[inline(always)]
    pub(crate) fn max(self, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8 {
            x: self.x.max(other.x),
            y: self.y.max(other.y),
            z: self.z.max(other.z),
        }
    }

    #[inline(always)]
    pub(crate) fn length(self) -> f64x8<S> {
        self.dot(self).sqrt()
    }

    /// `self` in the lanes of `mask`, `other` elsewhere.
    #[inline(always)]
    pub(crate) fn masked_or(self, mask: mask64x8<S>, other: Vec3x8<S>) -> Vec3x8<S> {
        Vec3x8 {
            x: mask.select(self.x, other.x),
            y: mask.select(self.y, other.y),
            z: mask.select(self.z, other.z),
        }
    }
}

macro_rules! by_component {
    ($($operator:ident $method:ident),*) => {$(
        impl<S: Simd> $operator for Vec3x8<S> {
            type Output = Vec3x8<S>;
            #[inline(always)]
            fn $method(self, other: Vec3x8<S>) -> Vec3x8<S> {
                Vec3x8 {
                    x: self.x.$method(other.x),
                    y: self.y.$method(other.y),
                    z: self.z.$method(other.z),
                }
            }
        }
    )*};
}

by_component!(Add add, Sub sub, Mul mul);

impl<S: Simd> Mul<f64x8<S>> for Vec3x8<S> {
    type Output = Vec3x8<S>;
    #[inline(always)]
    fn mul(self, s: f64x8<S>) -> Vec3x8<S> {
        Vec3x8 {
            x: self.x * s,
            y: self.y * s,
            z: self.z * s,
        }
    }
}

impl<S: Simd> Div<f64x8<S>> for Vec3x8<S> {
    type Output = Vec3x8<S>;
    #[inline(always)]
    fn div(self, s: f64x8<S>) -> Vec3x8<S> {
        Vec3x8 {
            x: self.x / s,
            y: self.y / s,
            z: self.z / s,
        }
    }
}

impl<S: Simd> Neg for Vec3x8<S> {
    type Output = Vec3x8<S>;
    #[inline(always)]
    fn neg(self) -> Vec3x8<S> {
        Vec3x8 {
            x: -self.x,
            y: -self.y,
            z: -self.z,
        }
    }
}
// END SOLUTION(part6.task2)
