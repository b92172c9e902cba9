//! The right values, densities and weights of diffuse surfaces.

use crate::tools::packed_truth;
// BEGIN SOLUTION(part3.task1)
use std::f64::consts::{FRAC_1_PI, PI};
// END SOLUTION(part3.task1)
use wire::direct::LambertProbe;
use wire::work::Xyz;

/// The right f and density of a probe.
pub(super) fn right(probe: &LambertProbe) -> (Xyz, f64) {
    let input = (probe.wo, probe.wi);
    // BEGIN SOLUTION(part3.task1)
    let [wo, wi] = [probe.wo[2], probe.wi[2]];
    let is_lit = wo * wi > 0.0;
    packed_truth::record(
        "part3.task1",
        "share",
        &input,
        if is_lit { FRAC_1_PI } else { 0.0 },
    );
    match is_lit {
        true => (sampled_f(probe.reflectance), wi.abs() / PI),
        false => ([0.0; 3], 0.0),
    }
    // STUB: let share: f64 = packed_truth::find("part3.task1", "share", &input);
    // STUB: (probe.reflectance.map(|rho| rho * share), probe.wi[2].abs() * share)
    // END SOLUTION(part3.task1)
}

/// The right f of a sample.
pub(super) fn sampled_f(reflectance: Xyz) -> Xyz {
    // BEGIN SOLUTION(part3.task1)
    reflectance.map(|rho| rho / PI)
    // STUB: reflectance.map(density())
    // END SOLUTION(part3.task1)
}

/// The right density of sampled directions, by their cosine to the normal.
pub(super) fn density() -> impl Fn(f64) -> f64 {
    // BEGIN SOLUTION(part3.task1)
    packed_truth::record("part3.task1", "share of a sample", &(), FRAC_1_PI);
    |cosine| cosine / PI
    // STUB: let share: f64 = packed_truth::find("part3.task1", "share of a sample", &());
    // STUB: move |cosine| cosine * share
    // END SOLUTION(part3.task1)
}
