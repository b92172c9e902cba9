//! `part5.task2`: a stopping rule that waits until the plain rule is reliable.

pub(crate) mod cases;
mod judge;
mod repro;

use crate::Tier;
use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::snapshot::lines::each;
use crate::tally::{Aspect, Tally};
use crate::tasks::part5_task1::lines;
use wire::adaptive::{StopAnswer, StopCall};

/// `has_surely_converged`, called for each question.
pub(crate) struct SureStop;

impl Check for SureStop {
    type Question = Vec<StopCall>;
    type Answer = Vec<StopAnswer>;

    const MAIN: &'static [Aspect] = &[Aspect::Stop];

    fn calls(questions: &Vec<StopCall>) -> usize {
        questions.len()
    }

    fn fits(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Result<(), String> {
        one_each(Self::calls(questions), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::sure_stop(tally, questions, answers);
    }

    fn judge_rest(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::untested(tally, questions, answers);
    }

    fn lines(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, lines::stop)))
    }

    fn repro(_: Tier, questions: &Vec<StopCall>, call: usize) -> Option<String> {
        repro::waiting_rule(questions.get(call)?)
    }
}
