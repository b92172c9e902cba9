//! Colours of answers, for pictures.

use crate::tasks::check_of;
use wire::work::Xyz;
use wire::{Answer, Work};

pub use crate::tools::colours::hit;

/// The linear colour of each call, each channel from 0 to 1; `None` for work whose answers have no
/// colours.
///
/// The colour of a hit is its normal, that of a camera ray its direction, that of a box the
/// distance at which the ray enters it (near is bright); a miss is black.
pub fn colours(work: &Work, answer: &Answer) -> Option<Vec<Xyz>> {
    check_of(work).colours(answer)
}
