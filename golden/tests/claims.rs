//! Tests that every sentence of a report is true.
//!
//! Typical mistakes are planted in the reference's answers, alone and in pairs. Each sentence that
//! a student would read about the wrong answers is compared with these answers. `grader mutants
//! TASK` does the same for the code of each mutant of a task, `.ci/nightly mutants` for all tasks.

use super::mistakes::{TRIANGLE_MISTAKES, TriangleMistake};
use crate::shared::{SPECS, reference};
use base::Workspace;
use grader::course::Course;
use grader::diagnosis;
use grader::report::claims;
use grader::score::regularity::{self, Regularity, Shared};
use grader::score::{CaseResult, Status};
use grader::signature::Signature;
use judge::cases::Spec;
use judge::findings::{Aspect, Class};
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

/// The results of code that makes these mistakes.
fn results(
    course: &Course,
    right: &[(&Spec, Answer)],
    mistakes: &[TriangleMistake],
) -> Vec<CaseResult> {
    let task = course.tasks().find(|task| task.key == TASK);
    let entries = &task.expect("the task is in the course").cases;
    let one = |(spec, answer): &(&Spec, Answer)| {
        let entry = entries.iter().find(|entry| entry.name == spec.name)?;
        let (Work::Triangles(work), Answer::Triangles(answers)) = (&spec.work, answer) else {
            return None;
        };
        let mut answers = answers.clone();
        for (probe, answer) in work.probes.iter().zip(&mut answers) {
            let triangle = &work.triangles[probe.shape as usize];
            for mistake in mistakes {
                mistake(triangle, &probe.ray, answer);
            }
        }
        let answer = Answer::Triangles(answers);
        let findings = judge::judge_written(spec, entry.tier, &answer, &[]);
        let result = CaseResult::new(entry, spec.about, Status::Passed, findings, &[]);
        Some(CaseResult {
            calls: judge::calls(&spec.work),
            ..result
        })
    };
    right.iter().filter_map(one).collect()
}

#[test]
fn no_sentence_is_false_of_planted_mistakes() {
    let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("a workspace");
    let course = Course::read(&workspace).expect("the course is sound");
    let known = diagnosis::known(&workspace, TASK).expect("the signatures can be read");
    let right = right_answers();
    let next = TRIANGLE_MISTAKES.iter().cycle().skip(1);
    let pairs = TRIANGLE_MISTAKES.iter().zip(next);
    let mut said = 0;
    for ((name, mistake), (second, other)) in pairs {
        for mistakes in [&[*mistake][..], &[*mistake, *other]] {
            let cases = results(&course, &right, mistakes);
            let common = regularity::of(TASK, &cases, &SPECS);
            let diagnosis = diagnosis::diagnose(&known, &Signature::of(&cases));
            said += common.len() + usize::from(diagnosis.is_some());
            let of = |common: &[Regularity]| {
                claims::false_ones(TASK, &cases, &SPECS, common, diagnosis.as_ref())
            };
            assert_eq!(of(&common), [""; 0], "{name}, {second}: {}", mistakes.len());
            // A sentence that nothing is right about is seen.
            if !cases
                .iter()
                .any(|case| case.findings.iter().any(|f| f.wrong > 0))
            {
                continue;
            }
            for shared in [
                Shared::Fields(Vec::new()),
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
