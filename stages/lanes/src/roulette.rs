//! Russian roulette, as `global::play_roulette` plays it.

use crate::real::Real;
use crate::vec3::Vec3;

/// The probability with which a path of this throughput survives: its largest channel, at most 1. A
/// path with 0 always ends.
#[inline(always)]
pub fn survival_probability<R: Real>(throughput: Vec3<R>) -> R {
    let largest = throughput.x.max(throughput.y).max(throughput.z);
    largest.min(largest.constant(1.0))
}

/// Plays with the probability `q` and `u` in [0, 1). Returns the throughput of a survivor, and
/// whether the path survives.
#[inline(always)]
pub fn play<R: Real>(throughput: Vec3<R>, q: R, u: R) -> (Vec3<R>, R::Mask) {
    (throughput / q, u.less(q))
}
