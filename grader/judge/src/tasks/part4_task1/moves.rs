//! Moves of calls at mirrors and glass: directions around the normal, factors of the tints.

use crate::tools::moves::{AxisMoves, LightMoves, Move, Symmetries};
use wire::global::{SpecularAnswer, SpecularCall};
use wire::light::BsdfSample;

/// The exact symmetries of `calls`.
pub(super) fn symmetries(calls: &[SpecularCall]) -> Symmetries {
    let has_direction = |call: &SpecularCall| !matches!(call, SpecularCall::Fresnel { .. });
    match calls.iter().any(has_direction) {
        // No tint is above 1.
        true => Symmetries {
            axes: AxisMoves::AroundZ,
            light: match calls.iter().any(has_tint) {
                true => LightMoves::EachChannel(1.0),
                false => LightMoves::Fixed,
            },
            ..Symmetries::default()
        },
        false => Symmetries::default(),
    }
}

fn has_tint(call: &SpecularCall) -> bool {
    match call {
        SpecularCall::Fresnel { .. }
        | SpecularCall::Reflect { .. }
        | SpecularCall::Refract { .. } => false,
        SpecularCall::Mirror { .. }
        | SpecularCall::Refraction { .. }
        | SpecularCall::Glass { .. } => true,
    }
}

/// A call, moved.
pub(super) fn call(mut call: SpecularCall, by: &Move) -> SpecularCall {
    match &mut call {
        SpecularCall::Fresnel { .. } => {}
        SpecularCall::Reflect { wo } | SpecularCall::Refract { wo, .. } => *wo = by.unit(*wo),
        SpecularCall::Mirror {
            reflectance: tint,
            wo,
        }
        | SpecularCall::Refraction {
            transmittance: tint,
            wo,
            ..
        } => {
            *tint = by.light(*tint);
            *wo = by.unit(*wo);
        }
        SpecularCall::Glass {
            reflectance,
            transmittance,
            wo,
            ..
        } => {
            *reflectance = by.light(*reflectance);
            *transmittance = by.light(*transmittance);
            *wo = by.unit(*wo);
        }
    }
    call
}

/// An answer, moved back.
pub(super) fn answer(answer: SpecularAnswer, back: &Move) -> SpecularAnswer {
    match answer {
        SpecularAnswer::Share(share) => SpecularAnswer::Share(share),
        SpecularAnswer::Direction(d) => SpecularAnswer::Direction(d.map(|d| back.unit(d))),
        SpecularAnswer::Sample(sample) => SpecularAnswer::Sample(sample.map(|sample| BsdfSample {
            wi: back.unit(sample.wi),
            f: back.light(sample.f),
            ..sample
        })),
    }
}
