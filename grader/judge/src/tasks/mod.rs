//! The tasks: a folder each, with its cases and the code that judges their answers.
//!
//! In a folder, `mod.rs` has the `Check` of the task's kind of work, `cases` its cases, `judge`
//! judges an answer, `lines` writes it to a snapshot, `repro` writes a Rust test. Kinds of work
//! that several tasks share are in `tools::kinds`. [`measurements`] and [`pictures`] are not
//! judged.

pub(crate) mod measurements;
pub(crate) mod part1_task1;
pub(crate) mod part1_task2;
pub(crate) mod part1_task3;
pub(crate) mod part1_task4;
pub(crate) mod part2_task1;
pub(crate) mod part2_task2;
pub(crate) mod part2_task3;
pub(crate) mod part3_task1;
pub(crate) mod part3_task2;
pub(crate) mod part3_task3;
pub(crate) mod part4_task1;
pub(crate) mod part4_task2;
pub(crate) mod part4_task3;
pub(crate) mod part5_task1;
pub(crate) mod part5_task2;
pub(crate) mod pictures;
pub(crate) mod scene_hits;

use crate::tools::check::any::{AnyCheck, check_of_kind};
use crate::tools::spec::Spec;
use wire::{Work, kind};

/// Defines [`check_of`] for the list of kinds of work.
macro_rules! checks {
    ($($kind:ident)*) => {
        /// Returns the check of a kind of work. Only the face uses it: a [`Spec`] has its check.
        pub(crate) fn check_of(work: &Work) -> &'static dyn AnyCheck {
            match work {
                $(Work::$kind(_) => check_of_kind::<kind::$kind>(),)*
            }
        }
    };
}

wire::each_kind!(checks);

/// Makes the cases of a task from a seed.
type MakeCases = fn(u64) -> Vec<Spec>;

/// The tasks, by their keys, and their cases. A task may have several entries.
const CASES: &[(&str, MakeCases)] = &[
    ("part1.task1", part1_task1::cases::cases),
    ("part1.task2", part1_task2::cases::cases),
    ("part1.task3", part1_task3::cases::cases),
    ("part1.task4", part1_task4::cases::cases),
    ("part2.task1", |_| part2_task1::cases::cases()),
    ("part2.task2", part2_task2::cases::cases),
    ("part2.task3", |_| part2_task3::cases::cases()),
    ("part2.task3", |_| scene_hits::cases::cases()),
    ("part3.task1", part3_task1::cases::cases),
    ("part3.task2", part3_task2::cases),
    ("part3.task3", part3_task3::cases),
    ("part4.task1", part4_task1::cases::cases),
    ("part4.task2", part4_task2::cases::cases),
    ("part4.task3", part4_task3::cases::cases),
    ("part5.task1", part5_task1::cases::cases),
    ("part5.task2", part5_task2::cases::cases),
];

/// All cases of the tasks whose keys `is_wanted`. Their questions are moved as `seed` draws.
pub(crate) fn cases(seed: u64, is_wanted: impl Fn(&str) -> bool) -> Vec<Spec> {
    let wanted = CASES.iter().filter(|(key, _)| is_wanted(key));
    let cases = wanted.flat_map(|(_, cases)| cases(seed));
    cases.map(|case| case.moved_for(seed)).collect()
}
