//! Multiple importance sampling, as `direct::estimate_direct_lighting_mis` weights its samples.

use crate::real::{Mask, Real};

/// The power heuristic with exponent 2, as `direct::mis::power_heuristic`: the weight of a sample
/// with the density `own`, if the other strategy has the density `other` and as many samples.
#[inline(always)]
pub fn power_heuristic<R: Real>(own: R, other: R) -> R {
    let (zero, one) = (own.constant(0.0), own.constant(1.0));
    let ratio = other / own;
    own.equals(zero).choose(zero, one / (one + ratio * ratio))
}
