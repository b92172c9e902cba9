//! The number types of the kernels.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number type of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Single precision: 24 bits.
    F32,
    /// Double precision: 53 bits.
    F64,
    /// Stored in single precision, computed in double precision.
    F32InF64,
}

impl Precision {
    /// Returns the nearest number that can be stored.
    pub fn stored(self, x: f64) -> f64 {
        match self {
            Precision::F64 => x,
            Precision::F32 | Precision::F32InF64 => f64::from(x as f32),
        }
    }

    /// Returns the distance from 1 to the next larger number, in the precision of the results.
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::EPSILON),
            Precision::F64 | Precision::F32InF64 => f64::EPSILON,
        }
    }
}

/// A floating-point number: `f32`, `f64`, or [`CountingF64`](crate::CountingF64), an `f64` that
/// counts operations.
///
/// Kernels are generic over this trait.
pub trait Scalar:
    Copy
    + Send
    + Sync
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The precision.
    const PRECISION: Precision;

    /// Rounds `x` to this type.
    fn from_f64(x: f64) -> Self;

    /// Returns the value as `f64`.
    fn to_f64(self) -> f64;

    /// Returns the square root.
    fn sqrt(self) -> Self;

    /// Returns the absolute value.
    fn abs(self) -> Self;

    /// Returns `self · factor + term` with a single rounding. If the target has no fused
    /// multiply-add instruction, as in a default build for x86-64, this calls the C library.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// Returns the distance from 1 to the next larger number.
    fn epsilon() -> Self {
        Self::from_f64(Self::PRECISION.epsilon())
    }

    /// Returns the larger number, or `other` if `self` is NaN. Compiles to one machine instruction,
    /// unlike `f64::max`.
    #[inline(always)]
    fn select_max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// Returns the smaller number, or `other` if `self` is NaN.
    #[inline(always)]
    fn select_min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

macro_rules! real {
    ($number:ident, $precision:expr) => {
        impl Scalar for $number {
            const PRECISION: Precision = $precision;

            #[inline(always)]
            fn from_f64(x: f64) -> $number {
                x as $number
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn sqrt(self) -> $number {
                $number::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> $number {
                $number::abs(self)
            }

            #[inline(always)]
            fn mul_add(self, factor: $number, term: $number) -> $number {
                $number::mul_add(self, factor, term)
            }
        }
    };
}

real!(f32, Precision::F32);
real!(f64, Precision::F64);
