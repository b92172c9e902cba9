//! Judging: from what the student's code answered to what is right and wrong about it.
//!
//! Each kind of work has a `check::Check` in the folder of its task, in `tasks`, where one
//! list maps each kind to its check. [`fits`] tests the form of an answer, [`judge`] what it says.
//! What several checks need: `hits` judges hit records, `numbers` colours and directions,
//! `chance` what only many samples show; [`truth`] has what the oracle says of triangles and
//! spheres, [`scene`] of whole scenes, [`expected_cache`] keeps it; [`expected`] is the form in which it
//! comes. [`tally`] counts aspect by aspect, [`errors`] measures how far off numbers are.
//! [`snapshot`] writes goldens, [`repro`] Rust tests, [`picture`] pictures.

pub mod cases;
mod chance;
mod check;
pub mod convert;
pub mod errors;
pub mod expected;
pub mod expected_cache;
mod hits;
mod numbers;
pub mod picture;
mod plural;
pub mod repro;
pub mod scene;
pub mod snapshot;
pub mod tally;
mod tasks;
mod tier;
pub mod truth;

pub use plural::plural;
pub use tier::Tier;

use cases::Spec;
use tally::{Finding, Tally};
use wire::{Answer, Work};

/// Whether `answer`, which comes from an untrusted worker, has the form that `work` calls for: its
/// kind, its number of entries, its indices. Only an answer that fits may be judged, written or
/// shown. The error ends the sentence "the worker's record does not fit the case: ...".
pub fn fits(work: &Work, answer: &Answer) -> Result<(), String> {
    tasks::check_of(work).fits(answer)
}

/// What is right and wrong about `answer`, which [`fits`], to the case `spec`, which gives points
/// of `tier`: core points ask of rounding errors what textbook code can give, robust points what
/// stable code can.
pub fn judge(spec: &Spec, tier: Tier, answer: &Answer) -> Vec<Finding> {
    let mut tally = Tally::default();
    tasks::check_of(&spec.work).judge(&mut tally, spec, tier, answer);
    let mut findings = tally.into_findings();
    let is_about = |finding: &Finding| {
        spec.about_aspects.is_empty() || spec.about_aspects.contains(&finding.aspect)
    };
    findings.retain(is_about);
    findings
}
