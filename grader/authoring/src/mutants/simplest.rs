//! Measures how simple the calls are that show the mistakes of a task to students.

use super::run::{Graded, Kind, VersionsWorker};
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::diagnosis::simplest::{self, SimplestCall};
use grader::report::{claims, message};
use grader::score::regularity;
use grader::workers::stage_workers::StageWorkers;
use judge::cases::{self, Spec};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// What the simple questions of a task show of its mutants.
#[derive(Clone, Debug, Default)]
pub struct Simplest {
    /// The mutants that lose core points, each with the simplest call that shows it, if there is
    /// one.
    pub shown: Vec<Shown>,
    /// What correct versions answer wrongly to simple questions: each is a defect of the question
    /// or of the judge.
    pub accused: Vec<String>,
}

/// What a student with one mutant's code is shown.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The mutant.
    pub mutant: String,
    /// The simplest call.
    pub call: Option<SimplestCall>,
    /// The digits of the worst answer, which was shown before there were simple calls.
    pub digits_of_worst: usize,
    /// What is false of the call, and of what the wrong answers have in common above it.
    pub false_claims: Vec<String>,
    /// How long the search took.
    pub took: Duration,
}

impl Shown {
    /// What a student with the code of `graded`, which `workers` run, is shown.
    pub(super) fn of(
        workers: &StageWorkers,
        graded: Graded,
        specs: &[Spec],
    ) -> Result<Shown, GraderError> {
        let Graded { name, result, .. } = graded;
        let worst = result.failed_cases().find_map(|case| case.worst());
        let started = Instant::now();
        let call = simplest::of_task(workers, &result, specs)?;
        let wrong_where = call.as_ref().map_or(&[][..], |call| &call.wrong_where);
        let common = regularity::beside(&result.key, &result.cases, specs, wrong_where);
        let of_call = call
            .iter()
            .flat_map(|call| claims::false_of_call(call, &common));
        Ok(Shown {
            mutant: name,
            false_claims: of_call.collect(),
            call,
            digits_of_worst: worst.map_or(0, |(_, worst)| {
                digits(&message::with_telling_digits(&worst.message))
            }),
            took: started.elapsed(),
        })
    }

    /// The digits of the call and its results, as students see them.
    pub fn digits(&self) -> Option<usize> {
        let call = self.call.as_ref()?;
        Some(digits(&message::input(call)) + digits(&message::found(call)))
    }

    /// Whether the call's input consists of integers and halves of at most two digits.
    pub fn is_of_small_numbers(&self) -> bool {
        self.call.as_ref().is_some_and(|call| {
            numbers(&call.input)
                .all(|x| x.is_infinite() || x.abs() < 100.0 && (2.0 * x).fract() == 0.0)
        })
    }
}

/// Looks for the simplest call of every mutant of `task` that loses core points, and asks every
/// correct version all simple questions.
pub fn of_task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
) -> Result<Simplest, GraderError> {
    let worker = VersionsWorker::of_mutants(workspace, course, task)?;
    let specs = cases::of(&task.key, 0);
    let each: Vec<Simplest> = (0..worker.versions.len())
        .into_par_iter()
        .map(|version| of_version(&worker, task, &specs, version))
        .collect::<Result<_, _>>()?;
    Ok(each.into_iter().fold(Simplest::default(), |mut all, one| {
        all.shown.extend(one.shown);
        all.accused.extend(one.accused);
        all
    }))
}

fn of_version(
    worker: &VersionsWorker<'_>,
    task: &Task,
    specs: &[Spec],
    version: usize,
) -> Result<Simplest, GraderError> {
    let workers = worker.workers(version);
    let graded = worker.grade_one(task, specs, version, None)?;
    let mut found = Simplest::default();
    match graded.kind {
        Kind::Correct => {
            let of_task: Vec<&Spec> = specs.iter().filter(|spec| spec.task == task.key).collect();
            let wrong = simplest::wrong_answers(&workers, &of_task)?.into_iter();
            found.accused = wrong
                .map(|wrong| format!("{}: {wrong}", graded.name))
                .collect();
        }
        Kind::Mutant(_) if graded.result.score < graded.result.max_score => {
            found.shown.push(Shown::of(&workers, graded, specs)?);
        }
        Kind::Mutant(_) => {}
    }
    Ok(found)
}

fn digits(text: &str) -> usize {
    text.bytes().filter(u8::is_ascii_digit).count()
}

/// The numbers in a text, without those inside words such as `p0`.
fn numbers(text: &str) -> impl Iterator<Item = f64> {
    let is_part = |c: char| c.is_alphanumeric() || "._-+".contains(c);
    text.split(move |c| !is_part(c))
        .filter_map(|word| word.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::findings::Message;

    fn shown(input: &str) -> Shown {
        Shown {
            mutant: String::new(),
            call: Some(SimplestCall {
                case: String::new(),
                aspect: None,
                function: None,
                input: input.into(),
                result: Message::default(),
                test: None,
                only: None,
                wrong_where: Vec::new(),
                shown: None,
            }),
            digits_of_worst: 0,
            false_claims: Vec::new(),
            took: Duration::ZERO,
        }
    }

    #[test]
    fn small_numbers_are_integers_and_halves_of_two_digits() {
        let is_small = |input: &str| shown(input).is_of_small_numbers();
        assert!(is_small("p0 = (0.0, -1, 0.5), t in [0.0, inf]"));
        assert!(!is_small("o = (0.25, 0, 0)"));
        assert!(!is_small("x = 100"));
        assert_eq!(shown("p0 = (12.5, 1)").digits(), Some(5));
    }
}
