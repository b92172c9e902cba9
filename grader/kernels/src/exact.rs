//! Exact sums and products: numbers as unevaluated sums of floats.
//!
//! J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates", Discrete & Computational Geometry 18, 1997. Exact if nothing overflows or
//! underflows.

use lanes::Scalar;

/// Returns `(sum, error)` with `a + b = sum + error`, exactly (Knuth's TwoSum).
#[inline(always)]
pub fn two_sum<R: Scalar>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let b_in_sum = sum - a;
    let a_in_sum = sum - b_in_sum;
    (sum, (a - a_in_sum) + (b - b_in_sum))
}

/// Returns `(product, error)` with `a · b = product + error`, exactly.
#[inline(always)]
pub fn two_product<R: Scalar>(a: R, b: R) -> (R, R) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// Returns `a·b - c·d` with an error of at most 1.5 ulp, so the sign is correct.
///
/// Kahan's algorithm; the bound is in Jeannerod, Louvet, Muller, "Further analysis of Kahan's
/// algorithm for the accurate computation of 2x2 determinants", Math. Comp. 82, 2013.
#[inline(always)]
pub fn difference_of_products<R: Scalar>(a: R, b: R, c: R, d: R) -> R {
    let (cd, error) = two_product(c, d);
    a.mul_add(b, -cd) - error
}

/// An exact number: the sum of its parts, which do not overlap and are ordered from the smallest to
/// the largest.
#[derive(Clone, Debug)]
pub struct Expansion<R>(Vec<R>);

impl<R: Scalar> Expansion<R> {
    /// Returns `a - b`.
    pub fn difference(a: R, b: R) -> Expansion<R> {
        let (sum, error) = two_sum(a, -b);
        Expansion(vec![error, sum])
    }

    /// Returns the sum of two numbers, adding one part at a time (Shewchuk's Grow-Expansion).
    #[must_use]
    pub fn plus(mut self, other: &Expansion<R>) -> Expansion<R> {
        for part in &other.0 {
            let mut carried = *part;
            for own in &mut self.0 {
                (carried, *own) = two_sum(carried, *own);
            }
            self.0.push(carried);
        }
        self.without_zeros()
    }

    /// Returns this number times `factor` (Shewchuk's Scale-Expansion, with sums).
    #[must_use]
    pub fn scaled(&self, factor: R) -> Expansion<R> {
        let mut scaled = Expansion(Vec::new());
        for part in &self.0 {
            let (product, error) = two_product(*part, factor);
            scaled = scaled.plus(&Expansion(vec![error, product]));
        }
        scaled
    }

    /// Returns the product of two numbers.
    #[must_use]
    pub fn times(&self, other: &Expansion<R>) -> Expansion<R> {
        let scaled = other.0.iter().map(|part| self.scaled(*part));
        scaled.fold(Expansion(Vec::new()), |sum, scaled| sum.plus(&scaled))
    }

    /// Returns the nearest float or an adjacent one; the sign is correct.
    pub fn value(&self) -> R {
        let parts = self.0.iter();
        parts.fold(R::from_f64(0.0), |sum, part| sum + *part)
    }

    fn without_zeros(mut self) -> Expansion<R> {
        self.0.retain(|part| part.to_f64() != 0.0);
        self
    }
}
