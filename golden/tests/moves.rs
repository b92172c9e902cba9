//! An instructor's run moves every question by an exact symmetry and makes its calls in another
//! order. Moved back, the answers have the same bits.

use crate::shared::moved_back;
use base::Workspace;
use grader::course::Course;
use grader::course::moved_points::MovedPoints;
use grader::score::{CaseResult, Status, TaskResult};
use judge::Tier;
use judge::cases::{self, Spec};
use judge::moved;
use std::ops::Range;
use std::path::Path;
use wire::{Answer, Work};

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("golden is in a workspace")
}

fn course() -> Course {
    Course::read(&workspace()).expect("the course is sound")
}

/// Asks the cases with each of `seeds`, moved and not, and compares the answers.
fn compare(seeds: Range<u64>, is_asked: impl Fn(&Spec) -> bool) {
    let mut count = 0;
    for seed in seeds {
        for spec in cases::all(seed) {
            let is_the_same = !spec.is_moved() && spec.calls() < 2;
            if is_the_same || !is_asked(&spec) {
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
    println!("{count} questions");
}

/// Whole scenes and the largest tree take seconds in a debug build.
fn is_small(spec: &Spec) -> bool {
    spec.calls() < 1000 && !spec.needs_all_stages() && spec.name != "large_mesh"
}

#[test]
fn moved_answers_are_the_same_bit_for_bit() {
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
fn a_seed_draws_another_order_of_the_calls() {
    let [known, one, two] = [0, 1, 2].map(cases::all);
    for ((known, one), two) in known.iter().zip(&one).zip(&two) {
        let name = format!("{} {}", one.task, one.name);
        let [one_order, two_order] = [one, two].map(|spec| spec.case().order);
        assert_eq!(
            (known.case().order, one.unmoved().case().order),
            (vec![], vec![]),
            "{name}"
        );
        assert_eq!(one_order.is_sorted(), one.calls() < 2, "{name}");
        assert!(one_order != two_order || one.calls() < 8, "{name}");
        let mut all = one_order;
        all.sort_unstable();
        assert!(all.into_iter().eq(0..one.calls() as u32), "{name}");
    }
}

/// The core points of `task` with `seed` in the cases of stopping rules, for code that counts its
/// calls and has the answers of the known seed in their order.
fn points_by_counting(course: &Course, task: &str, seed: u64) -> f64 {
    let is_of_rule = |spec: &Spec| matches!(spec.work, Work::Stop(_) | Work::SureStop(_));
    let in_order = |seed| {
        let mut specs = cases::of(task, seed);
        specs.retain(is_of_rule);
        specs.sort_by_key(Spec::place);
        specs
    };
    let stops = |spec: &Spec| match moved_back(&spec.unmoved()) {
        Some(Answer::Stop(answers) | Answer::SureStop(answers)) => answers,
        _ => Vec::new(),
    };
    let known = in_order(0)
        .iter()
        .flat_map(stops)
        .collect::<Vec<_>>()
        .into_iter();
    let mut bits = known.map(|answer| answer.stop);
    let task = course
        .tasks()
        .find(|of| of.key == task)
        .expect("it is in the course");
    let results = in_order(seed).into_iter().map(|spec| {
        let mut answers = stops(&spec);
        let order = match spec.case().order {
            order if order.len() == answers.len() => order,
            _ => (0..answers.len() as u32).collect(),
        };
        for call in order {
            let answer = &mut answers[call as usize];
            answer.stop = bits.next().unwrap_or_default();
            answer.rule_calls.clear();
        }
        let answer = match &spec.work {
            Work::Stop(_) => Answer::Stop(answers),
            _ => Answer::SureStop(answers),
        };
        let entry = task.cases.iter().find(|entry| entry.name == spec.name);
        let entry = entry.expect("the case is in the course");
        let findings = judge::judge(&spec, entry.tier, &answer);
        CaseResult::new(entry, "", Status::Passed, findings, &[])
    });
    TaskResult::new(task, results.collect()).score
}

#[test]
fn answers_in_the_order_of_the_calls_earn_next_to_nothing_with_another_seed() {
    let course = course();
    for (task, all) in [("part5.task1", 5.0), ("part5.task2", 10.0)] {
        let known = points_by_counting(&course, task, 0);
        let drawn = (1..41).map(|seed| points_by_counting(&course, task, seed));
        let mean = drawn.sum::<f64>() / 40.0;
        println!("{task}: {known} points with the known seed, {mean} with others");
        assert!(known >= 0.7 * all, "{task}: {known}");
        assert!(mean < 0.02 * all, "{task}: {mean}");
    }
}

#[test]
fn the_cases_that_no_seed_changes_are_listed() {
    let points = MovedPoints::of(&course()).to_string();
    let listed = workspace().root().join("golden/not_moved.txt");
    let before = std::fs::read_to_string(&listed).unwrap_or_default();
    if points != before {
        std::fs::write(&listed, &points).expect("the list is written");
        panic!("golden/not_moved.txt was not up to date and is now: review the difference");
    }
}
