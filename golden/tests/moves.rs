//! An instructor's run moves every question by an exact symmetry. Moved back, the answers have the
//! same bits.

use crate::shared::{AfterTheGoldens, moved_back};
use base::Workspace;
use grader::course::Course;
use grader::course::moved_points::MovedPoints;
use judge::Tier;
use judge::cases::{self, Spec};
use judge::moved;
use std::ops::Range;
use std::path::Path;
use wire::Work;

/// Asks the cases with each of `seeds`, moved and not, and compares the answers.
fn compare(seeds: Range<u64>, is_asked: impl Fn(&Spec) -> bool) {
    let mut count = 0;
    for seed in seeds {
        for spec in cases::all(seed) {
            if !spec.is_moved() || !is_asked(&spec) {
                continue;
            }
            let name = format!("{} {} with seed {seed}", spec.task, spec.name);
            let (Some(here), Some(there)) = (moved_back(&spec.unmoved()), moved_back(&spec)) else {
                continue;
            };
            count += 1;
            assert!(moved::has_same_bits(&here, &there), "{name}");
            let passed = |answer| {
                let findings = judge::judge(&spec, Tier::Robust, answer).into_iter();
                findings
                    .map(|finding| (finding.aspect, finding.passed()))
                    .collect::<Vec<_>>()
            };
            assert_eq!(passed(&here), passed(&there), "{name}");
        }
    }
    println!("{count} moved questions");
}

/// Whole scenes and the largest tree take seconds in a debug build.
fn is_small(spec: &Spec) -> bool {
    spec.calls() < 1000 && !spec.needs_all_stages() && spec.name != "large_mesh"
}

#[test]
fn moved_answers_are_the_same_bit_for_bit() {
    let _begin = AfterTheGoldens;
    compare(1..3, is_small);
}

#[test]
#[ignore = "a thousand symmetries of every case: minutes"]
fn a_thousand_moves_change_no_bit() {
    compare(1..1001, is_small);
    compare(1..4, |_| true);
}

/// A question that the seed does not change is moved to another question.
#[test]
fn a_move_changes_the_question() {
    for spec in cases::all(7) {
        let text = |work: &Work| format!("{work:?}");
        let is_other = text(&spec.case().work) != text(&spec.work);
        assert_eq!(is_other, spec.is_moved(), "{} {}", spec.task, spec.name);
    }
    assert!(cases::all(0).iter().all(|spec| !spec.is_moved()));
}

#[test]
fn the_cases_that_no_seed_changes_are_listed() {
    let _begin = AfterTheGoldens;
    let workspace =
        Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("golden is in a workspace");
    let course = Course::read(&workspace).expect("the course is sound");
    let points = MovedPoints::of(&course).to_string();
    let listed = workspace.root().join("golden/not_moved.txt");
    let before = std::fs::read_to_string(&listed).unwrap_or_default();
    if points != before {
        std::fs::write(&listed, &points).expect("the list is written");
        panic!("golden/not_moved.txt was not up to date and is now: review the difference");
    }
}
