//! Exact numbers: integers times powers of two.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::ops::BitTest;
use dashu_int::{IBig, Sign, UBig, Word};
use kit::Vec3;

use super::big_float::scale;

/// The number `m · 2^e`. Sums, differences and products are exact.
#[derive(Clone, Debug)]
pub(super) struct Dyadic {
    pub(super) m: IBig,
    pub(super) e: i64,
}

impl Dyadic {
    /// Returns the value of `x`, which must be finite.
    pub(super) fn new(x: f64) -> Dyadic {
        let (m, e) = decode(x);
        Dyadic { m: m.into(), e }
    }

    /// Returns the sign: -1, 0 or 1.
    pub(super) fn sign(&self) -> i32 {
        sign_of(&self.m)
    }

    /// Returns `|m|`.
    pub(super) fn magnitude(&self) -> UBig {
        self.m.clone().into_parts().1
    }

    /// Whether the absolute value is a power of two, so that division by it does not round.
    pub(super) fn is_power_of_two(&self) -> bool {
        let magnitude = self.magnitude();
        !magnitude.is_zero()
            && magnitude.trailing_zeros().map(|zeros| zeros + 1) == Some(magnitude.bit_len())
    }

    /// Returns the value with a relative error of a few 2^-53; 0 or infinite if it is out of the
    /// range of `f64`.
    pub(super) fn to_f64(&self) -> f64 {
        // Only the leading words matter; this needs no allocation.
        let (sign, words) = self.m.as_sign_words();
        let kept = words.len().min(128 / Word::BITS as usize);
        let (low, leading) = words.split_at(words.len() - kept);
        let leading = leading
            .iter()
            .rfold(0_u128, |high, word| high << Word::BITS | u128::from(*word));
        let value = scale(
            leading as f64,
            self.e + low.len() as i64 * i64::from(Word::BITS),
        );
        match sign {
            Sign::Positive => value,
            Sign::Negative => -value,
        }
    }

    pub(super) fn square(&self) -> Dyadic {
        self * self
    }

    /// Returns both integers, shifted to the smaller of the two exponents, and that exponent.
    fn aligned(&self, other: &Dyadic) -> (IBig, IBig, i64) {
        match self.e.cmp(&other.e) {
            Ordering::Equal => (self.m.clone(), other.m.clone(), self.e),
            Ordering::Less => (
                self.m.clone(),
                &other.m << (other.e - self.e) as usize,
                self.e,
            ),
            Ordering::Greater => (
                &self.m << (self.e - other.e) as usize,
                other.m.clone(),
                other.e,
            ),
        }
    }

    pub(super) fn compare(&self, other: &Dyadic) -> Ordering {
        match self.sign().cmp(&other.sign()) {
            Ordering::Equal => {
                let (a, b, _) = self.aligned(other);
                a.cmp(&b)
            }
            unequal => unequal,
        }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: &Dyadic) -> Dyadic {
        let (a, b, e) = self.aligned(other);
        Dyadic { m: a + b, e }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: &Dyadic) -> Dyadic {
        let (a, b, e) = self.aligned(other);
        Dyadic { m: a - b, e }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic {
            m: &self.m * &other.m,
            e: self.e + other.e,
        }
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic {
            m: -&self.m,
            e: self.e,
        }
    }
}

/// An exact vector: three integers with a common exponent.
#[derive(Clone, Debug)]
pub(super) struct Dyadic3 {
    pub(super) m: [IBig; 3],
    pub(super) e: i64,
}

impl Dyadic3 {
    /// Converts finite vectors to one common exponent, so that adding them never shifts.
    pub(super) fn aligned<const N: usize>(vectors: [Vec3; N]) -> [Dyadic3; N] {
        let decoded = vectors.map(|v| v.to_array().map(decode));
        let lowest = decoded
            .iter()
            .flatten()
            .filter(|(m, _)| *m != 0)
            .map(|(_, e)| *e)
            .min();
        let e = lowest.unwrap_or(0);
        decoded.map(|v| Dyadic3 {
            m: v.map(|(m, own)| {
                if m == 0 {
                    return IBig::ZERO;
                }
                IBig::from(m) << (own - e) as usize
            }),
            e,
        })
    }

    pub(super) fn is_zero(&self) -> bool {
        self.m.iter().all(IBig::is_zero)
    }

    /// Whether at most one component is not zero.
    pub(super) fn is_along_an_axis(&self) -> bool {
        self.m.iter().filter(|m| !m.is_zero()).count() <= 1
    }

    /// Returns the number of bits of the longest component.
    pub(super) fn bits(&self) -> usize {
        self.m.iter().map(BitTest::bit_len).max().unwrap_or(0)
    }

    /// Returns the difference of two vectors that have the same exponent.
    pub(super) fn minus(&self, other: &Dyadic3) -> Dyadic3 {
        assert_eq!(self.e, other.e, "the vectors must have the same exponent");
        Dyadic3 {
            m: [0, 1, 2].map(|i| &self.m[i] - &other.m[i]),
            e: self.e,
        }
    }

    pub(super) fn dot(&self, other: &Dyadic3) -> Dyadic {
        let [x, y, z] = [0, 1, 2].map(|i| &self.m[i] * &other.m[i]);
        Dyadic {
            m: x + y + z,
            e: self.e + other.e,
        }
    }

    pub(super) fn cross(&self, other: &Dyadic3) -> Dyadic3 {
        let component = |j: usize, k: usize| &self.m[j] * &other.m[k] - &self.m[k] * &other.m[j];
        Dyadic3 {
            m: [component(1, 2), component(2, 0), component(0, 1)],
            e: self.e + other.e,
        }
    }

    /// Returns the components with a relative error of a few 2^-53.
    pub(super) fn to_f64(&self) -> Vec3 {
        Vec3::from_array([0, 1, 2].map(|i| self.get(i).to_f64()))
    }

    /// Returns one component.
    pub(super) fn get(&self, i: usize) -> Dyadic {
        Dyadic {
            m: self.m[i].clone(),
            e: self.e,
        }
    }
}

/// Returns the sign: -1, 0 or 1.
fn sign_of(m: &IBig) -> i32 {
    match m.sign() {
        _ if m.is_zero() => 0,
        Sign::Positive => 1,
        Sign::Negative => -1,
    }
}

/// Returns `(m, e)` of `x = m · 2^e` with `m` odd or zero. `x` must be finite.
fn decode(x: f64) -> (i64, i64) {
    assert!(x.is_finite(), "only finite numbers have an exact value");
    let bits = x.to_bits();
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (magnitude, e) = match (bits >> 52) & 0x7ff {
        0 => (fraction, -1074),
        biased => (fraction | (1 << 52), biased as i64 - 1075),
    };
    if magnitude == 0 {
        return (0, 0);
    }
    let zeros = i64::from(magnitude.trailing_zeros());
    let odd = magnitude >> zeros;
    (if x < 0.0 { -odd } else { odd }, e + zeros)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decoding_is_exact_down_to_the_smallest_denormal() {
        assert_eq!(decode(0.0), (0, 0));
        assert_eq!(decode(-0.0), (0, 0));
        assert_eq!(decode(-6.0), (-3, 1));
        assert_eq!(decode(f64::from_bits(1)), (1, -1074));
        assert_eq!(decode(f64::MAX), ((1 << 53) - 1, 971));
    }

    #[test]
    fn sums_across_the_whole_exponent_range_are_exact() {
        let (huge, tiny) = (Dyadic::new(f64::MAX), Dyadic::new(f64::from_bits(1)));
        let back = &(&huge + &tiny) - &huge;
        assert_eq!(back.compare(&tiny), Ordering::Equal);
    }

    #[test]
    fn only_powers_of_two_are_powers_of_two() {
        assert!(Dyadic::new(-0.25).is_power_of_two());
        assert!(!Dyadic::new(0.75).is_power_of_two());
        assert!(!Dyadic::new(0.0).is_power_of_two());
    }
}
