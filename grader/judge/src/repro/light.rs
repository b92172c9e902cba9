//! Tests of functions about light: matte surfaces, mirrors and glass, roulette.

use super::numbers::{float, spectrum, vec3};
use crate::Tier;
use crate::{lambert, roulette, specular};
use std::fmt::Write;
use wire::direct::LambertProbe;
use wire::global::{RouletteWork, SpecularCall};
use wire::work::Xyz;

/// Value, density, and what a sample says of itself. Not how many samples are distributed.
pub(super) fn matte(probe: &LambertProbe) -> String {
    let (f, pdf) = lambert::right(probe);
    let bound = lambert::BOUND;
    let mut text = format!(
        "use kit::{{Spectrum, Vec2, Vec3}};
use std::f64::consts::PI;
let reflectance = {};
let (wo, wi) = ({}, {});
let f = direct::lambert_f(reflectance, wo, wi);
{}
let pdf = direct::lambert_pdf(wo, wi);
assert!((pdf - {pdf}).abs() <= {}, \"pdf = {{pdf}}\");
let sample = direct::lambert_sample(reflectance, wo, Vec2::new({}, {}));
",
        spectrum(probe.reflectance),
        vec3(probe.wo),
        vec3(probe.wi),
        same_colour("f", f, bound),
        float(bound * pdf),
        float(probe.u[0]),
        float(probe.u[1]),
        pdf = float(pdf),
    );
    if probe.wo[2] == 0.0 {
        text.push_str("assert_eq!(sample, None);\n");
        return text;
    }
    let f = same_colour(
        "f",
        probe.reflectance.map(|rho| rho / std::f64::consts::PI),
        bound,
    );
    let _ = write!(
        text,
        "let sample = sample.expect(\"something leaves\");
assert!((sample.wi.length() - 1.0).abs() <= {bound:?}, \"{{}} is not unit\", sample.wi);
assert!(sample.wi.z * wo.z > 0.0, \"{{}} is not on the side of wo\", sample.wi);
let f = sample.f;
{f}
let pdf = sample.wi.z.abs() / PI;
assert!(sample.pdf > 0.0 && (sample.pdf - pdf).abs() <= {bound:?} * pdf + 1e-15, \"pdf = {{}}\", sample.pdf);
assert!(!sample.delta);
",
    );
    text
}

/// One call of one of the functions of mirrors and glass.
pub(super) fn smooth(tier: Tier, asked: &SpecularCall) -> String {
    let (right, bound) = specular::right(tier, asked);
    let arguments = match *asked {
        SpecularCall::Fresnel { cos_i, eta } => format!("{}, {}", float(cos_i), float(eta)),
        SpecularCall::Reflect { wo } => vec3(wo),
        SpecularCall::Refract { wo, ior } => format!("{}, {}", vec3(wo), float(ior)),
        SpecularCall::Mirror { reflectance, wo } => {
            format!("{}, {}", spectrum(reflectance), vec3(wo))
        }
        SpecularCall::Refraction {
            transmittance,
            ior,
            wo,
        } => format!("{}, {}, {}", spectrum(transmittance), float(ior), vec3(wo)),
        SpecularCall::Glass {
            reflectance,
            transmittance,
            ior,
            wo,
            choice,
        } => format!(
            "{}, {}, {}, {}, {}",
            spectrum(reflectance),
            spectrum(transmittance),
            float(ior),
            vec3(wo),
            float(choice)
        ),
    };
    let call = format!("global::{}({arguments})", specular::function(asked));
    let near = |what: &str, right: String| {
        format!("assert!(({what} - {right}).length() <= {bound:?}, \"{{}}\", {what});\n")
    };
    match right {
        specular::Right::Share(share) => format!(
            "let share = {call};\nassert!((share - {}).abs() <= {bound:?}, \"{{share}}\");\n",
            float(share)
        ),
        specular::Right::Direction(None) => {
            format!("use kit::Vec3;\nassert_eq!({call}, None);\n")
        }
        specular::Right::Direction(Some(wi)) => {
            let found = match asked {
                SpecularCall::Reflect { .. } => "",
                _ => ".expect(\"there is a direction\")",
            };
            format!("use kit::Vec3;\nlet wi = {call}{found};\n") + &near("wi", vec3(wi.into()))
        }
        specular::Right::Sample(None) => {
            format!("use kit::{{Spectrum, Vec3}};\nassert_eq!({call}, None);\n")
        }
        specular::Right::Sample(Some(sample)) => {
            let share = sample.wi[2].abs() / sample.pdf;
            let arrives = sample.f.map(|f| f * share);
            let weight_bound = specular::weight_bound(bound, sample.pdf);
            format!(
                "use kit::{{Spectrum, Vec3}};
let sample = {call}.expect(\"there is a sample\");
{}assert!((sample.pdf - {}).abs() <= {bound:?}, \"pdf = {{}}\", sample.pdf);
assert!(sample.delta);
// The light that arrives by it: f · |cos θ| / pdf.
let arrives = sample.weight();
{}
",
                near("sample.wi", vec3(sample.wi)),
                float(sample.pdf),
                same_colour("arrives", arrives, weight_bound)
            )
        }
    }
}

/// One game.
pub(super) fn game(work: &RouletteWork, call: usize) -> Option<String> {
    let &(throughput, bounces) = work.paths.get(call / work.numbers.len().max(1))?;
    let u = *work.numbers.get(call % work.numbers.len().max(1))?;
    let call = format!(
        "global::play_roulette({}, {bounces}, {})",
        spectrum(throughput),
        float(u)
    );
    Some(match roulette::right(throughput, bounces, u) {
        None => format!("use kit::Spectrum;\nassert_eq!({call}, None);\n"),
        Some(right) => format!(
            "use kit::Spectrum;\nlet throughput = {call}.expect(\"the path goes on\");\n{}\n",
            same_colour("throughput", right, roulette::BOUND)
        ),
    })
}

/// Each channel within `bound`, a share of the largest right one.
fn same_colour(what: &str, right: Xyz, bound: f64) -> String {
    let scale = right.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let [r, g, b] = right.map(float);
    format!(
        "let off = [{what}.r - {r}, {what}.g - {g}, {what}.b - {b}];
assert!(off.iter().all(|off| off.abs() <= {}), \"{{{what}:?}}\");",
        float(bound * scale)
    )
}
