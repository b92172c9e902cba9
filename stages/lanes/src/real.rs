//! The numbers that formulas compute with: one, or one in each lane.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A floating-point number, or one in each of several lanes.
///
/// Every operation of the lanes has the bits of the operation of a single number, except that a NaN
/// may be any NaN. So a formula over this trait has the same results at every width.
///
/// ```
/// use lanes::{Mask, Real};
/// /// |x| - 1, but at least 0, in every lane.
/// fn beyond_one<R: Real>(x: R) -> R {
///     let (zero, over) = (x.constant(0.0), x.abs() - x.constant(1.0));
///     zero.less(over).choose(over, zero)
/// }
/// assert_eq!((beyond_one(-3.0_f64), beyond_one(0.5_f32)), (2.0, 0.0));
/// ```
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The result of a comparison: yes or no, in each lane.
    type Mask: Mask<Self>;

    /// `x`, rounded to this type, in as many lanes as `self` has. The value of `self` does not
    /// matter.
    fn constant(self, x: f64) -> Self;

    /// The square root.
    fn sqrt(self) -> Self;

    /// The absolute value.
    fn abs(self) -> Self;

    /// The absolute value of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;

    /// The larger number; of a number and a NaN the number. Either of zeros of different sign.
    fn max(self, other: Self) -> Self;

    /// The smaller number; of a number and a NaN the number. Either of zeros of different sign.
    fn min(self, other: Self) -> Self;

    /// As [`Real::max`], but if one is NaN it is `other` for a single number, and may be either for
    /// lanes. One machine instruction.
    fn larger(self, other: Self) -> Self;

    /// As [`Real::min`], but if one is NaN it is `other` for a single number, and may be either for
    /// lanes. One machine instruction.
    fn smaller(self, other: Self) -> Self;

    /// Whether `self < other`. No for NaN.
    fn less(self, other: Self) -> Self::Mask;

    /// Whether `self <= other`. No for NaN.
    fn at_most(self, other: Self) -> Self::Mask;

    /// Whether `self == other`. No for NaN.
    fn equals(self, other: Self) -> Self::Mask;
}

/// A boolean for each lane of an `R`.
///
/// ```
/// use lanes::{Mask, Real};
/// let is_less = 1.0_f64.less(2.0) & !f64::NAN.less(2.0);
/// assert_eq!(is_less.choose(7.0, 8.0), 7.0);
/// ```
pub trait Mask<R>:
    Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// `yes` in the lanes of the mask, `no` in the others.
    fn choose(self, yes: R, no: R) -> R;
}

impl<R> Mask<R> for bool {
    #[inline(always)]
    fn choose(self, yes: R, no: R) -> R {
        if self { yes } else { no }
    }
}

macro_rules! single_number {
    ($number:ident) => {
        impl Real for $number {
            type Mask = bool;

            #[inline(always)]
            fn constant(self, x: f64) -> $number {
                x as $number
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
            fn copysign(self, sign: $number) -> $number {
                $number::copysign(self, sign)
            }

            #[inline(always)]
            fn max(self, other: $number) -> $number {
                $number::max(self, other)
            }

            #[inline(always)]
            fn min(self, other: $number) -> $number {
                $number::min(self, other)
            }

            #[inline(always)]
            fn larger(self, other: $number) -> $number {
                if self > other { self } else { other }
            }

            #[inline(always)]
            fn smaller(self, other: $number) -> $number {
                if self < other { self } else { other }
            }

            #[inline(always)]
            fn less(self, other: $number) -> bool {
                self < other
            }

            #[inline(always)]
            fn at_most(self, other: $number) -> bool {
                self <= other
            }

            #[inline(always)]
            fn equals(self, other: $number) -> bool {
                self == other
            }
        }
    };
}

single_number!(f32);
single_number!(f64);
