//! Numbers as people write them: with three digits.

/// How far a number that is written by hand may be off, relative to its size.
pub(super) const BY_HAND: f64 = 1e-3;

/// Whether a number that somebody wrote is the right one, rounded.
pub(super) fn is_near(written: f64, right: f64) -> bool {
    written == right || (written - right).abs() <= BY_HAND * right.abs().max(1e-6)
}
