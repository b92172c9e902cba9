//! How many samples a pixel may take.

/// How many samples a pixel gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// The most samples of a pixel (the flag `-s`).
    pub ns_aa: u32,
    /// Samples between two looks at the rule (the first number of `-a`); 0 counts as 1.
    pub batch: u32,
    /// Error that is good enough, as a share of the mean (the second number of `-a`).
    pub tolerance: f64,
}
