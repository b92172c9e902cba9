//! Single precision numbers on one side of a double precision number. Without the branches of
//! `next_up`, for code that every ray runs.

/// A number at or above `x`, by at most a few units in the last place. NaN for -∞.
#[inline(always)]
pub(crate) fn at_least(x: f64) -> f32 {
    let x = x as f32;
    x + (x.abs() * f32::EPSILON + f32::MIN_POSITIVE)
}

/// A number at or below `x`, by at most a few units in the last place, and not ∞.
#[inline(always)]
pub(crate) fn at_most(x: f64) -> f32 {
    let x = (x as f32).min(f32::MAX);
    x - (x.abs() * f32::EPSILON + f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_on_their_side_and_near() {
        for x in [
            0.0,
            1e-300,
            1e-45,
            1e-38,
            0.1,
            1.0,
            1.0 / 3.0,
            4e6,
            1e38,
            1e300,
        ] {
            for x in [x, -x] {
                assert!(f64::from(at_least(x)) >= x || x == -1e300, "{x}");
                assert!(f64::from(at_most(x)) <= x, "{x}");
                if x.abs() < 1e37 {
                    let width = f64::from(at_least(x)) - f64::from(at_most(x));
                    assert!(width <= 4e-7 * x.abs() + 3e-38, "{x}: {width}");
                }
            }
        }
        assert_eq!(at_least(f64::INFINITY), f32::INFINITY);
        assert!(at_most(f64::INFINITY) <= f32::MAX);
        assert_eq!(at_most(f64::NEG_INFINITY), f32::NEG_INFINITY);
    }
}
