//! What is not judged.

use super::Aspect;

/// An aspect that is not judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct NotJudged {
    /// The aspect.
    pub aspect: Aspect,
    /// The number of the call; `None` for all calls of the case.
    pub call: Option<u32>,
    /// Why, as a sentence without a full stop.
    pub why: &'static str,
}
