//! How answers with the same codes are alike: equal, wrong in the same way, or alike only in what
//! a statistical test compares.

use super::Signature;
use judge::findings::Aspect;

/// What two signatures with the same codes have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// Answers whose error is known exactly: a miss, a negated number, a fault with a name.
    Exact,
    /// Answers that are wrong in the same way. The numbers may differ.
    Rough,
    /// Distributions that a χ² test cannot tell apart, and nothing else.
    Distribution,
    /// Means of estimates that are off by about the same factor, and nothing else.
    Mean,
}

impl Evidence {
    /// The sentence about the answers, up to what the code with the same answers does. Of `of`
    /// places, `equal` are alike.
    pub(crate) fn says(self, description: &str, equal: usize, of: usize) -> String {
        let nearly = if equal < of { "nearly " } else { "" };
        match self {
            Evidence::Exact => format!(
                "your answers {nearly}equal those of code that {description}: on {equal} of {of} calls"
            ),
            Evidence::Rough => format!(
                "your answers are {nearly}all wrong in the same way as those of code that {description}: on {equal} of {of} calls"
            ),
            Evidence::Distribution => format!(
                "your directions are distributed like those of code that {description}: in {equal} of {of} cases"
            ),
            Evidence::Mean => format!(
                "your estimates have about the mean of those of code that {description}: in {equal} of {of} cases"
            ),
        }
    }
}

impl Signature {
    /// What code with the same codes has in common with this code.
    pub(crate) fn evidence(&self) -> Evidence {
        let aspects = self.cases().keys().map(|key| key.side.place());
        let is_only = |aspect| {
            let mut aspects = aspects.clone();
            aspects.all(|place| place.is_some_and(|(own, _)| own == aspect))
        };
        if self.is_empty() {
            Evidence::Exact
        } else if is_only(Aspect::Mean) {
            Evidence::Mean
        } else if is_only(Aspect::Spread) && !self.distributions.is_empty() {
            Evidence::Distribution
        } else if self.is_rough {
            Evidence::Rough
        } else {
            Evidence::Exact
        }
    }
}
