//! `part5.task2`: a stopping rule that waits until the plain rule is reliable.

mod call;
pub(crate) mod cases;
mod judge;
mod repro;
mod simple;
mod truth;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::kinds::stopping;
use crate::tools::moves::{Move, Symmetries};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
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

    fn look_up_truth(questions: &Vec<StopCall>) {
        for call in questions {
            truth::plain_decides(call);
        }
    }

    const NOT_MOVED: &'static str = stopping::NOT_MOVED;

    fn symmetries(questions: &Vec<StopCall>) -> Symmetries {
        stopping::symmetries(questions)
    }

    fn moved(questions: &Vec<StopCall>, by: &Move) -> Vec<StopCall> {
        stopping::moved(questions, by)
    }

    fn moved_back(answers: &Vec<StopAnswer>, back: &Move) -> Vec<StopAnswer> {
        stopping::moved_back(answers, back)
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::sure_stop(findings, questions, answers);
    }

    fn judge_rest(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::untested(findings, questions, answers);
    }

    fn lines(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, stopping::line)))
    }

    fn input(work: &Vec<StopCall>, call: usize) -> Option<String> {
        work.get(call).map(call::input)
    }

    fn repro(_: Tier, questions: &Vec<StopCall>, call: usize) -> Option<String> {
        repro::waiting_rule(questions.get(call)?)
    }

    fn simple(_: &Vec<StopCall>) -> Vec<Vec<StopCall>> {
        simple::questions()
    }
}
