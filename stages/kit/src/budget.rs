//! The number of samples per pixel.

/// The number of samples per pixel, and the parameters of adaptive sampling.
///
/// ```
/// // `-s 64 -a 8 0.05`
/// let budget = kit::Budget { ns_aa: 64, batch: 8, tolerance: 0.05 };
/// assert_eq!(budget.ns_aa / budget.batch, 8);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Maximum number of samples per pixel (the flag `-s`).
    pub ns_aa: u32,
    /// Samples between two tests of the stopping criterion (the first number of `-a`). 0 counts
    /// as 1.
    pub batch: u32,
    /// Accepted error, relative to the mean (the second number of `-a`).
    pub tolerance: f64,
}
