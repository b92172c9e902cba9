//! Judges mirrors, refraction and glass.

use super::truth::{Right, reflected_share, right};
use crate::tools::Tier;
use crate::tools::aspects::chance::{self, MIN_ESTIMATES};
use crate::tools::aspects::hits::{TOO_WIDE, WIDE, show};
use crate::tools::aspects::numbers;
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::{Tally, Vec3};
use wire::global::{SpecularAnswer, SpecularCall};
use wire::light::BsdfSample;
use wire::work::Xyz;

/// Judges calls of all functions of the task.
pub(crate) fn specular(
    findings: &mut Findings,
    tier: Tier,
    calls: &[SpecularCall],
    answers: &[SpecularAnswer],
) {
    for (call, (input, answer)) in calls.iter().zip(answers).enumerate() {
        one(findings, tier, call, input, answer);
    }
    if calls.len() >= MIN_ESTIMATES && findings.is_written("glass_sample", &[Aspect::Mean]) {
        frequency(findings, calls, answers);
    }
}

/// The name of the function that is called.
pub(crate) fn function(input: &SpecularCall) -> &'static str {
    match input {
        SpecularCall::Fresnel { .. } => "fresnel_dielectric",
        SpecularCall::Reflect { .. } => "reflect",
        SpecularCall::Refract { .. } => "refract",
        SpecularCall::Mirror { .. } => "mirror_sample",
        SpecularCall::Refraction { .. } => "refraction_sample",
        SpecularCall::Glass { .. } => "glass_sample",
    }
}

/// Whether an answer has the type that the function of the call returns.
pub(crate) fn is_answer_to(input: &SpecularCall, answer: &SpecularAnswer) -> bool {
    matches!(
        (input, answer),
        (SpecularCall::Fresnel { .. }, SpecularAnswer::Share(_))
            | (
                SpecularCall::Reflect { .. } | SpecularCall::Refract { .. },
                SpecularAnswer::Direction(_)
            )
            | (
                SpecularCall::Mirror { .. }
                    | SpecularCall::Refraction { .. }
                    | SpecularCall::Glass { .. },
                SpecularAnswer::Sample(_)
            )
    )
}

/// The aspects of an answer.
fn aspects(answer: &SpecularAnswer) -> &'static [Aspect] {
    use Aspect::{Bsdf, Fresnel, Pdf, SampleOrNone, SampledDirection};
    match answer {
        SpecularAnswer::Share(_) => &[Fresnel],
        SpecularAnswer::Direction(_) => &[SampleOrNone, SampledDirection],
        SpecularAnswer::Sample(_) => &[SampleOrNone, SampledDirection, Pdf, Bsdf],
    }
}

fn one(
    findings: &mut Findings,
    tier: Tier,
    call: usize,
    input: &SpecularCall,
    answer: &SpecularAnswer,
) {
    if !findings.is_written(function(input), aspects(answer)) {
        return;
    }
    findings.answers_of(function(input));
    findings.count_for(function(input));
    let (_, bound) = right(tier, input);
    if bound > WIDE {
        let aspect = match answer {
            SpecularAnswer::Share(_) => Aspect::Fresnel,
            SpecularAnswer::Direction(_) => Aspect::SampledDirection,
            SpecularAnswer::Sample(_) => Aspect::Pdf,
        };
        findings.not_judged(aspect, call, TOO_WIDE);
    }
    match (right(tier, input), answer) {
        ((Right::Share(right), bound), SpecularAnswer::Share(share)) => {
            findings.expect(Aspect::Fresnel);
            let off = (share - right).abs();
            let class =
                (off.is_nan() || off > bound).then(|| Class::of_signed_number(*share, right));
            findings.judge_class(Aspect::Fresnel, call, class, off, || {
                Message::new(format!("your result: {share:?}; expected: {right:?}"))
                    .compares([*share], [right])
                    .asked(format!("{input:?}"))
            });
        }
        ((Right::Direction(right), bound), SpecularAnswer::Direction(wi)) => {
            optional_direction(findings, call, input, *wi, right.map(Vec3::from), bound);
        }
        ((Right::Sample(right), bound), SpecularAnswer::Sample(sample)) => {
            record(findings, call, input, sample.as_ref(), right, bound);
        }
        _ => debug_assert!(false, "`fits` accepted {answer:?} for {input:?}"),
    }
}

/// Judges a direction, which may be `None`.
fn optional_direction(
    findings: &mut Findings,
    call: usize,
    input: &SpecularCall,
    answered: Option<Xyz>,
    right: Option<Vec3>,
    bound: f64,
) {
    findings.expect(Aspect::SampleOrNone);
    let class = match (answered, right) {
        (Some(_), None) => Some(Class::FalseHit),
        (None, Some(_)) => Some(Class::FalseMiss),
        _ => None,
    };
    findings.judge_class(Aspect::SampleOrNone, call, class, 1.0, || {
        let right = right.map_or("no direction".into(), show);
        Message::new(format!("your result: {answered:?}; expected: {right}"))
            .asked(format!("{input:?}"))
    });
    if let Some(right) = right {
        findings.expect(Aspect::SampledDirection);
        if let Some(answered) = answered {
            let aspect = Aspect::SampledDirection;
            numbers::direction(findings, aspect, call, answered, right, bound, || {
                format!("{input:?}")
            });
        }
    }
}

/// Judges a sample, which may be `None`: its direction, its probability and its weight.
fn record(
    findings: &mut Findings,
    call: usize,
    input: &SpecularCall,
    answered: Option<&BsdfSample>,
    right: Option<BsdfSample>,
    bound: f64,
) {
    let direction = |sample: &BsdfSample| Vec3::from(sample.wi);
    let wi = answered.map(|sample| sample.wi);
    optional_direction(
        findings,
        call,
        input,
        wi,
        right.as_ref().map(direction),
        bound,
    );
    let Some(right) = right else { return };
    findings.expect(Aspect::Pdf);
    findings.expect(Aspect::Bsdf);
    let Some(answered) = answered else { return };
    let off = (answered.pdf - right.pdf).abs();
    let class =
        (off.is_nan() || off > bound).then(|| Class::of_signed_number(answered.pdf, right.pdf));
    let class = class.or((!answered.delta).then_some(Class::Wrong));
    findings.judge_class(Aspect::Pdf, call, class, off, || {
        Message::new(format!(
            "your result: pdf = {:?}, delta = {}; expected: pdf = {:?}, delta = true",
            answered.pdf, answered.delta, right.pdf
        ))
        .compares([answered.pdf], [right.pdf])
        .asked(format!("{input:?}"))
    });
    // The weight f · |cos θ| / pdf, by which a path multiplies its throughput.
    let arrives = |sample: &BsdfSample| sample.f.map(|f| f * sample.wi[2].abs() / sample.pdf);
    let (right, bound) = (arrives(&right), weight_bound(bound, right.pdf));
    numbers::colour(
        findings,
        Aspect::Bsdf,
        call,
        arrives(answered),
        right,
        bound,
        || format!("f · |cos| / pdf of {input:?}, f = {:?}", answered.f),
    );
}

/// Relative error allowed in the weight of a sample whose other numbers may be off by `bound`.
pub(crate) fn weight_bound(bound: f64, pdf: f64) -> f64 {
    bound / pdf.max(1e-3)
}

/// Tests how often glass reflects, over many choices for the same direction.
fn frequency(findings: &mut Findings, calls: &[SpecularCall], answers: &[SpecularAnswer]) {
    let Some(&SpecularCall::Glass { ior, wo, .. }) = calls.first() else {
        return;
    };
    let reflected: Tally = answers
        .iter()
        .map(|answer| match answer {
            SpecularAnswer::Sample(Some(sample)) if sample.wi[2] * wo[2] > 0.0 => 1.0,
            _ => 0.0,
        })
        .collect();
    let share = reflected_share(wo, ior);
    chance::mean(findings, "choices to reflect", &reflected, share);
}
