//! Significant digits.

/// The decimals with which `x`, which is not 0, has this many significant digits; 0 if it has as
/// many before the point.
///
/// ```
/// use base::digits::decimals;
/// let [small, large] = [0.012345, 1234.5].map(|x| format!("{x:.*}", decimals(x, 3)));
/// assert_eq!((small.as_str(), large.as_str()), ("0.0123", "1234"));
/// ```
pub fn decimals(x: f64, digits: usize) -> usize {
    (digits as f64 - 1.0 - x.abs().log10().floor()).max(0.0) as usize
}
