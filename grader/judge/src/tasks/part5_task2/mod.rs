//! `part5.task2`: a stopping rule that waits until the plain rule is reliable.

pub(crate) mod cases;
mod judge;
mod repro;
mod simple;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::kinds::stopping;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use crate::tools::tally::{Aspect, Tally};
use wire::adaptive::{StopAnswer, StopCall};
use wire::kind;

impl Check for kind::SureStop {
    const MAIN: &'static [Aspect] = &[Aspect::Stop];

    fn calls(questions: &Vec<StopCall>) -> usize {
        questions.len()
    }

    fn only_call(calls: &Vec<StopCall>, call: usize) -> Option<Vec<StopCall>> {
        Some(vec![calls.get(call)?.clone()])
    }

    fn fits(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Result<(), String> {
        one_each(Self::calls(questions), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::sure_stop(tally, questions, answers);
    }

    fn judge_rest(
        tally: &mut Tally,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::untested(tally, questions, answers);
    }

    fn lines(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, stopping::line)))
    }

    fn repro(_: Tier, questions: &Vec<StopCall>, call: usize) -> Option<String> {
        repro::waiting_rule(questions.get(call)?)
    }

    fn simple(_: &Vec<StopCall>) -> Vec<Vec<StopCall>> {
        simple::questions()
    }
}
