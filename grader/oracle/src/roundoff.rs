//! Rounding errors of `f64`: one rounding, many roundings, and the limits of its exponents.

use kit::Vec3;

/// The relative error of one rounded operation, 2^-53: `fl(a ∘ b) = (a ∘ b)(1 + δ)`, `|δ| <= U`.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// `γ_n = n·U / (1 - n·U)`: bounds the relative error of a product of `n` factors `1 + δ`
/// (Higham, *Accuracy and Stability of Numerical Algorithms*, §3.1; PBRT §6.8.1).
pub(super) fn gamma(n: f64) -> f64 {
    n * U / (1.0 - n * U)
}

/// The largest number for which no intermediate product of a kernel leaves the exponents of `f64`:
/// 2^200, about 1e60. Components of positions and directions must be 0 or between 2^-200 and 2^200
/// in size. Outside, correct code may overflow or underflow, and every answer scores.
///
/// The longest products have five factors: an edge function (two lengths) times a depth (a length
/// over the direction), or a normal (two lengths) times a cross product (two more). 5 · 200 is less
/// than 1022, the largest exponent.
const LARGEST_SAFE: f64 = f64::from_bits((1023 + 200) << 52);

/// Whether no product of these numbers overflows or underflows: see [`LARGEST_SAFE`].
pub(super) fn fits_f64(vectors: &[Vec3]) -> bool {
    let fits = |x: &f64| *x == 0.0 || (1.0 / LARGEST_SAFE..=LARGEST_SAFE).contains(&x.abs());
    vectors.iter().all(|v| v.to_array().iter().all(fits))
}

/// Returns the largest absolute component.
pub(super) fn max_abs(v: Vec3) -> f64 {
    v.abs().max_element()
}

/// Returns the sum of the absolute components.
pub(super) fn sum_abs(v: Vec3) -> f64 {
    v.abs().element_sum()
}

/// Returns `|a| × |b|` with every minus replaced by a plus: the sums of absolute products whose
/// rounding a cross product has.
pub(super) fn abs_cross(a: Vec3, b: Vec3) -> Vec3 {
    let (a, b) = (a.abs(), b.abs());
    Vec3::new(
        a.y * b.z + a.z * b.y,
        a.z * b.x + a.x * b.z,
        a.x * b.y + a.y * b.x,
    )
}
