// BEGIN SOLUTION(part1.task3)
//! Accurate arithmetic for the cases in which plain `f64` loses too many digits.
//!
//! `mul_add` has a single rounding on every machine, but it is slow without hardware support. So
//! the kernels use this module only when the plain formula is not reliable.

use kit::Vec3;
use std::ops::{Add, Mul, Neg, Sub};

/// `a·b - c·d` with an error of at most 1.5 ulp. The plain formula can lose every digit.
///
/// Kahan's algorithm; the bound is in Jeannerod, Louvet, Muller, "Further analysis of Kahan's
/// algorithm for the accurate computation of 2x2 determinants", Math. Comp. 82, 2013. The sign is
/// exact, and the result is 0 only if the exact value is 0. The exception is a product so small
/// (below 1e-290) that its rounding error underflows.
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let cd = c * d;
    let rounding_of_cd = (-c).mul_add(d, cd);
    a.mul_add(b, -cd) + rounding_of_cd
}

/// `a x b` with an error of at most 1.5 ulp in every component.
pub(crate) fn accurate_cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        difference_of_products(a.y, b.z, a.z, b.y),
        difference_of_products(a.z, b.x, a.x, b.z),
        difference_of_products(a.x, b.y, a.y, b.x),
    )
}

/// An unevaluated sum of two floats, where `hi` is the rounded sum: about 106 bits.
///
/// Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18,
/// 1971.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DoubleDouble {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

impl DoubleDouble {
    /// `a + b` without rounding error (Knuth's TwoSum).
    pub(crate) fn sum(a: f64, b: f64) -> DoubleDouble {
        let hi = a + b;
        let b_in_hi = hi - a;
        let a_in_hi = hi - b_in_hi;
        let lo = (a - a_in_hi) + (b - b_in_hi);
        DoubleDouble { hi, lo }
    }

    /// `a·b` without rounding error.
    pub(crate) fn product(a: f64, b: f64) -> DoubleDouble {
        let hi = a * b;
        DoubleDouble {
            hi,
            lo: a.mul_add(b, -hi),
        }
    }

    /// `hi + lo` as a pair whose `hi` is the rounded sum. Requires `|hi| >= |lo|`.
    fn renormalized(hi: f64, lo: f64) -> DoubleDouble {
        let sum = hi + lo;
        DoubleDouble {
            hi: sum,
            lo: lo - (sum - hi),
        }
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let hi = DoubleDouble::sum(self.hi, other.hi);
        let lo = DoubleDouble::sum(self.lo, other.lo);
        let sum = DoubleDouble::renormalized(hi.hi, hi.lo + lo.hi);
        DoubleDouble::renormalized(sum.hi, sum.lo + lo.lo)
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;
    fn neg(self) -> DoubleDouble {
        DoubleDouble {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let product = DoubleDouble::product(self.hi, other.hi);
        let cross = self.hi.mul_add(other.lo, self.lo * other.hi);
        DoubleDouble::renormalized(product.hi, product.lo + cross)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = DoubleDouble;
    fn mul(self, s: f64) -> DoubleDouble {
        let product = DoubleDouble::product(self.hi, s);
        DoubleDouble::renormalized(product.hi, self.lo.mul_add(s, product.lo))
    }
}

/// The power of two that scales `x` into [1, 2) when `x` is divided by it. `x` must be positive and
/// finite.
///
/// Multiplication by a power of two does not round. So a kernel can compute at a scale at which
/// nothing overflows or underflows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scale {
    exponent: i32,
}

impl Scale {
    pub(crate) fn of(x: f64) -> Scale {
        // Denormal numbers use the smallest normal exponent: they are scaled into [0, 1), without
        // loss.
        let biased = (x.to_bits() >> 52 & 0x7ff).max(1) as i32;
        Scale {
            exponent: biased - 1023,
        }
    }

    /// `v` divided by the scale.
    pub(crate) fn shrink(self, v: Vec3) -> Vec3 {
        v * power_of_two(-self.exponent / 2) * power_of_two(-self.exponent - -self.exponent / 2)
    }

    /// `x` times this scale, divided by `other`.
    pub(crate) fn restore(self, x: f64, other: Scale) -> f64 {
        let exponent = self.exponent - other.exponent;
        let third = exponent / 3;
        x * power_of_two(third) * power_of_two(third) * power_of_two(exponent - 2 * third)
    }
}

/// 2 to the power `exponent`, which must be the exponent of a normal float.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
// END SOLUTION(part1.task3)
