//! Finds the simplest call on which the code is wrong in the same way as in a failed case.
//!
//! The stage's worker gets the simple questions of the case's kind of work (`Spec::simple`), the
//! same for everybody, and the judge of the case judges the answers. The first wrong answer with
//! the same aspect, the same function and the same class of error is the simplest.

use crate::score::{CaseResult, TaskResult, order};
use crate::workers::crash::{self, Crash};
use crate::workers::runner::Ending;
use crate::workers::stage_workers::StageWorkers;
use base::GraderError;
use judge::cases::Spec;
use judge::shown::ShownCall;
use judge::tally::{Aspect, Class, Fault, Finding};
use judge::{Tier, repro};
use serde::Serialize;
use wire::Outcome;

/// The most failed cases for which a simple call is looked for; the first that has one is shown.
const MOST_CASES: usize = 4;

/// The simplest call on which the code is wrong in the way of a failed case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SimplestCall {
    /// The failed case.
    pub case: String,
    /// What is wrong; `None` if the code crashes.
    pub aspect: Option<Aspect>,
    /// What the function is called with.
    pub input: String,
    /// Its result and the expected one, or how it crashes.
    pub result: String,
    /// The call as a Rust test, if it fits in a short one.
    #[serde(skip)]
    pub test: Option<String>,
    /// The call with its results, to be drawn.
    #[serde(skip)]
    pub shown: Option<ShownCall>,
}

/// The simplest call for the failed cases of `task`, of which those that show the most come first.
/// Looks at the core cases, and at those of extra credit if no core case failed. `None` if no
/// simple question shows what is wrong.
pub fn of_task(
    workers: &StageWorkers,
    task: &TaskResult,
    specs: &[Spec],
) -> Result<Option<SimplestCall>, GraderError> {
    let failed = order::failed_cases_that_count(task);
    for case in failed.into_iter().take(MOST_CASES) {
        let spec = specs.iter().find(|spec| spec.is(&task.key, &case.name));
        let Some(spec) = spec.filter(|spec| !spec.needs_all_stages()) else {
            continue;
        };
        let simplest = of_case(workers, case, spec)?;
        if simplest.is_some() {
            return Ok(simplest);
        }
    }
    Ok(None)
}

/// The simplest call for one failed case.
fn of_case(
    workers: &StageWorkers,
    case: &CaseResult,
    spec: &Spec,
) -> Result<Option<SimplestCall>, GraderError> {
    let simple = spec.simple();
    if simple.is_empty() {
        return Ok(None);
    }
    let endings = workers.run(&simple.iter().collect::<Vec<_>>(), &mut Vec::new())?;
    let asked = || simple.iter().zip(&endings);
    if case.crash.is_some() {
        let mut crashed = asked().filter_map(|(spec, ending)| crash(case, spec, ending));
        return Ok(crashed.next());
    }
    // Core judgement: a simple question needs no more than textbook code.
    let answered = asked().filter_map(|(spec, ending)| {
        let Ok(Ending::Recorded(record)) = ending else {
            return None;
        };
        let Outcome::Answered(answer) = &record.outcome else {
            return None;
        };
        let holes = record.holes.iter().map(|hole| hole.called.clone());
        let holes: Vec<String> = holes.collect();
        let judged = judge::judge_each(spec, Tier::Core, answer, &holes);
        Some((spec, answer, judged))
    });
    let answered: Vec<_> = answered.collect();
    let wrong = case.findings.iter().filter(|finding| finding.wrong > 0);
    for target in wrong {
        for likeness in [Likeness::Same, Likeness::Kind] {
            for (simple, answer, (findings, wrong)) in &answered {
                let Some(fault) = first_like(target, findings, likeness) else {
                    continue;
                };
                let message = wrong.iter().find(|wrong| {
                    let of_function = |name: &str| wrong.message.starts_with(name);
                    wrong.call == fault.call
                        && wrong.aspect == target.aspect
                        && fault.function.is_none_or(of_function)
                });
                let of_call = || wrong.iter().find(|wrong| wrong.call == fault.call);
                let Some(message) = message.or_else(of_call) else {
                    continue;
                };
                return Ok(Some(SimplestCall {
                    aspect: Some(target.aspect),
                    result: message.message.clone(),
                    shown: simple.shown(Tier::Core, fault.call as usize, Some(answer)),
                    ..call(case, simple, fault.call)
                }));
            }
        }
    }
    Ok(None)
}

/// The wrong answers to the simple questions of the cases `specs`, as sentences. Correct code has
/// none.
pub fn wrong_answers(workers: &StageWorkers, specs: &[&Spec]) -> Result<Vec<String>, GraderError> {
    let mut asked: Vec<Vec<Spec>> = Vec::new();
    for spec in specs {
        let simple = spec.simple();
        let works = |specs: &[Spec]| {
            specs
                .iter()
                .map(|spec| spec.work.clone())
                .collect::<Vec<_>>()
        };
        if asked.iter().all(|asked| works(asked) != works(&simple)) {
            asked.push(simple);
        }
    }
    let mut asked: Vec<Spec> = asked.into_iter().flatten().collect();
    for spec in &mut asked {
        // All aspects, whatever the case is about.
        spec.about_aspects = &[];
    }
    let endings = workers.run(&asked.iter().collect::<Vec<_>>(), &mut Vec::new())?;
    let mut sentences = Vec::new();
    for (spec, ending) in asked.iter().zip(&endings) {
        let outcome = ending.as_ref().ok().and_then(Ending::outcome);
        let Some(Outcome::Answered(answer)) = outcome else {
            sentences.push(format!("{}: no answer", spec.work.kind()));
            continue;
        };
        let (_, wrong) = judge::judge_each(spec, Tier::Core, answer, &[]);
        sentences.extend(wrong.into_iter().map(|wrong| {
            let input = spec.input(wrong.call as usize).unwrap_or_default();
            format!("{input}: {}: {}", wrong.aspect.label(), wrong.message)
        }));
    }
    Ok(sentences)
}

/// How like two faults of one function in one aspect must be.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Likeness {
    /// Of the same class.
    Same,
    /// Of the same kind of class: the size of the error may depend on the input.
    Kind,
}

/// The first fault in `findings` that is like one of the `target`'s.
fn first_like<'a>(
    target: &Finding,
    findings: &'a [Finding],
    likeness: Likeness,
) -> Option<&'a Fault> {
    let finding = findings
        .iter()
        .find(|finding| finding.aspect == target.aspect)?;
    let kind = std::mem::discriminant::<Class>;
    finding.faults.iter().find(|fault| {
        target.faults.iter().any(|other| {
            fault.function == other.function
                && match likeness {
                    Likeness::Same => fault.class == other.class,
                    Likeness::Kind => kind(&fault.class) == kind(&other.class),
                }
        })
    })
}

/// The call of a simple question in which the code crashed.
fn crash(case: &CaseResult, spec: &Spec, ending: &Result<Ending, String>) -> Option<SimplestCall> {
    let ending = ending.as_ref().ok()?;
    let number = Crash::of(ending)?.call?;
    Some(SimplestCall {
        aspect: None,
        result: format!("your code {}", crash::describe(ending)?),
        ..call(case, spec, number)
    })
}

/// The call number `call` of a simple question, without what is wrong.
fn call(case: &CaseResult, spec: &Spec, call: u32) -> SimplestCall {
    SimplestCall {
        case: case.name.clone(),
        aspect: None,
        input: spec.input(call as usize).unwrap_or_default(),
        result: String::new(),
        test: repro::of_work(
            &spec.work,
            Tier::Core,
            call as usize,
            "On this call the code was wrong as in a failed case of the grader.",
            "simple_call",
        ),
        shown: None,
    }
}
