//! Tests that every sentence of a report is true.
//!
//! Typical mistakes are planted in the reference's answers, alone and in pairs. Each sentence that
//! a student would read about the wrong answers is compared with these answers. `grader mutants
//! TASK` does the same for the code of each mutant of a task, `.ci/nightly mutants` for all tasks.

use super::mistakes::{TRIANGLE_MISTAKES, TriangleMistake};
use crate::shared::{AfterTheGoldens, SPECS, reference};
use base::Workspace;
use grader::course::{Course, Task};
use grader::diagnosis::{self, Explanation};
use grader::report::claims;
use grader::score::regularity::{Regularity, Shared};
use grader::score::{CaseResult, Status, TaskResult};
use judge::Tier;
use judge::cases::Spec;
use judge::findings::{Aspect, Class, WrongAnswer};
use std::collections::BTreeMap;
use std::path::Path;
use wire::{Answer, Work};

const TASK: &str = "part1.task3";

/// The cases of the task whose answers are those of triangles, with the reference's answers.
fn right_answers() -> Vec<(&'static Spec, Answer)> {
    let of_task = SPECS.iter().filter(|spec| spec.task == TASK);
    let triangles = of_task.filter(|spec| matches!(spec.work, Work::Triangles(_)));
    triangles
        .filter_map(|spec| Some((spec, reference(spec)?.clone())))
        .collect()
}

/// The answer with these mistakes.
fn planted(spec: &Spec, right: &Answer, mistakes: &[TriangleMistake]) -> Answer {
    let (Work::Triangles(work), Answer::Triangles(answers)) = (&spec.work, right) else {
        panic!("{} is about triangles", spec.name)
    };
    let mut answers = answers.clone();
    for (probe, answer) in work.probes.iter().zip(&mut answers) {
        let triangle = &work.triangles[probe.shape as usize];
        for mistake in mistakes {
            mistake(triangle, &probe.ray, answer);
        }
    }
    Answer::Triangles(answers)
}

/// The results of code that makes these mistakes.
fn results(
    task: &Task,
    right: &[(&Spec, Answer)],
    mistakes: &[TriangleMistake],
) -> Vec<CaseResult> {
    let entries = &task.cases;
    let one = |(spec, answer): &(&Spec, Answer)| {
        let entry = entries.iter().find(|entry| entry.name == spec.name)?;
        let answer = planted(spec, answer, mistakes);
        let findings = judge::judge_written(spec, entry.tier, &answer, &[]);
        let result = CaseResult::new(entry, spec.about, Status::Passed, findings, &[]);
        Some(CaseResult {
            calls: judge::calls(&spec.work),
            ..result
        })
    };
    right.iter().filter_map(one).collect()
}

/// What is false of the messages and the drawings of the answers that these mistakes make wrong: of
/// the first ones of each aspect in each case, as a report may show them.
fn false_of_calls(right: &[(&Spec, Answer)], mistakes: &[TriangleMistake]) -> Vec<String> {
    let mut found = Vec::new();
    for (spec, answer) in right {
        let answer = planted(spec, answer, mistakes);
        let (_, wrong) = judge::judge_each(spec, Tier::Core, &answer, &[]);
        let mut shown: BTreeMap<Aspect, usize> = BTreeMap::new();
        for WrongAnswer {
            aspect,
            fault,
            message,
        } in &wrong
        {
            let shown = shown.entry(*aspect).or_default();
            *shown += 1;
            if *shown > SHOWN {
                continue;
            }
            let call = spec.shown(Tier::Core, fault.call as usize, Some(&answer));
            let of_drawing = call.iter().flat_map(claims::false_of_drawing);
            let of_message = claims::false_of_message(message).into_iter();
            let each = of_message.chain(of_drawing);
            found.extend(each.map(|says| format!("{} {}: {says}", spec.name, fault.call)));
        }
    }
    found
}

/// The most wrong answers of an aspect that are looked at in a case.
const SHOWN: usize = 3;

/// Mistakes that are hard to see in a report: numbers that differ late, points beside the ray, a
/// miss of the record alone.
const HARD_TO_SEE: [(&str, TriangleMistake); 4] = [
    ("t in single precision", |_, _, answer| {
        if let Some(hit) = &mut answer.hit {
            hit.t = f64::from(hit.t as f32) * (1.0 + 1e-7);
        }
    }),
    ("points to the side", |_, _, answer| {
        if let Some(hit) = &mut answer.hit {
            hit.p[0] += 1e-5;
        }
    }),
    ("misses after a hit", |_, ray, answer| {
        (answer.hit, answer.ray_after) = (None, *ray)
    }),
    ("normals a little off", |_, _, answer| {
        if let Some(hit) = &mut answer.hit {
            hit.n = [0, 1, 2].map(|i| 0.999 * hit.n[i] + 0.04 * hit.ng[(i + 1) % 3]);
        }
    }),
];

#[test]
fn no_message_and_no_drawing_hides_what_is_wrong() {
    let _begin = AfterTheGoldens;
    let right = right_answers();
    for (name, mistake) in TRIANGLE_MISTAKES.iter().chain(&HARD_TO_SEE) {
        assert_eq!(false_of_calls(&right, &[*mistake]), [""; 0], "{name}");
    }
}

#[test]
fn no_sentence_is_false_of_planted_mistakes() {
    let _begin = AfterTheGoldens;
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("a workspace");
    let course = Course::read(&workspace).expect("the course is sound");
    let mut tasks = course.tasks().filter(|task| task.key == TASK);
    let task = tasks.next().expect("the task is in the course");
    let known = diagnosis::known(&workspace, TASK).expect("the signatures can be read");
    let right = right_answers();
    let next = TRIANGLE_MISTAKES.iter().cycle().skip(1);
    let pairs = TRIANGLE_MISTAKES.iter().zip(next);
    let mut said = 0;
    for ((name, mistake), (second, other)) in pairs {
        for mistakes in [&[*mistake][..], &[*mistake, *other]] {
            let result = TaskResult::new(task, results(task, &right, mistakes));
            let cases = &result.cases;
            let Explanation {
                diagnosis,
                regularities,
            } = diagnosis::explain(&result, cases, &known, (&SPECS, 0), &[]);
            said += regularities.len() + usize::from(diagnosis.is_some());
            let of = |common: &[Regularity]| {
                claims::false_ones(TASK, cases, &SPECS, common, diagnosis.as_ref())
            };
            let planted = mistakes.len();
            assert_eq!(of(&regularities), [""; 0], "{name}, {second}: {planted}");
            // A sentence that nothing is right about is seen.
            if !cases
                .iter()
                .any(|case| case.findings.iter().any(|f| f.wrong > 0))
            {
                continue;
            }
            for shared in [
                Shared::Fields {
                    wrong: Vec::new(),
                    all_judged: true,
                },
                Shared::Function("nobody"),
                Shared::Circumstances(vec!["the moon shines"]),
                Shared::Manner {
                    aspect: Aspect::Pdf,
                    class: Class::Zero,
                    has_exceptions: true,
                    is_robust: false,
                },
            ] {
                let planted = Regularity {
                    in_core: false,
                    shared,
                };
                assert_eq!(
                    of(std::slice::from_ref(&planted)).len(),
                    1,
                    "{name}: {planted}"
                );
            }
        }
    }
    // In a handout nothing is written yet.
    assert!(said > 20 || right.is_empty(), "only {said} sentences");
}
