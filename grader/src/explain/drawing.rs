//! What the calls of a case have in common, drawn.

/// Words and a drawing.
pub(super) struct Drawing {
    /// What follows the sentence about the inputs.
    pub(super) words: String,
    pub(super) lines: Vec<String>,
}
