//! What `f64` loses: one rounding, many roundings, and the ends of its exponents.

use kit::Vec3;

/// The relative error of one rounded operation, 2^-53: `fl(a ∘ b) = (a ∘ b)(1 + δ)`, `|δ| <= U`.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// `γ_n = n·U / (1 - n·U)`: bounds the relative error of a product of `n` factors `1 + δ`
/// (Higham, *Accuracy and Stability of Numerical Algorithms*, §3.1; PBRT §6.8.1).
pub(super) fn gamma(n: f64) -> f64 {
    n * U / (1.0 - n * U)
}

/// Positions and directions whose components are 0 or between 2^-200 and 2^200 (about 1e60) in size keep every
/// intermediate product of a kernel inside the exponents of `f64`. Outside, correct code may
/// overflow or lose its product to 0, and the oracle accuses nobody.
///
/// The longest products have five factors: an edge function (two lengths) times a depth (a length over
/// the direction), or a normal (two lengths) times a cross product (two more). 5 · 200 is less than the 1022 there are.
const REACH: f64 = f64::from_bits((1023 + 200) << 52);

/// Whether `f64` can work with all of these numbers: see [`REACH`].
pub(super) fn in_reach(vectors: &[Vec3]) -> bool {
    let fits = |x: &f64| *x == 0.0 || (1.0 / REACH..=REACH).contains(&x.abs());
    vectors.iter().all(|v| v.to_array().iter().all(fits))
}

/// Largest absolute component.
pub(super) fn largest(v: Vec3) -> f64 {
    v.abs().max_element()
}

/// Sum of absolute components.
pub(super) fn sum(v: Vec3) -> f64 {
    v.abs().element_sum()
}

/// `|a| × |b|` with every minus a plus: the sum of the absolute products that a cross product rounds.
pub(super) fn cross_of_sizes(a: Vec3, b: Vec3) -> Vec3 {
    let (a, b) = (a.abs(), b.abs());
    Vec3::new(
        a.y * b.z + a.z * b.y,
        a.z * b.x + a.x * b.z,
        a.x * b.y + a.y * b.x,
    )
}
