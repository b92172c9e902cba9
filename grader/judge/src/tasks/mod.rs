//! The tasks: a folder each, with its cases and the code that judges their answers.
//!
//! In a folder, `mod.rs` has the `Check` of the task's kind of work, `cases` its cases, `judge`
//! judges an answer, `lines` writes it to a snapshot, `repro` writes a Rust test. Kinds of work
//! that several tasks share have folders of their own: [`brute_force`] (rays through a list of
//! shapes), [`direct_light`], [`scene_hits`]. [`measurements`] and [`pictures`] are not judged.

pub(crate) mod brute_force;
pub(crate) mod direct_light;
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

use crate::cases::Spec;
use crate::check::{CheckedQuestion, ErasedCheck};
use wire::{Answer, Work};

/// Defines [`check_of`] from the list of kinds of work and their checks.
macro_rules! checks {
    ($($kind:ident => $check:ty,)*) => {
        /// Returns the check of a kind of work, with its question.
        pub(crate) fn check_of(work: &Work) -> Box<dyn ErasedCheck + '_> {
            match work {
                $(Work::$kind(question) => Box::new(CheckedQuestion::<'_, $check> {
                    question,
                    answer_of_kind: |answer| match answer {
                        Answer::$kind(answer) => Some(answer),
                        _ => None,
                    },
                }),)*
            }
        }
    };
}

checks! {
    Pixels => part1_task1::Pixels,
    CameraRays => part1_task2::CameraRays,
    Triangles => part1_task3::Triangles,
    Spheres => part1_task4::Spheres,
    BruteForce => brute_force::BruteForce,
    Build => part2_task1::Build,
    BuildGrowth => part2_task1::growth::BuildGrowth,
    Boxes => part2_task2::Boxes,
    Traverse => part2_task3::Traverse,
    SceneHits => scene_hits::SceneHits,
    Lambert => part3_task1::Lambert,
    Direct => direct_light::Direct,
    Specular => part4_task1::Specular,
    Paths => part4_task2::Paths,
    Roulette => part4_task3::Roulette,
    Stop => part5_task1::Stop,
    AdaptivePixels => part5_task1::AdaptivePixels,
    SureStop => part5_task2::SureStop,
    Timing => measurements::Timing,
    TimeTest => measurements::TimeTest,
    Visits => measurements::Visits,
    Picture => pictures::Picture,
}

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

/// All cases of the tasks whose keys `is_wanted`.
pub(crate) fn cases(seed: u64, is_wanted: impl Fn(&str) -> bool) -> Vec<Spec> {
    let wanted = CASES.iter().filter(|(key, _)| is_wanted(key));
    wanted.flat_map(|(_, cases)| cases(seed)).collect()
}
