//! An instructor's run moves every question by an exact symmetry and makes its calls in another
//! order. Moved back, the answers have the same bits.

use crate::shared::{AfterTheGoldens, moved_back, reference};
use base::Workspace;
use grader::course::moved_points::MovedPoints;
use grader::course::{Course, Task};
use grader::score::{CaseResult, Status, TaskResult};
use judge::Tier;
use judge::cases::{self, Spec};
use judge::moved;
use std::ops::Range;
use std::path::Path;
use wire::adaptive::StopAnswer;
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

/// What a stopping rule returns in the calls of a case.
fn stops(spec: &Spec) -> Vec<bool> {
    match reference(spec) {
        Some(Answer::Stop(answers) | Answer::SureStop(answers)) => {
            answers.iter().map(|answer| answer.stop).collect()
        }
        _ => Vec::new(),
    }
}

/// The cases of the stopping rule of `task`, in the order in which they run with `seed`.
fn cases_of_rule(task: &str, seed: u64) -> Vec<Spec> {
    let mut specs = cases::of(task, seed);
    specs.retain(|spec| matches!(spec.work, Work::Stop(_) | Work::SureStop(_)));
    specs.sort_by_key(Spec::place);
    specs
}

/// The core points of code that returns the next of `bits` at each call of the rule of `task`,
/// whatever it is called with.
fn points_of(bits: impl IntoIterator<Item = bool>, task: &Task, seed: u64) -> f64 {
    let mut bits = bits.into_iter();
    let results = cases_of_rule(&task.key, seed).into_iter().map(|spec| {
        let nothing = StopAnswer {
            stop: false,
            rule_calls: Vec::new(),
        };
        let mut answers = vec![nothing; spec.calls()];
        let mut calls = spec.case().order;
        if calls.is_empty() {
            calls = (0..answers.len() as u32).collect();
        }
        for call in calls {
            answers[call as usize].stop = bits.next().unwrap_or_default();
        }
        let answer = match &spec.work {
            Work::Stop(_) => Answer::Stop(answers),
            _ => Answer::SureStop(answers),
        };
        let entry = (task.cases.iter().find(|entry| entry.name == spec.name))
            .expect("the case is in the course");
        let findings = judge::judge(&spec, entry.tier, &answer);
        CaseResult::new(entry, "", Status::Passed, findings, &[])
    });
    TaskResult::new(task, results.collect()).score
}

#[test]
fn answers_in_the_order_of_the_calls_earn_less_than_a_constant() {
    let _begin = AfterTheGoldens;
    let course = course();
    for key in ["part5.task1", "part5.task2"] {
        let task = course
            .tasks()
            .find(|task| task.key == key)
            .expect("it is in the course");
        let known = cases_of_rule(key, 0);
        let bits: Vec<bool> = known.iter().flat_map(stops).collect();
        if bits.is_empty() {
            continue; // a handout
        }
        let constants = [true, false].map(|bit| points_of(std::iter::repeat(bit), task, 1));
        let constant = constants[0].max(constants[1]);
        let by_heart = |seed| points_of(bits.iter().copied(), task, seed);
        let drawn = (1..11).map(by_heart).sum::<f64>() / 10.0;
        println!(
            "{key}: {} points with the known seed, {drawn} with others, a constant: {constant}",
            by_heart(0)
        );
        assert!(by_heart(0) >= 5.0 && drawn <= constant, "{key}: {drawn}");
    }
}

#[test]
fn the_cases_that_no_seed_changes_are_listed() {
    let _begin = AfterTheGoldens;
    let points = MovedPoints::of(&course()).to_string();
    let listed = workspace().root().join("golden/not_moved.txt");
    let before = std::fs::read_to_string(&listed).unwrap_or_default();
    if points != before {
        std::fs::write(&listed, &points).expect("the list is written");
        panic!("golden/not_moved.txt was not up to date and is now: review the difference");
    }
}
