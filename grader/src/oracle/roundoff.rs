//! What `f64` loses: one rounding, many roundings, and the ends of its exponents.

use kit::Vec3;

use super::verdict::Kernel;

/// The relative error of one rounded operation, 2^-53: `fl(a ∘ b) = (a ∘ b)(1 + δ)`, `|δ| <= U`.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// `γ_n = n·U / (1 - n·U)`: bounds the relative error of a product of `n` factors `1 + δ`
/// (Higham, *Accuracy and Stability of Numerical Algorithms*, §3.1; PBRT §6.8.1).
pub(super) fn gamma(n: f64) -> f64 {
    n * U / (1.0 - n * U)
}

/// Lengths and directions whose largest component is between 2^-k and 2^k keep every
/// intermediate product of a kernel inside the exponents of `f64`. Outside, correct code may
/// overflow or lose its product to 0, and the oracle accuses nobody.
///
/// The textbook limit leaves room for products of five such numbers, `n · (e × P)` with the normal
/// `n` itself a product: 5 · 200 <= 1022. The robust limit is for three: 3 · 300 <= 1022, less
/// what the relative error of a sum still needs, 2^-53.
fn reach(kernel: Kernel) -> f64 {
    let k = match kernel {
        Kernel::Textbook => 200,
        Kernel::Robust => 300,
    };
    f64::from_bits((1023 + k) << 52)
}

/// Whether a kernel can work with numbers of these sizes at all: see [`reach`]. A size of 0
/// is in reach, for nothing is lost to it.
pub(super) fn in_reach(kernel: Kernel, sizes: [f64; 2]) -> bool {
    let limit = reach(kernel);
    sizes
        .iter()
        .all(|s| *s == 0.0 || (1.0 / limit..=limit).contains(s))
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
