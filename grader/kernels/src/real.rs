//! The numbers that a kernel may be run on.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// In what numbers a kernel works.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Single: 24 bits.
    F32,
    /// Double: 53 bits.
    F64,
    /// Stored in single, computed with in double.
    F32InF64,
}

impl Precision {
    /// The nearest number that can be stored.
    pub fn stored(self, x: f64) -> f64 {
        match self {
            Precision::F64 => x,
            Precision::F32 | Precision::F32InF64 => f64::from(x as f32),
        }
    }

    /// The distance from 1 to the next larger number in which answers are given.
    pub fn epsilon(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::EPSILON),
            Precision::F64 | Precision::F32InF64 => f64::EPSILON,
        }
    }
}

/// A floating-point number: `f32`, `f64`, or [`Counted`](crate::Counted), which is `f64` and counts.
///
/// A kernel is written once, for any of them.
pub trait Real:
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
    /// Which it is.
    const PRECISION: Precision;

    /// The nearest such number to `x`.
    fn of(x: f64) -> Self;

    /// Its value.
    fn wide(self) -> f64;

    /// Its square root.
    fn sqrt(self) -> Self;

    /// Without its sign.
    fn abs(self) -> Self;

    /// `self · factor + term` with a single rounding. Where the processor's own instruction may not be assumed, as in
    /// a plain build for x86-64, this is a call into the C library.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// The distance from 1 to the next larger number.
    fn epsilon() -> Self {
        Self::of(Self::PRECISION.epsilon())
    }

    /// The larger of two; `other` if this is NaN. One machine instruction, which `f64::max` is not.
    #[inline(always)]
    fn or_larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// The smaller of two; `other` if this is NaN.
    #[inline(always)]
    fn or_smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
}

macro_rules! real {
    ($number:ident, $precision:expr) => {
        impl Real for $number {
            const PRECISION: Precision = $precision;

            #[inline(always)]
            fn of(x: f64) -> $number {
                x as $number
            }

            #[inline(always)]
            fn wide(self) -> f64 {
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
