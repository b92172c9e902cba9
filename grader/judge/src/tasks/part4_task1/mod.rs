//! `part4.task1`: mirrors and glass.

mod arguments;
mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod lines;
mod moves;
mod repro;
mod simple;
mod truth;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use wire::global::{SpecularAnswer, SpecularCall};
use wire::kind;

/// The right result of a call of `fresnel_dielectric`; `None` of another function.
pub fn right_reflectance(call: &SpecularCall) -> Option<f64> {
    let SpecularCall::Fresnel { .. } = call else {
        return None;
    };
    match truth::result(call).0 {
        truth::Right::Share(share) => Some(share),
        _ => None,
    }
}

impl Check for kind::Specular {
    const MAIN: &'static [Aspect] = &[Aspect::Fresnel, Aspect::SampledDirection];

    fn calls(calls: &Vec<SpecularCall>) -> usize {
        calls.len()
    }

    fn only_call(calls: &Vec<SpecularCall>, call: usize) -> Option<Vec<SpecularCall>> {
        Some(vec![*calls.get(call)?])
    }

    fn fits(calls: &Vec<SpecularCall>, answers: &Vec<SpecularAnswer>) -> Result<(), String> {
        one_each(Self::calls(calls), answers)?;
        let mut pairs = calls.iter().zip(answers);
        match pairs.position(|(call, answer)| !judge::is_answer_to(call, answer)) {
            Some(call) => Err(format!(
                "call {call} is of {}, which does not return {:?}",
                judge::function(&calls[call]),
                answers[call]
            )),
            None => Ok(()),
        }
    }

    fn look_up_truth(calls: &Vec<SpecularCall>) {
        for call in calls {
            truth::result(call);
            if let SpecularCall::Glass { wo, ior, .. } = *call {
                truth::reflected_share(wo, ior);
            }
        }
    }

    const NOT_MOVED: &'static str = "a Fresnel reflectance is no multiple of anything";

    /// The Fresnel reflectance alone has none: it is no multiple of anything.
    fn symmetries(calls: &Vec<SpecularCall>) -> Symmetries {
        moves::symmetries(calls)
    }

    fn moved(calls: &Vec<SpecularCall>, by: &Move) -> Vec<SpecularCall> {
        calls.iter().map(|call| moves::call(*call, by)).collect()
    }

    fn moved_back(answers: &Vec<SpecularAnswer>, back: &Move) -> Vec<SpecularAnswer> {
        let each = answers.iter();
        each.map(|answer| moves::answer(*answer, back)).collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        tier: Tier,
        calls: &Vec<SpecularCall>,
        answers: &Vec<SpecularAnswer>,
    ) {
        judge::specular(findings, tier, calls, answers);
    }

    fn lines(calls: &Vec<SpecularCall>, answers: &Vec<SpecularAnswer>) -> Option<Content> {
        Some((Vec::new(), each(calls, answers, lines::specular)))
    }

    fn input(work: &Vec<SpecularCall>, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &Vec<SpecularCall>, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn shown(
        calls: &Vec<SpecularCall>,
        tier: Tier,
        _: bool,
        call: usize,
        answers: Option<&Vec<SpecularAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(tier, calls.get(call)?, answers?.get(call)?)
    }

    fn repro(tier: Tier, calls: &Vec<SpecularCall>, call: usize) -> Option<String> {
        Some(repro::smooth(tier, calls.get(call)?))
    }

    /// The test makes one call, which shows nothing about statistics of many.
    fn repro_shows(aspect: Aspect) -> bool {
        !matches!(aspect, Aspect::Spread | Aspect::Mean)
    }

    fn simple(_: &Vec<SpecularCall>) -> Vec<Vec<SpecularCall>> {
        simple::questions()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_of_another_function_does_not_fit() {
        let calls = vec![SpecularCall::Reflect {
            wo: [0.0, 0.0, 1.0],
        }];
        let fits = |answer| kind::Specular::fits(&calls, &vec![answer]);
        assert_eq!(fits(SpecularAnswer::Direction(None)), Ok(()));
        let why = "call 0 is of reflect, which does not return Share(0.5)";
        assert_eq!(fits(SpecularAnswer::Share(0.5)), Err(why.into()));
    }
}
