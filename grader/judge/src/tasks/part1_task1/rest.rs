//! Records what the judgement of a sample loop leaves open.

use super::judge::SIGMAS;
use crate::tools::aspects::chance;
use crate::tools::findings::{Aspect, Findings};
use wire::answer::PixelAnswer;
use wire::work::PixelWork;

/// The positions in a pixel are judged if their variance may be off by at most this, which is what
/// samples from the inner three quarters of a pixel are off by.
const JUDGED_WITHIN: f64 = (1.0 - 0.75 * 0.75) / 12.0;

/// Records the pixels whose random samples are too few to test their distribution.
pub(super) fn pixels(findings: &mut Findings, work: &PixelWork, answers: &[PixelAnswer]) {
    let samples: usize = answers.iter().map(|answer| answer.points.len()).sum();
    // The bound of the test: the variance of (u - 1/2)² is 1/180.
    let allowed = 1.0 / f64::from(work.ns_aa.max(1)) + SIGMAS / (180.0 * samples as f64).sqrt();
    let is_tested = allowed <= JUDGED_WITHIN;
    if work.ns_aa <= 1 || is_tested {
        return;
    }
    for (call, answer) in answers.iter().enumerate() {
        if !answer.points.is_empty() {
            findings.not_judged(Aspect::Spread, call, chance::TOO_FEW);
        }
    }
}
