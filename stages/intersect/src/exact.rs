// BEGIN SOLUTION(part1.task3)
//! Arithmetic for the close calls: what plain `f64` rounds away, kept.
//!
//! `mul_add` rounds once, on every machine, but where the hardware has no such instruction it is slow. So
//! the kernels come here only when the plain formula cannot decide.

use kit::Vec3;
use std::ops::{Add, Mul, Neg, Sub};

/// `a·b - c·d`, off by at most 1.5 ulp, where the plain formula can lose every digit.
///
/// Kahan's algorithm; the bound is in Jeannerod, Louvet, Muller, "Further analysis of Kahan's algorithm for
/// the accurate computation of 2x2 determinants", Math. Comp. 82, 2013. The sign is right, and 0 means 0,
/// as long as no product is so small (below 1e-290) that its rounding error underflows.
pub(crate) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let cd = c * d;
    let rounding_of_cd = (-c).mul_add(d, cd);
    a.mul_add(b, -cd) + rounding_of_cd
}

/// `a x b` with every component off by at most 1.5 ulp.
pub(crate) fn accurate_cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        difference_of_products(a.y, b.z, a.z, b.y),
        difference_of_products(a.z, b.x, a.x, b.z),
        difference_of_products(a.x, b.y, a.y, b.x),
    )
}

/// A number as an unevaluated sum of two floats, `hi` the sum rounded: about 106 bits.
///
/// Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18, 1971.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DoubleDouble {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

impl DoubleDouble {
    /// `a + b` without rounding (Knuth's TwoSum).
    pub(crate) fn sum(a: f64, b: f64) -> DoubleDouble {
        let hi = a + b;
        let b_in_hi = hi - a;
        let a_in_hi = hi - b_in_hi;
        let lo = (a - a_in_hi) + (b - b_in_hi);
        DoubleDouble { hi, lo }
    }

    /// `a·b` without rounding.
    pub(crate) fn product(a: f64, b: f64) -> DoubleDouble {
        let hi = a * b;
        DoubleDouble {
            hi,
            lo: a.mul_add(b, -hi),
        }
    }

    /// `hi + lo` with `hi` again the sum rounded; needs `|hi| >= |lo|`.
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

/// The power of two that brings `x` into [1, 2) by division; `x` must be positive and finite.
/// Multiplying by powers of two does not round, so a kernel may work at a size where nothing overflows
/// or underflows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scale {
    exponent: i32,
}

impl Scale {
    pub(crate) fn of(x: f64) -> Scale {
        // Denormals count as the smallest normal number: brought into [0, 1) they are small, not lost.
        let biased = (x.to_bits() >> 52 & 0x7ff).max(1) as i32;
        Scale {
            exponent: biased - 1023,
        }
    }

    /// `v` divided by the scale.
    pub(crate) fn shrink(self, v: Vec3) -> Vec3 {
        v * power_of_two(-self.exponent / 2) * power_of_two(-self.exponent - -self.exponent / 2)
    }

    /// `x` times this scale, over `other`.
    pub(crate) fn restore(self, x: f64, other: Scale) -> f64 {
        let exponent = self.exponent - other.exponent;
        let third = exponent / 3;
        x * power_of_two(third) * power_of_two(third) * power_of_two(exponent - 2 * third)
    }
}

/// 2 to the power `exponent`, which must be that of a normal float.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
// END SOLUTION(part1.task3)
