//! Vectors over any number type.

use crate::real::{Mask, Real};
use crate::scalar::Scalar;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A vector, a point or a colour; with numbers of several lanes, one in each lane.
///
/// Its operations are those of [`kit::Vec3`], in the same order, so that all bits are equal.
///
/// ```
/// use lanes::Vec3;
/// let x = Vec3 { x: 1.0_f32, y: 0.0, z: 0.0 };
/// let y = Vec3 { x: 0.0, y: 2.0, z: 0.0 };
/// assert_eq!(x.cross(y).to_f64(), kit::Vec3::new(0.0, 0.0, 2.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Vec3<R> {
    /// First coordinate.
    pub x: R,
    /// Second coordinate.
    pub y: R,
    /// Third coordinate.
    pub z: R,
}

impl<R: Real> Vec3<R> {
    /// `v`, rounded, in as many lanes as `like` has.
    #[inline(always)]
    pub fn constant(like: R, v: kit::Vec3) -> Vec3<R> {
        Vec3 {
            x: like.constant(v.x),
            y: like.constant(v.y),
            z: like.constant(v.z),
        }
    }

    /// The dot product.
    #[inline(always)]
    pub fn dot(self, other: Vec3<R>) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product.
    #[inline(always)]
    pub fn cross(self, other: Vec3<R>) -> Vec3<R> {
        Vec3 {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// The length.
    #[inline(always)]
    pub fn length(self) -> R {
        self.dot(self).sqrt()
    }

    /// The absolute values of the coordinates.
    #[inline(always)]
    pub fn abs(self) -> Vec3<R> {
        Vec3 {
            x: self.x.abs(),
            y: self.y.abs(),
            z: self.z.abs(),
        }
    }

    /// The larger number on each axis; of a number and a NaN it may be either.
    #[inline(always)]
    pub fn larger(self, other: Vec3<R>) -> Vec3<R> {
        Vec3 {
            x: self.x.larger(other.x),
            y: self.y.larger(other.y),
            z: self.z.larger(other.z),
        }
    }

    /// `self` in the lanes of `mask`, `other` elsewhere.
    #[inline(always)]
    pub fn masked_or(self, mask: R::Mask, other: Vec3<R>) -> Vec3<R> {
        Vec3 {
            x: mask.choose(self.x, other.x),
            y: mask.choose(self.y, other.y),
            z: mask.choose(self.z, other.z),
        }
    }
}

impl<R: Scalar> Vec3<R> {
    /// Rounds each coordinate.
    pub fn from_kit(v: kit::Vec3) -> Vec3<R> {
        Vec3 {
            x: R::from_f64(v.x),
            y: R::from_f64(v.y),
            z: R::from_f64(v.z),
        }
    }

    /// The value in `f64`.
    pub fn to_f64(self) -> kit::Vec3 {
        kit::Vec3::new(self.x.to_f64(), self.y.to_f64(), self.z.to_f64())
    }

    /// Converts to `f64`.
    #[inline(always)]
    pub fn widened(self) -> Vec3<f64> {
        Vec3 {
            x: self.x.to_f64(),
            y: self.y.to_f64(),
            z: self.z.to_f64(),
        }
    }

    /// The coordinate on an axis: 0, 1 or 2.
    #[inline(always)]
    pub fn component(self, axis: usize) -> R {
        [self.x, self.y, self.z][axis]
    }

    /// Permutes the axes cyclically so that `axis` becomes z. For a single number this is faster
    /// than `triangle::Axes`, which chooses in each lane.
    #[inline(always)]
    pub fn permuted(self, axis: usize) -> Vec3<R> {
        let Vec3 { x, y, z } = self;
        match axis {
            0 => Vec3 { x: y, y: z, z: x },
            1 => Vec3 { x: z, y: x, z: y },
            _ => self,
        }
    }

    /// The axis of the coordinate that is largest in size; the last one of equal ones.
    #[inline(always)]
    pub fn longest_axis(self) -> usize {
        let (x, y, z) = (self.x.abs(), self.y.abs(), self.z.abs());
        let y_or_x = usize::from(y >= x);
        if (z >= x) & (z >= y) { 2 } else { y_or_x }
    }
}

macro_rules! by_coordinate {
    ($($operator:ident $method:ident),*) => {$(
        impl<R: Real> $operator for Vec3<R> {
            type Output = Vec3<R>;
            #[inline(always)]
            fn $method(self, other: Vec3<R>) -> Vec3<R> {
                Vec3 {
                    x: self.x.$method(other.x),
                    y: self.y.$method(other.y),
                    z: self.z.$method(other.z),
                }
            }
        }
    )*};
}

by_coordinate!(Add add, Sub sub, Mul mul);

macro_rules! by_number {
    ($($operator:ident $method:ident),*) => {$(
        impl<R: Real> $operator<R> for Vec3<R> {
            type Output = Vec3<R>;
            #[inline(always)]
            fn $method(self, s: R) -> Vec3<R> {
                Vec3 {
                    x: self.x.$method(s),
                    y: self.y.$method(s),
                    z: self.z.$method(s),
                }
            }
        }
    )*};
}

by_number!(Mul mul, Div div);

impl<R: Real> Neg for Vec3<R> {
    type Output = Vec3<R>;
    #[inline(always)]
    fn neg(self) -> Vec3<R> {
        Vec3 {
            x: -self.x,
            y: -self.y,
            z: -self.z,
        }
    }
}
