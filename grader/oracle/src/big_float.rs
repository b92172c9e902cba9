//! Floating-point numbers with 126 bits, for exact results that are quotients and roots.

use std::cmp::Ordering;
use std::fmt;

use dashu_int::UBig;
use dashu_int::ops::{BitTest, DivRem, SquareRootRem};

use super::dyadic::Dyadic;

/// The number `m · 2^e` with `2^126 <= |m| < 2^127`, or zero. The relative error of an operation is
/// 2^-126, about 1e-38, and the exponent never overflows for quotients of `f64` expressions.
///
/// The lowest bit of `m` is set if nonzero bits were cut off after it (a *sticky* bit), so that
/// rounding to `f64` ([`BigFloat::to_f64`]) distinguishes "slightly more than half" from "half".
///
/// ```
/// use oracle::{BigFloat, ulps};
/// let tenth = BigFloat::new(0.1);
/// assert_eq!(tenth.to_f64(), 0.1);
/// // The next number is one unit in the last place away.
/// assert_eq!(ulps(0.1_f64.next_up(), &tenth), 1.0);
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct BigFloat {
    m: i128,
    e: i64,
}

/// Bits of the mantissa `m`.
const BITS: i64 = 127;
/// Bits of the square root that [`BigFloat::root_parts`] computes: more than [`BITS`], because sums
/// with it follow.
const ROOT_BITS: i64 = 192;

impl BigFloat {
    /// Zero.
    pub const ZERO: BigFloat = BigFloat { m: 0, e: 0 };

    /// Returns the value of a finite `x`.
    pub fn new(x: f64) -> BigFloat {
        BigFloat::from(&Dyadic::new(x))
    }

    /// Returns `num / den`; `den` must not be zero.
    pub(super) fn ratio(num: &Dyadic, den: &Dyadic) -> BigFloat {
        assert!(den.sign() != 0, "a quotient by zero has no value");
        if num.sign() == 0 {
            return BigFloat::ZERO;
        }
        // One bit more than needed, because the quotient of the leading bits may be just under 1.
        let shift = BITS + 1 + den.m.bit_len() as i64 - num.m.bit_len() as i64;
        let (n, d) = (num.magnitude(), den.magnitude());
        let (n, d) = match usize::try_from(shift) {
            Ok(left) => (n << left, d),
            Err(_) => (n, d << shift.unsigned_abs() as usize),
        };
        let (quotient, rest) = n.div_rem(d);
        let negative = num.sign() != den.sign();
        BigFloat::round(&quotient, num.e - den.e - shift, !rest.is_zero(), negative)
    }

    /// Returns the square root of `x >= 0` to [`ROOT_BITS`] bits as a dyadic number, and whether it
    /// is exact.
    pub(super) fn root_parts(x: &Dyadic) -> (Dyadic, bool) {
        assert!(x.sign() >= 0, "a negative number has no real root");
        if x.sign() == 0 {
            return (x.clone(), true);
        }
        let m = x.magnitude();
        let mut shift = (2 * ROOT_BITS - m.bit_len() as i64).max(0);
        if (x.e - shift) % 2 != 0 {
            shift += 1;
        }
        let (root, rest) = (m << shift as usize).sqrt_rem();
        let root = Dyadic {
            m: root.into(),
            e: (x.e - shift) / 2,
        };
        (root, rest.is_zero())
    }

    /// Returns `magnitude · 2^e`, truncated to [`BITS`] bits. `sticky`: whether nonzero bits were
    /// cut off before.
    fn round(magnitude: &UBig, e: i64, sticky: bool, negative: bool) -> BigFloat {
        let excess = magnitude.bit_len() as i64 - BITS;
        let (bits, sticky) = match usize::try_from(excess) {
            Ok(cut) => {
                let lost = magnitude.trailing_zeros().is_some_and(|zeros| zeros < cut);
                (magnitude >> cut, sticky || lost)
            }
            Err(_) => (magnitude << excess.unsigned_abs() as usize, sticky),
        };
        let m = i128::try_from(&bits).expect("127 bits fit") | i128::from(sticky);
        BigFloat {
            m: if negative { -m } else { m },
            e: e + excess,
        }
    }

    /// Returns the sign: -1, 0 or 1.
    pub fn sign(&self) -> i32 {
        self.m.signum() as i32
    }

    /// Returns `(m, e)` of `m · 2^e`.
    pub fn parts(&self) -> (i128, i64) {
        (self.m, self.e)
    }

    /// Returns the nearest `f64`, ties to even; infinite or denormal if the value is out of range.
    pub fn to_f64(&self) -> f64 {
        if self.m == 0 {
            return 0.0;
        }
        let magnitude = self.m.unsigned_abs();
        let exponent = self.exponent();
        if exponent > 1023 {
            return f64::INFINITY.copysign(self.m as f64);
        }
        // A normal number keeps 53 bits; a denormal one fewer.
        let cut = BITS - 53 + (-1022 - exponent).max(0);
        let kept = if cut > BITS {
            0
        } else {
            let (kept, rest) = (magnitude >> cut, magnitude & ((1 << cut) - 1));
            let half = 1 << (cut - 1);
            let up = rest > half || (rest == half && kept & 1 == 1);
            (kept + u128::from(up)) as u64
        };
        // The hidden bit of `kept` carries into the exponent field, and so does rounding up.
        let field = (exponent.max(-1022) + 1022) as u64;
        f64::from_bits((field << 52) + kept).copysign(self.m as f64)
    }

    /// Returns `k` with `2^k <= |x| < 2^(k+1)`; the result for zero has no meaning.
    fn exponent(&self) -> i64 {
        self.e + BITS - 1
    }

    /// Returns `|answer - self|` in units in the last place of the `f64` nearest to `self`; see
    /// [`ulps`].
    pub fn ulps(&self, answer: f64) -> f64 {
        if !answer.is_finite() {
            return f64::INFINITY;
        }
        if self.m == 0 {
            return if answer == 0.0 { 0.0 } else { f64::INFINITY };
        }
        let ulp = (self.exponent() - 52).max(-1074);
        let answer = scale(answer, -ulp);
        // The exact value in ulps, in two parts: an integer of at most 53 bits and a fraction.
        let cut = ulp - self.e;
        if cut >= BITS {
            return (answer - scale(self.m as f64, -cut)).abs();
        }
        let whole = self.m >> cut;
        let fraction = scale((self.m - (whole << cut)) as f64, -cut);
        ((answer - whole as f64) - fraction).abs()
    }

    /// Returns one unit in the last place of the `f64` nearest to this number; for zero, the
    /// smallest positive number.
    pub fn ulp(&self) -> f64 {
        if self.m == 0 {
            return f64::from_bits(1);
        }
        scale(1.0, (self.exponent() - 52).max(-1074))
    }
}

/// Returns the distance of `answer` from `truth` in units in the last place of `truth`; the nearest
/// `f64` is at most half a unit off. Infinite if `answer` is NaN or infinite, or if `truth` is 0
/// and `answer` is not.
pub fn ulps(answer: f64, truth: &BigFloat) -> f64 {
    truth.ulps(answer)
}

impl From<&Dyadic> for BigFloat {
    fn from(x: &Dyadic) -> BigFloat {
        if x.sign() == 0 {
            return BigFloat::ZERO;
        }
        BigFloat::round(&x.magnitude(), x.e, false, x.sign() < 0)
    }
}

impl Ord for BigFloat {
    fn cmp(&self, other: &BigFloat) -> Ordering {
        let by_size = || (self.e, self.m.unsigned_abs()).cmp(&(other.e, other.m.unsigned_abs()));
        match self.sign().cmp(&other.sign()) {
            Ordering::Equal if self.sign() < 0 => by_size().reverse(),
            Ordering::Equal => by_size(),
            unequal => unequal,
        }
    }
}

impl PartialOrd for BigFloat {
    fn partial_cmp(&self, other: &BigFloat) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Debug for BigFloat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:e}", self.to_f64())
    }
}

/// Returns `x · 2^k`, rounded once at most; infinite or zero if it is out of range.
pub(super) fn scale(x: f64, k: i64) -> f64 {
    let power = |k: i64| f64::from_bits(((k + 1023) as u64) << 52);
    // Steps of at most 2^1000 reach every f64 from every other; only the last one may round.
    let k = k.clamp(-3000, 3000);
    let mut rest = k;
    let mut x = x;
    while rest > 1000 {
        x *= power(1000);
        rest -= 1000;
    }
    while rest < -1000 {
        x *= power(-1000);
        rest += 1000;
    }
    x * power(rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_f64_converts_to_itself() {
        for x in [
            0.0,
            1.0,
            -0.1,
            f64::MAX,
            f64::MIN_POSITIVE,
            -f64::from_bits(1),
            f64::from_bits(12345),
        ] {
            assert_eq!(BigFloat::new(x).to_f64(), x);
            assert_eq!(BigFloat::new(x).ulps(x), 0.0);
        }
    }

    #[test]
    fn quotients_round_to_the_nearest() {
        let third = BigFloat::ratio(&Dyadic::new(1.0), &Dyadic::new(-3.0));
        assert_eq!(third.to_f64(), -1.0 / 3.0);
        let distance = third.ulps(-1.0 / 3.0);
        assert!((distance - 1.0 / 3.0).abs() < 1e-12, "{distance}");
        // Just over half way between two floats, by one part in 2^200: must round up.
        let half_way = &Dyadic::new(1.0) + &Dyadic::new(f64::EPSILON / 2.0);
        assert_eq!(BigFloat::from(&half_way).to_f64(), 1.0);
        let over = &half_way
            + &Dyadic {
                m: 1.into(),
                e: -200,
            };
        assert_eq!(BigFloat::from(&over).to_f64(), 1.0 + f64::EPSILON);
    }

    #[test]
    fn denormal_and_overflowing_quotients_round_to_f64() {
        let tiny = Dyadic::new(f64::from_bits(3));
        let halves = BigFloat::ratio(&tiny, &Dyadic::new(2.0));
        assert_eq!(halves.to_f64(), f64::from_bits(2));
        assert_eq!(halves.ulps(f64::from_bits(1)), 0.5);
        let huge = BigFloat::ratio(&Dyadic::new(f64::MAX), &tiny);
        assert_eq!(huge.to_f64(), f64::INFINITY);
        let none = BigFloat::ratio(&tiny, &Dyadic::new(f64::MAX));
        assert_eq!(none.to_f64(), 0.0);
        assert!(none < halves && halves < huge);
    }

    #[test]
    fn roots_of_squares_are_exact() {
        let (root, exact) = BigFloat::root_parts(&Dyadic::new(2.25));
        assert!(exact);
        assert_eq!(BigFloat::from(&root).to_f64(), 1.5);
        let (root, exact) = BigFloat::root_parts(&Dyadic::new(2.0));
        assert!(!exact);
        assert_eq!(BigFloat::from(&root).to_f64(), std::f64::consts::SQRT_2);
    }

    #[test]
    fn scaling_covers_the_whole_exponent_range() {
        assert_eq!(scale(f64::from_bits(1), 1074), 1.0);
        assert_eq!(scale(1.0, -1074), f64::from_bits(1));
        assert_eq!(scale(f64::MAX, -3000), 0.0);
    }
}
