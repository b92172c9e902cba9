//! Records what the judgement of a sample loop leaves open.

use crate::chance;
use crate::tally::{Aspect, Tally};
use wire::answer::PixelAnswer;
use wire::work::PixelWork;

/// From this number of samples a pixel on, tests of their distribution detect a shift by a seventh
/// of a pixel.
const MIN_SAMPLES_PER_PIXEL: u32 = 16;

/// From this number of samples of a case on, tests of their distribution detect such a shift.
const MIN_SAMPLES: usize = 1000;

/// Records the pixels whose random samples are too few to test their distribution.
pub(super) fn pixels(tally: &mut Tally, work: &PixelWork, answers: &[PixelAnswer]) {
    let samples: usize = answers.iter().map(|answer| answer.points.len()).sum();
    let is_tested = work.ns_aa >= MIN_SAMPLES_PER_PIXEL && samples >= MIN_SAMPLES;
    if work.ns_aa <= 1 || is_tested {
        return;
    }
    for (call, answer) in answers.iter().enumerate() {
        if !answer.points.is_empty() {
            tally.not_judged(Aspect::Spread, call, chance::TOO_FEW);
        }
    }
}
