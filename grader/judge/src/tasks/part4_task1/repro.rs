//! Rust tests of mirrors and glass.

use super::judge;
use super::truth::{self, Right};
use crate::tools::Tier;
use crate::tools::repro::numbers::{float, same_colour, spectrum, vec3};
use wire::global::SpecularCall;

/// A test of one call.
pub(crate) fn smooth(tier: Tier, input: &SpecularCall) -> String {
    let (right, bound) = truth::right(tier, input);
    let arguments = match *input {
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
    let call = format!("global::{}({arguments})", judge::function(input));
    let near = |what: &str, right: String| {
        format!("assert!(({what} - {right}).length() <= {bound:?}, \"{{}}\", {what});\n")
    };
    match right {
        Right::Share(share) => format!(
            "let share = {call};\nassert!((share - {}).abs() <= {bound:?}, \"{{share}}\");\n",
            float(share)
        ),
        Right::Direction(None) => {
            format!("use kit::Vec3;\nassert_eq!({call}, None);\n")
        }
        Right::Direction(Some(wi)) => {
            let found = match input {
                SpecularCall::Reflect { .. } => "",
                _ => ".expect(\"there is a direction\")",
            };
            format!("use kit::Vec3;\nlet wi = {call}{found};\n") + &near("wi", vec3(wi))
        }
        Right::Sample(None) => {
            format!("use kit::{{Spectrum, Vec3}};\nassert_eq!({call}, None);\n")
        }
        Right::Sample(Some(sample)) => {
            let share = sample.wi[2].abs() / sample.pdf;
            let weight = sample.f.map(|f| f * share);
            let weight_bound = judge::weight_bound(bound, sample.pdf);
            format!(
                "use kit::{{Spectrum, Vec3}};
let sample = {call}.expect(\"there is a sample\");
{}assert!((sample.pdf - {}).abs() <= {bound:?}, \"pdf = {{}}\", sample.pdf);
assert!(sample.delta);
// The weight of the sample: f · |cos θ| / pdf.
let weight = sample.weight();
{}
",
                near("sample.wi", vec3(sample.wi)),
                float(sample.pdf),
                same_colour("weight", weight, weight_bound)
            )
        }
    }
}
