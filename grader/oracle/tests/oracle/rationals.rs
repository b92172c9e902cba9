//! Rational arithmetic: the slow reference that the oracle is compared with.

use kit::Vec3;
use num_rational::BigRational;
use oracle::BigFloat;

/// A rational number.
pub(crate) type Q = BigRational;

pub(crate) fn q(x: f64) -> Q {
    Q::from_float(x).expect("a finite number")
}

pub(crate) fn zero() -> Q {
    q(0.0)
}

/// A vector of rationals.
pub(crate) type Q3 = [Q; 3];

pub(crate) fn q3(v: Vec3) -> Q3 {
    v.to_array().map(q)
}

pub(crate) fn minus(a: &Q3, b: &Q3) -> Q3 {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

pub(crate) fn dot(a: &Q3, b: &Q3) -> Q {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub(crate) fn cross(a: &Q3, b: &Q3) -> Q3 {
    let component = |j: usize, k: usize| &a[j] * &b[k] - &a[k] * &b[j];
    [component(1, 2), component(2, 0), component(0, 1)]
}

/// Returns the exact value of the oracle's number.
pub(crate) fn value(x: &BigFloat) -> Q {
    let (m, e) = x.parts();
    let two = q(2.0);
    // A mantissa of 127 bits in three parts that f64 represents exactly.
    let [low, middle, high] = [m & 0xffff_ffff_ffff, (m >> 48) & 0xffff_ffff_ffff, m >> 96];
    let shift = q((1u64 << 48) as f64);
    let m = (q(high as f64) * &shift + q(middle as f64)) * &shift + q(low as f64);
    m * two.pow(i32::try_from(e).expect("an exponent of a few thousand"))
}

/// Whether the oracle's number has a relative error of at most 1e-30.
pub(crate) fn agrees(x: &BigFloat, truth: &Q) -> bool {
    let error = value(x) - truth;
    let bound = truth * q(1e-30);
    let size = |q: Q| if q < zero() { -q } else { q };
    size(error) <= size(bound)
}

/// Whether `min <= t <= max`.
pub(crate) fn in_range(t: &Q, (min, max): (f64, f64)) -> bool {
    let above = min == f64::NEG_INFINITY || (min.is_finite() && *t >= q(min));
    let below = max == f64::INFINITY || (max.is_finite() && *t <= q(max));
    above && below
}
