//! One call in words and shown.

use super::arguments::{Argument, arguments};
use super::judge::function;
use super::truth::{Right, right};
use crate::tools::Tier;
use crate::tools::call_text::{direction, holding, is_coloured, point};
use crate::tools::shown::{ShownBounce, ShownCall};
use wire::global::{SpecularAnswer, SpecularCall};
use wire::work::Xyz;

pub(super) fn input(calls: &[SpecularCall], call: usize) -> Option<String> {
    let call = calls.get(call)?;
    let arguments = arguments(call).into_iter().map(|(name, value)| {
        let value = match value {
            Argument::Number(x) => format!("{x:?}"),
            Argument::Direction(unit) => direction(unit),
            Argument::Colour(colour) => point(colour),
        };
        format!("{name} = {value}")
    });
    let arguments: Vec<String> = arguments.collect();
    Some(format!("{}: {}", function(call), arguments.join(", ")))
}

pub(super) fn circumstances(calls: &[SpecularCall], call: usize) -> Option<Vec<&'static str>> {
    calls.get(call).map(of_specular)
}

fn of_specular(call: &SpecularCall) -> Vec<&'static str> {
    let from_inside = |wo: &Xyz| {
        holding(&[
            (wo[2] < 0.0, "wo is on the inside"),
            (wo[2] > 0.0, "wo is on the outside"),
            (wo[2].abs() < 1.0, "wo is not along the normal"),
        ])
    };
    match call {
        SpecularCall::Fresnel { cos_i, eta } => holding(&[
            (*cos_i < 0.0, "cos_i is negative"),
            (*cos_i > 0.0, "cos_i is positive"),
            (*eta > 1.0, "light comes from the denser side"),
            (*eta < 1.0, "light comes from the thinner side"),
        ]),
        SpecularCall::Reflect { wo } | SpecularCall::Refract { wo, .. } => from_inside(wo),
        SpecularCall::Mirror { reflectance, wo } => [
            from_inside(wo),
            holding(&[(is_coloured(*reflectance), "the reflectance is coloured")]),
        ]
        .concat(),
        SpecularCall::Refraction { wo, .. } | SpecularCall::Glass { wo, .. } => from_inside(wo),
    }
}

/// The direction that was returned beside the right one; `None` for a call that returns none.
pub(super) fn shown(tier: Tier, call: &SpecularCall, answer: &SpecularAnswer) -> Option<ShownCall> {
    let (SpecularCall::Reflect { wo }
    | SpecularCall::Refract { wo, .. }
    | SpecularCall::Mirror { wo, .. }
    | SpecularCall::Refraction { wo, .. }
    | SpecularCall::Glass { wo, .. }) = call
    else {
        return None;
    };
    Some(ShownCall::Bounce(ShownBounce {
        wo: *wo,
        expected: match right(tier, call).0 {
            Right::Share(_) => None,
            Right::Direction(wi) => wi,
            Right::Sample(sample) => sample.map(|sample| sample.wi),
        },
        yours: match answer {
            SpecularAnswer::Share(_) => None,
            SpecularAnswer::Direction(wi) => *wi,
            SpecularAnswer::Sample(sample) => sample.map(|sample| sample.wi),
        },
    }))
}
