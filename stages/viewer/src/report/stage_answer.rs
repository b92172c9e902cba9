//! What the stages of this program answer to a case now.

use judge::cases::Spec;
use wire::{Answer, Outcome, Work};

/// The stages' answer to a case.
#[derive(Clone, Debug)]
pub struct StageAnswer {
    /// The answer, which fits the question.
    pub answer: Answer,
    /// Whether the task still has the start that the course provides.
    pub is_untouched: bool,
    /// The functions of the task that are not written yet: their answers mean nothing.
    pub not_written: Vec<String>,
}

/// Whether a case only measures times: its answer shows nothing but numbers.
pub fn is_timed(work: &Work) -> bool {
    matches!(
        work,
        Work::Timing(_) | Work::TimeTest(_) | Work::BuildGrowth(_)
    )
}

/// Runs the case with the stages that this program contains. The error is a sentence: what is not
/// written yet, or how the code ended.
pub fn answer_of(spec: &Spec) -> Result<StageAnswer, String> {
    let record = worker::run(0, &spec.case());
    let answer = match record.outcome {
        Outcome::Answered(answer) => answer,
        Outcome::NotAttempted { task } => return Err(format!("{task} is not written yet")),
        Outcome::Panicked {
            message,
            location,
            call,
        } => return Err(format!("Call {call} panicked at {location}: {message}")),
        Outcome::CalledTooOften {
            function,
            times,
            asked_for,
            call,
        } => {
            return Err(format!(
                "Call {call} called {function} {times} times, but was asked for {asked_for}"
            ));
        }
        Outcome::Unable { reason } => return Err(reason),
    };
    judge::fits(&spec.work, &answer)
        .map_err(|why| format!("The answer does not fit the case: {why}"))?;
    Ok(StageAnswer {
        answer,
        is_untouched: record.untouched.iter().any(|task| task == spec.task),
        not_written: record.holes.into_iter().map(|hole| hole.called).collect(),
    })
}
