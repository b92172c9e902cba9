//! Writes results for mirrors and glass to a snapshot.

use crate::tools::snapshot::lines::sample;
use crate::tools::snapshot::{Forms, field, forms, number, vector};
use wire::global::{SpecularAnswer, SpecularCall};
use wire::work::Xyz;

/// A reflectance, a direction or a sample.
pub(super) fn specular(call: &SpecularCall, answer: &SpecularAnswer) -> Forms {
    let wo = |wo: Xyz| field("wo", vector(&wo));
    let question = match *call {
        SpecularCall::Fresnel { cos_i, eta } => vec![number("cos", cos_i), number("eta", eta)],
        SpecularCall::Reflect { wo: w } | SpecularCall::Mirror { wo: w, .. } => vec![wo(w)],
        SpecularCall::Refract { wo: w, ior } | SpecularCall::Refraction { wo: w, ior, .. } => {
            vec![wo(w), number("ior", ior)]
        }
        SpecularCall::Glass {
            wo: w, ior, choice, ..
        } => vec![wo(w), number("ior", ior), number("choice", choice)],
    };
    let answer = match answer {
        SpecularAnswer::Share(share) => vec![number("share", *share)],
        SpecularAnswer::Direction(wi) => {
            let wi = wi.iter().map(|wi| field("wi", vector(wi)));
            wi.collect()
        }
        SpecularAnswer::Sample(drawn) => {
            let drawn = drawn.iter().flat_map(|drawn| sample("wi", drawn));
            drawn.collect()
        }
    };
    forms(question, answer.clone(), answer)
}
