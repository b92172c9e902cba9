//! Rust tests of mirrors and glass.

use super::arguments::{Argument, arguments};
use super::judge;
use super::truth::{self, Right};
use crate::tools::Tier;
use crate::tools::repro::numbers::{float, same_colour, spectrum, vec3};
use wire::global::SpecularCall;

/// A test of one call.
pub(crate) fn smooth(tier: Tier, input: &SpecularCall) -> String {
    let (right, bound) = truth::right(tier, input);
    let arguments = arguments(input).into_iter().map(|(_, value)| match value {
        Argument::Number(x) => float(x),
        Argument::Direction(unit) => vec3(unit),
        Argument::Colour(colour) => spectrum(colour),
    });
    let arguments: Vec<String> = arguments.collect();
    let call = format!(
        "global::{}({})",
        judge::function(input),
        arguments.join(", ")
    );
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
