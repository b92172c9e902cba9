//! Writes results for diffuse surfaces to a snapshot.

use crate::tools::snapshot::lines::sample;
use crate::tools::snapshot::{Forms, field, forms, number, vector};
use wire::direct::{LambertAnswer, LambertProbe};

/// Value, density and the sampled direction; full lines have all fields of the sample.
pub(super) fn lambert(probe: &LambertProbe, answer: &LambertAnswer) -> Forms {
    let question = vec![
        field("reflectance", vector(&probe.reflectance)),
        field("wo", vector(&probe.wo)),
        field("wi", vector(&probe.wi)),
        field("u", vector(&probe.u)),
    ];
    let mut short = vec![field("f", vector(&answer.f)), number("pdf", answer.pdf)];
    let mut full = short.clone();
    if let Some(drawn) = &answer.sample {
        short.push(field("drawn", vector(&drawn.wi)));
        full.extend(sample("drawn", drawn));
    }
    forms(question, short, full)
}
