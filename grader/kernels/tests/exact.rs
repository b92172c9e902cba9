//! Sums and products of several numbers each, which have no rounding errors.

use kernels::exact::{Expansion, difference_of_products};

#[test]
fn sums_and_products_keep_the_rounding_error() {
    let big = 2.0_f64.powi(60);
    let one = Expansion::difference(big + 512.0, big);
    // (2^60 + 512)(1 + 2^-30) - 2^60 = 2^30 + 512 + 2^-21.
    let product = one
        .plus(&Expansion::difference(big, 0.0))
        .scaled(1.0 + 2.0_f64.powi(-30));
    let rest = product.plus(&Expansion::difference(-big, 2.0_f64.powi(30)));
    assert_eq!(rest.value(), 512.0 + 2.0_f64.powi(-21));
}

#[test]
fn a_determinant_that_cancels_has_the_correct_sign() {
    let a = 1.0 + f64::EPSILON;
    // a² - (1 + 2ε) · 1 = ε².
    assert_eq!(a * a - (1.0 + 2.0 * f64::EPSILON), 0.0);
    let exact = difference_of_products(a, a, 1.0 + 2.0 * f64::EPSILON, 1.0);
    assert_eq!(exact, f64::EPSILON * f64::EPSILON);
}

#[test]
fn products_of_differences_are_exact() {
    let a = Expansion::difference(0.1, 0.3);
    let b = Expansion::difference(1e17, 0.7);
    let minus = |x: &Expansion<f64>| x.scaled(-1.0);
    let zero = a.times(&b).plus(&minus(&b.times(&a)));
    assert_eq!(zero.value(), 0.0);
}
