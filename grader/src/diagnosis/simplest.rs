//! Finds the simplest call on which the code is wrong in the same way as in a failed case.
//!
//! The stage's worker gets the simple questions of the case's kind of work (`Spec::simple`), the
//! same for everybody, and the judge of the case judges the answers. The first wrong answer with
//! the same aspect, the same function and the same class of error is the simplest.

use super::{Diagnosis, Explanation};
use crate::score::{CaseResult, TaskResult, order};
use crate::sketch::Sketch;
use crate::workers::crash::{Crash, CrashKind};
use crate::workers::runner::{Ending, Patience};
use crate::workers::stage_workers::StageWorkers;
use base::GraderError;
use judge::cases::Spec;
use judge::findings::{Aspect, Class, Fault, Finding, Message, WrongAnswer};
use judge::shown::ShownCall;
use judge::{Tier, repro, variations};
use serde::{Serialize, Serializer};
use std::collections::BTreeSet;
use wire::{Answer, Outcome, Work};

/// The most failed cases for which a simple call is looked for; the first that has one is shown.
const MOST_CASES: usize = 4;

/// The simplest call on which the code is wrong in the way of a failed case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SimplestCall {
    /// The failed case.
    pub case: String,
    /// What is wrong; `None` if the code crashes.
    pub aspect: Option<Aspect>,
    /// The function that gave the wrong answer, in tasks of several.
    #[serde(skip)]
    pub function: Option<&'static str>,
    /// What the function is called with.
    pub input: String,
    /// Its result and the expected one, or how it crashes. In a report without the question, which
    /// is the input.
    #[serde(serialize_with = "without_question")]
    pub result: Message,
    /// The call as a Rust test, if it fits in a short one.
    #[serde(skip)]
    pub test: Option<String>,
    /// Why no simpler call is shown, if this one has extreme or long numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub only: Option<String>,
    /// The circumstances of this call and of all other simple ones that are wrong, as far as they
    /// are known.
    #[serde(skip)]
    pub wrong_where: Vec<Vec<&'static str>>,
    /// The call with its results, to be drawn; in a report, its drawing.
    #[serde(
        rename = "drawing",
        serialize_with = "drawing",
        skip_serializing_if = "Option::is_none"
    )]
    pub shown: Option<ShownCall>,
}

fn without_question<S: Serializer>(message: &Message, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&message.clone().asked(String::new()))
}

fn drawing<S: Serializer>(shown: &Option<ShownCall>, serializer: S) -> Result<S::Ok, S::Error> {
    let sketch = shown.as_ref().and_then(Sketch::of);
    sketch.map(|sketch| sketch.drawing()).serialize(serializer)
}

/// The simplest call for the failed cases of `task`, of which those that show the most come first.
/// Looks at the core cases, and at those of extra credit if no core case failed. `None` if neither
/// a simple question nor one of a few digits shows what is wrong.
///
/// Simple questions come first, then the same with small and with large lengths, then the worst
/// calls of the cases with fewer digits. The number of calls is the same for everybody.
pub fn of_task(
    workers: &StageWorkers,
    task: &TaskResult,
    specs: &[Spec],
) -> Result<Option<SimplestCall>, GraderError> {
    of_wrong(workers, task, specs, &|findings| findings)
}

/// The simplest call for the failed cases of `task`, and what `explain` says of their wrong
/// answers, given the circumstances of wrong simple calls.
///
/// With two mistakes at once one half may be named, and the call that is simpler than all others
/// may show the other half. Then the simplest call that the named mistake explains is shown
/// instead.
pub fn with_explanation(
    workers: &StageWorkers,
    task: &TaskResult,
    specs: &[Spec],
    explain: &dyn Fn(&[Vec<&str>]) -> Explanation,
) -> Result<(Option<SimplestCall>, Explanation), GraderError> {
    let Some(simplest) = of_task(workers, task, specs)? else {
        return Ok((None, explain(&[])));
    };
    let explanation = explain(&simplest.wrong_where);
    let of_mistake = match &explanation.diagnosis {
        Some(named) if is_of_another(&simplest, named) => {
            let choice = |findings: Vec<Finding>| explained_by(named, &findings);
            let mut explained = task.clone();
            for case in &mut explained.cases {
                case.findings = choice(std::mem::take(&mut case.findings));
            }
            of_wrong(workers, &explained, specs, &choice)?
        }
        _ => None,
    };
    Ok(match of_mistake {
        // What is said must be true of both calls.
        Some(call) => {
            let both = [simplest.wrong_where, call.wrong_where.clone()].concat();
            let explanation = explain(&both);
            (Some(call), explanation)
        }
        None => (Some(simplest), explanation),
    })
}

/// Whether a call shows wrong answers that the mistake does not explain. Where a mistake explains
/// none, or the call ends the code, this is not known.
fn is_of_another(call: &SimplestCall, mistake: &Diagnosis) -> bool {
    let is_explained = |aspect| mistake.explains(aspect, call.function);
    !mistake.places.is_empty() && !call.aspect.is_none_or(is_explained)
}

/// The findings with those wrong answers alone that the mistake explains.
fn explained_by(mistake: &Diagnosis, findings: &[Finding]) -> Vec<Finding> {
    let chosen = findings.iter().map(|finding| {
        finding.with_only(|fault| mistake.explains(finding.aspect, fault.named_function()))
    });
    chosen.collect()
}

/// Leaves only some wrong answers in the findings of a case or of a simple question.
pub type Choice<'a> = dyn Fn(Vec<Finding>) -> Vec<Finding> + 'a;

/// As [`of_task`], of the wrong answers that `choice` leaves. Those of `task` are chosen already.
pub fn of_wrong(
    workers: &StageWorkers,
    task: &TaskResult,
    specs: &[Spec],
    choice: &Choice<'_>,
) -> Result<Option<SimplestCall>, GraderError> {
    let failed = order::failed_cases_that_count(task)
        .into_iter()
        .take(MOST_CASES)
        .filter_map(|case| {
            let spec = specs.iter().find(|spec| spec.is(&task.key, &case.name));
            Some((case, spec.filter(|spec| !spec.needs_all_stages())?))
        });
    let failed: Vec<(&CaseResult, &Spec)> = failed.collect();
    let of = |workers| Answers::of(workers, choice);
    let mut answers = of(workers);
    // The first question that ends the code says enough. The others would cost its time limit each.
    let [one, short] = [Patience::OneTimeout, Patience::OneShortTimeout];
    let [one, short] = [one, short].map(|patience| workers.with(patience));
    let [mut crashing, mut endless] = [&one, &short].map(of);
    for (case, spec) in &failed {
        let answers = match case.crash().map(|crash| crash.kind) {
            Some(CrashKind::Endless) => &mut endless,
            Some(_) => &mut crashing,
            None => &mut answers,
        };
        let questions = spec.simple();
        let is_of_many = |question: &Spec| question.calls() > MANY_CALLS;
        let first_of_many = questions.iter().position(is_of_many);
        let (few, many) = questions.split_at(first_of_many.unwrap_or(questions.len()));
        for questions in [few, many] {
            let simplest = of_questions(answers, case, spec, questions)?;
            if simplest.is_some() {
                return Ok(simplest);
            }
        }
    }
    let extreme: Vec<_> = failed
        .iter()
        .filter(|(case, _)| case.crash().is_none())
        .take(MOST_EXTREME_CASES)
        .collect();
    for exponent in SCALES {
        for (case, spec) in &extreme {
            let scaled = variations::scaled(spec, exponent);
            let simplest = of_questions(&mut answers, case, spec, &scaled)?;
            if let Some(call) = simplest {
                return Ok(Some(SimplestCall {
                    only: Some(only_at(exponent)),
                    ..call
                }));
            }
        }
    }
    for (case, spec) in &extreme {
        let shortest = shortest(&answers, case, spec)?;
        if shortest.is_some() {
            return Ok(shortest);
        }
    }
    Ok(None)
}

/// A question with more calls takes long, such as one about the statistics of many samples. It is
/// asked only if those before it do not show what is wrong.
const MANY_CALLS: usize = 500;

/// The most failed cases that are looked at again if no simple question shows what is wrong.
const MOST_EXTREME_CASES: usize = 2;

/// The lengths of extreme questions, as powers of ten: those nearest to ordinary ones first.
const SCALES: [i32; 7] = [-2, 2, -4, 4, -6, -8, 6];

/// What is said of a call that shows a mistake which no question of ordinary lengths shows.
fn only_at(exponent: i32) -> String {
    let factor = 10_u64.pow(exponent.unsigned_abs());
    match exponent < 0 {
        true => {
            format!("of the simple questions only small ones show it: none {factor} times as large")
        }
        false => {
            format!("of the simple questions only large ones show it: none {factor} times as small")
        }
    }
}

/// The most rounds in which the digits of a call are reduced.
const MOST_ROUNDS: usize = 5;

/// A wrong call of a failed case with as few digits as still show what is wrong; `None` for work
/// whose numbers cannot be varied.
fn shortest(
    known: &Answers<'_>,
    case: &CaseResult,
    spec: &Spec,
) -> Result<Option<SimplestCall>, GraderError> {
    let faults = case.findings.iter().flat_map(|finding| &finding.faults);
    let Some(mut current) = faults
        .map(|fault| fault.call)
        .next()
        .and_then(|call| spec.only_call(call as usize))
    else {
        return Ok(None);
    };
    let mut shortest = None;
    for _ in 0..MOST_ROUNDS {
        let before = digits(&current);
        let mut shorter = variations::shorter(&current);
        shorter.retain(|spec| digits(spec) < before);
        shorter.sort_by_key(digits);
        let mut answers = Answers::of(known.workers, known.choice);
        let found = answered(case, &shorter, answers.to(&shorter)?, known.choice)
            .iter()
            .find_map(|asked| Some((asked.spec, alike(case, spec, std::slice::from_ref(asked))?)));
        let Some((spec, call)) = found else {
            break;
        };
        current = spec.clone();
        shortest = Some(SimplestCall {
            only: Some(SHORTEST.to_owned()),
            ..call
        });
    }
    Ok(shortest)
}

/// What is said of a call of a failed case with fewer digits.
const SHORTEST: &str = "no simple question shows it: this is a call of the case, rounded";

/// The digits in the input of a question with one call.
fn digits(spec: &Spec) -> usize {
    let input = spec.input(0).unwrap_or_default();
    input.bytes().filter(u8::is_ascii_digit).count()
}

/// Questions that were asked, with how the code answered.
type Asking = (Vec<Work>, Vec<Result<Ending, String>>);

/// What the code answers to questions. Failed cases of one kind of work have the same simple
/// questions, which are asked once.
struct Answers<'a> {
    workers: &'a StageWorkers,
    choice: &'a Choice<'a>,
    known: Vec<Asking>,
}

impl<'a> Answers<'a> {
    fn of(workers: &'a StageWorkers, choice: &'a Choice<'a>) -> Answers<'a> {
        Answers {
            workers,
            choice,
            known: Vec::new(),
        }
    }

    fn to(&mut self, questions: &[Spec]) -> Result<&[Result<Ending, String>], GraderError> {
        let works = || questions.iter().map(|spec| &spec.work);
        let known = self
            .known
            .iter()
            .position(|(asked, _)| asked.iter().eq(works()));
        let at = match known {
            Some(at) => at,
            None => {
                let asked: Vec<&Spec> = questions.iter().collect();
                let endings = self.workers.run(&asked, &mut Vec::new())?;
                self.known.push((works().cloned().collect(), endings));
                self.known.len() - 1
            }
        };
        Ok(&self.known[at].1)
    }
}

/// The first of `questions` that shows what is wrong in a failed case, whose questions are `spec`.
fn of_questions(
    answers: &mut Answers<'_>,
    case: &CaseResult,
    spec: &Spec,
    questions: &[Spec],
) -> Result<Option<SimplestCall>, GraderError> {
    if questions.is_empty() {
        return Ok(None);
    }
    let choice = answers.choice;
    let endings = answers.to(questions)?;
    if case.crash().is_some() {
        let asked = questions.iter().zip(endings);
        let mut crashed = asked.filter_map(|(spec, ending)| crash(case, spec, ending));
        return Ok(crashed.next());
    }
    Ok(alike(
        case,
        spec,
        &answered(case, questions, endings, choice),
    ))
}

/// A question with its answer, and what is wrong with it.
struct Asked<'a> {
    spec: &'a Spec,
    answer: &'a Answer,
    findings: Vec<Finding>,
    wrong: Vec<WrongAnswer>,
}

/// The questions that the code answers, judged as the answers to a failed `case`: simple questions
/// need no more than textbook code, extra credit does.
fn answered<'a>(
    case: &CaseResult,
    questions: &'a [Spec],
    endings: &'a [Result<Ending, String>],
    choice: &Choice<'_>,
) -> Vec<Asked<'a>> {
    let asked = questions.iter().zip(endings);
    let answered = asked.filter_map(|(spec, ending)| {
        let Ok(Ending::Recorded(record)) = ending else {
            return None;
        };
        let Outcome::Answered(answer) = &record.outcome else {
            return None;
        };
        let holes: Vec<String> = record
            .holes
            .iter()
            .map(|hole| hole.called.clone())
            .collect();
        let (findings, wrong) = judge::judge_each(spec, case.tier, answer, &holes);
        Some(Asked {
            spec,
            answer,
            findings: choice(findings),
            wrong,
        })
    });
    answered.collect()
}

/// The first wrong call that is wrong in the way of the failed case, whose questions are `spec`.
/// One under circumstances of the case comes first: no ray from behind shows what is wrong in
/// front.
fn alike(case: &CaseResult, spec: &Spec, answered: &[Asked<'_>]) -> Option<SimplestCall> {
    let of_calls = (0..spec.calls()).filter_map(|call| spec.circumstances(call));
    let of_case: BTreeSet<&str> = of_calls.flatten().collect();
    let fits = |asked: &Asked<'_>, fault: &Fault| {
        let of_call = asked.spec.circumstances(fault.call as usize);
        let mut here = of_call.into_iter().flatten();
        here.all(|circumstance| of_case.contains(circumstance))
    };
    let ways = [true, false]
        .map(|must_fit| [Likeness::Same, Likeness::Kind].map(|likeness| (must_fit, likeness)));
    let wrong = case.findings.iter().filter(|finding| finding.wrong > 0);
    for target in wrong {
        for (must_fit, likeness) in ways.into_iter().flatten() {
            for asked in answered {
                let is_accepted = |fault: &Fault| !must_fit || fits(asked, fault);
                let first = first_like(target, &asked.findings, likeness, is_accepted);
                let Some(fault) = first else {
                    continue;
                };
                let is_told =
                    |wrong: &&WrongAnswer| wrong.aspect == target.aspect && wrong.fault == *fault;
                let Some(told) = asked.wrong.iter().find(is_told) else {
                    continue;
                };
                let number = fault.call as usize;
                return Some(SimplestCall {
                    aspect: Some(target.aspect),
                    function: fault.named_function(),
                    result: told.message.clone(),
                    shown: match asked.spec.shown(case.tier, number, Some(asked.answer)) {
                        // Another function, whose answers are drawn, may have found a hit.
                        Some(ShownCall::Ray(shown)) if fault.class == Class::FalseMiss => {
                            Some(ShownCall::Ray(shown.without_yours()))
                        }
                        shown => shown,
                    },
                    wrong_where: wrong_where(answered),
                    ..call(case, asked.spec, fault.call)
                });
            }
        }
    }
    None
}

/// The circumstances of all wrong calls, each combination once.
fn wrong_where(answered: &[Asked<'_>]) -> Vec<Vec<&'static str>> {
    let wrong = answered.iter().flat_map(|asked| {
        let findings = asked.findings.iter();
        let of_calls = findings.filter(|finding| !finding.aspect.is_of_all_calls());
        let faults = of_calls.flat_map(|finding| &finding.faults);
        faults.filter_map(|fault| asked.spec.circumstances(fault.call as usize))
    });
    let each: BTreeSet<Vec<&str>> = wrong.collect();
    each.into_iter().collect()
}

/// The wrong answers to the simple questions of the cases `specs`, as sentences. Correct code has
/// none.
pub fn wrong_answers(workers: &StageWorkers, specs: &[&Spec]) -> Result<Vec<String>, GraderError> {
    let mut answers = Answers::of(workers, &|findings| findings);
    let mut sentences: Vec<String> = Vec::new();
    for spec in specs {
        let mut simple = spec.simple();
        for spec in &mut simple {
            // All aspects, whatever the case is about.
            spec.about_aspects = &[];
        }
        for (spec, ending) in simple.iter().zip(answers.to(&simple)?) {
            for sentence in wrong(spec, ending) {
                // Most cases of one kind of work judge alike.
                if !sentences.contains(&sentence) {
                    sentences.push(sentence);
                }
            }
        }
    }
    Ok(sentences)
}

/// What is wrong with the answer to a simple question, as sentences.
fn wrong(spec: &Spec, ending: &Result<Ending, String>) -> Vec<String> {
    let outcome = ending.as_ref().ok().and_then(Ending::outcome);
    let Some(Outcome::Answered(answer)) = outcome else {
        return vec![format!("{}: no answer", spec.work.kind())];
    };
    let (_, wrong) = judge::judge_each(spec, Tier::Core, answer, &[]);
    let sentences = wrong.into_iter().map(|wrong| {
        let input = spec.input(wrong.fault.call as usize).unwrap_or_default();
        format!("{input}: {}: {}", wrong.aspect.label(), wrong.message)
    });
    sentences.collect()
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
    is_accepted: impl Fn(&Fault) -> bool,
) -> Option<&'a Fault> {
    let finding = findings
        .iter()
        .find(|finding| finding.aspect == target.aspect)?;
    let kind = std::mem::discriminant::<Class>;
    let mut accepted = finding.faults.iter().filter(|fault| is_accepted(fault));
    accepted.find(|fault| {
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
    let crash = Crash::of(ending.as_ref().ok()?)?;
    Some(SimplestCall {
        aspect: None,
        result: format!("your code {}", crash.how).into(),
        ..call(case, spec, crash.call?)
    })
}

/// The call number `call` of a simple question, without what is wrong.
fn call(case: &CaseResult, spec: &Spec, call: u32) -> SimplestCall {
    SimplestCall {
        case: case.name.clone(),
        aspect: None,
        function: None,
        input: spec.input(call as usize).unwrap_or_default(),
        result: Message::default(),
        test: repro::of_work(
            &spec.work,
            case.tier,
            call as usize,
            "On this call the code was wrong as in a failed case of the grader.",
            "simple_call",
        ),
        only: None,
        wrong_where: spec.circumstances(call as usize).into_iter().collect(),
        shown: None,
    }
}
