//! One call in words and shown.

use crate::tools::call_text::{direction, holding, is_coloured, point};
use wire::direct::LambertProbe;

pub(super) fn input(probes: &[LambertProbe], call: usize) -> Option<String> {
    let probe = probes.get(call)?;
    let [wo, wi] = [probe.wo, probe.wi].map(direction);
    let reflectance = point(probe.reflectance);
    Some(format!(
        "reflectance = {reflectance}, wo = {wo}; `lambert_sample` gets u = {:?}, the others wi = {wi}",
        probe.u
    ))
}

pub(super) fn circumstances(probes: &[LambertProbe], call: usize) -> Option<Vec<&'static str>> {
    probes.get(call).map(of_lambert)
}

fn of_lambert(probe: &LambertProbe) -> Vec<&'static str> {
    let (wo, wi) = (probe.wo[2], probe.wi[2]);
    holding(&[
        (wo < 0.0, "wo is below the surface"),
        (wo > 0.0, "wo is above the surface"),
        (wi < 0.0, "wi is below the surface"),
        (wo * wi < 0.0, "wo and wi are on different sides"),
        (wo * wi > 0.0, "wo and wi are on the same side"),
        (
            is_coloured(probe.reflectance),
            "the reflectance is coloured",
        ),
    ])
}
