//! Stopping rules: what the plain rule of `part5.task1` and the waiting rule of `part5.task2`
//! share.

use crate::plural;
use crate::tools::call_text::few;
use crate::tools::findings::{Aspect, Class, Findings};
use crate::tools::moves::{LightMoves, Move, Symmetries};
use crate::tools::repro::numbers::float;
use crate::tools::snapshot::{Fields, Forms, field, forms, number, vector};
use kit::Tally;
use std::fmt::Write;
use wire::adaptive::{StopAnswer, StopCall};

/// A question with these samples, and what the plain rule returns.
pub(crate) fn call(runs: Vec<(u32, f64)>, rule: bool) -> StopCall {
    StopCall {
        runs,
        tolerance: 0.05,
        rule,
    }
}

/// The input of a call, as text.
pub(crate) fn input(call: &StopCall) -> String {
    let samples: u64 = call.runs.iter().map(|(count, _)| u64::from(*count)).sum();
    let runs = call
        .runs
        .iter()
        .map(|(count, luminance)| format!("{count} of {luminance:?}"));
    let runs = few(runs, ", ").filter(|runs| !runs.is_empty());
    let runs = runs.map_or_else(String::new, |runs| format!(" ({runs})"));
    format!("samples: {samples}{runs}, tolerance = {:?}", call.tolerance)
}

/// The samples of a question.
pub(crate) fn samples(call: &StopCall) -> Tally {
    let runs = call.runs.iter();
    runs.flat_map(|&(count, x)| std::iter::repeat_n(x, count as usize))
        .collect()
}

/// Why no question of a case is moved.
pub(crate) const NOT_MOVED: &str = "all samples are black";

/// The exact symmetries of questions: all luminances multiplied.
pub(crate) fn symmetries(calls: &[StopCall]) -> Symmetries {
    let runs = calls.iter().flat_map(|call| &call.runs);
    Symmetries {
        light: LightMoves::of(runs.map(|(_, luminance)| *luminance)),
        ..Symmetries::default()
    }
}

/// Questions, moved.
pub(crate) fn moved(calls: &[StopCall], by: &Move) -> Vec<StopCall> {
    let of_one = |call: &StopCall| {
        let runs = call.runs.iter();
        StopCall {
            runs: runs.map(|&(count, x)| (count, by.luminance(x))).collect(),
            ..*call
        }
    };
    calls.iter().map(of_one).collect()
}

/// Answers, moved back.
pub(crate) fn moved_back(answers: &[StopAnswer], back: &Move) -> Vec<StopAnswer> {
    let of_one = |answer: &StopAnswer| {
        let calls = answer
            .rule_calls
            .iter()
            .map(|&(count, mean, tolerance)| (count, back.luminance(mean), tolerance));
        StopAnswer {
            stop: answer.stop,
            rule_calls: calls.collect(),
        }
    };
    answers.iter().map(of_one).collect()
}

/// Judges the result of a rule. `plain` ends the message: what the plain rule returns, if another
/// rule is judged.
pub(crate) fn verdict(
    findings: &mut Findings,
    i: usize,
    call: &StopCall,
    answer: &StopAnswer,
    right: bool,
    plain: &str,
) {
    findings.expect(Aspect::Stop);
    let class = match (answer.stop, right) {
        (true, false) => Some(Class::FalseHit),
        (false, true) => Some(Class::FalseMiss),
        _ => None,
    };
    findings.judge_class(Aspect::Stop, i, class, 1.0, || {
        let samples = samples(call);
        format!(
            "your result: {}; expected: {right}. {} with the mean {} and the standard error {}, tolerance {}{plain}",
            answer.stop,
            plural(samples.count(), "sample", "samples"),
            samples.mean(),
            samples.standard_error(),
            call.tolerance
        )
    });
}

/// The result of a stopping rule, and how often the waiting rule called the plain rule.
pub(crate) fn line(call: &StopCall, answer: &StopAnswer) -> Forms {
    let runs = call.runs.iter().take(4);
    let mut question: Fields = runs
        .map(|&(count, x)| field("run", vector(&[f64::from(count), x])))
        .collect();
    question.push(number("tolerance", call.tolerance));
    let answer = vec![
        number("stop", f64::from(u8::from(answer.stop))),
        number("asked", answer.rule_calls.len() as f64),
    ];
    forms(question, answer.clone(), answer)
}

/// The largest number of different samples in a readable test.
pub(crate) const MOST_SAMPLES: usize = 40;

/// Adds the lines that define `samples`; `None` if there are too many to read.
pub(crate) fn define_samples(text: &mut String, call: &StopCall) -> Option<()> {
    let runs: Vec<String> = call
        .runs
        .iter()
        .map(|(count, x)| format!("({count}, {})", float(*x)))
        .collect();
    let _ = writeln!(
        text,
        "let runs: [(usize, f64); {}] = [{}];
let samples: Tally = runs.iter().flat_map(|&(count, x)| std::iter::repeat_n(x, count)).collect();",
        runs.len(),
        runs.join(", ")
    );
    (runs.len() <= MOST_SAMPLES).then_some(())
}
