//! Judges mirrors, refraction and glass.

use crate::tools::Tier;
use crate::tools::aspects::chance::{self, MIN_ESTIMATES};
use crate::tools::aspects::hits::{TOO_WIDE, WIDE, show};
use crate::tools::aspects::numbers;
use crate::tools::tally::{Aspect, Class, Tally};
use kit::{Tally as SampleTally, Vec3};
use wire::global::{SpecularAnswer, SpecularCall};
use wire::light::BsdfSample;
use wire::work::Xyz;

/// The error that core points allow. Core probes avoid directions where formulas lose more digits.
const CORE_BOUND: f64 = 1e-9;

/// The error that robust points allow, where no digits cancel.
const ROBUST_BOUND: f64 = 1e-13;

/// A boundary seen from `wo`: Snell's law and Fresnel's equations.
struct Boundary {
    /// Cosine to the normal, on the side of `wo`.
    cos: f64,
    /// Index of the other side over that of the side of `wo`.
    n: f64,
    /// `n` times the cosine on the other side; `None` under total internal reflection.
    g: Option<f64>,
}

impl Boundary {
    fn new(cos: f64, n: f64) -> Boundary {
        let g2 = (n - 1.0) * (n + 1.0) + cos * cos;
        Boundary {
            cos,
            n,
            g: (g2 > 0.0 && cos > 0.0).then(|| g2.sqrt()),
        }
    }

    fn seen_from(wo: Xyz, ior: f64) -> Boundary {
        let n = if wo[2] > 0.0 { ior } else { 1.0 / ior };
        Boundary::new(wo[2].abs(), n)
    }

    /// The Fresnel reflectance in the form of Cook and Torrance ("A reflectance model for computer
    /// graphics", 1982).
    fn reflected(&self) -> f64 {
        let (Some(g), c) = (self.g, self.cos) else {
            return 1.0;
        };
        let (apart, together) = (g - c, g + c);
        let swing = (c * together - 1.0) / (c * apart + 1.0);
        0.5 * (apart / together).powi(2) * (1.0 + swing * swing)
    }

    /// The refracted direction.
    fn refracted(&self, wo: Xyz) -> Option<Vec3> {
        let height = self.g? / self.n;
        let wi = [-wo[0] / self.n, -wo[1] / self.n, -height.copysign(wo[2])];
        Some(Vec3::from(wi))
    }

    /// How far results may be off: near the critical angle the square root magnifies rounding
    /// errors.
    fn bound(&self, tier: Tier) -> f64 {
        let g = self.g.unwrap_or(1.0).max(1e-12);
        let magnified =
            64.0 * f64::EPSILON * (1.0 + self.n * self.n) / (g * self.cos.max(g) * self.n.min(1.0));
        magnified
            + match tier {
                Tier::Core => CORE_BOUND,
                Tier::Robust => ROBUST_BOUND,
            }
    }
}

/// Judges calls of all functions of the task.
pub(crate) fn specular(
    tally: &mut Tally,
    tier: Tier,
    calls: &[SpecularCall],
    answers: &[SpecularAnswer],
) {
    for (call, (input, answer)) in calls.iter().zip(answers).enumerate() {
        one(tally, tier, call, input, answer);
    }
    if calls.len() >= MIN_ESTIMATES && tally.is_written("glass_sample", &[Aspect::Mean]) {
        frequency(tally, calls, answers);
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

/// The exact result of a call.
pub(crate) enum Right {
    /// The Fresnel reflectance.
    Share(f64),
    /// A direction, if there is one.
    Direction(Option<Vec3>),
    /// A sample, if there is one.
    Sample(Option<BsdfSample>),
}

/// The exact result of a call, and how far an answer may be from it.
pub(crate) fn right(tier: Tier, input: &SpecularCall) -> (Right, f64) {
    let sample = |wi: Vec3, pdf: f64, arrives: Vec3| BsdfSample {
        wi: wi.into(),
        f: (arrives * pdf / wi.z.abs()).into(),
        pdf,
        delta: true,
    };
    let mirrored = |wo: Xyz| Vec3::new(-wo[0], -wo[1], wo[2]);
    let refracted_radiance =
        |boundary: &Boundary, tint: Xyz| Vec3::from(tint) / (boundary.n * boundary.n);
    match *input {
        SpecularCall::Fresnel { cos_i, eta } => {
            let boundary = Boundary::new(cos_i, 1.0 / eta);
            (Right::Share(boundary.reflected()), boundary.bound(tier))
        }
        SpecularCall::Reflect { wo } => (Right::Direction(Some(mirrored(wo))), ROBUST_BOUND),
        SpecularCall::Refract { wo, ior } => {
            let boundary = Boundary::seen_from(wo, ior);
            let wi = boundary.refracted(wo);
            (Right::Direction(wi), boundary.bound(tier))
        }
        SpecularCall::Mirror { reflectance, wo } => {
            let wi = mirrored(wo);
            let right = (wi.z != 0.0).then(|| sample(wi, 1.0, reflectance.into()));
            (Right::Sample(right), ROBUST_BOUND)
        }
        SpecularCall::Refraction {
            transmittance,
            ior,
            wo,
        } => {
            let boundary = Boundary::seen_from(wo, ior);
            let arrives = refracted_radiance(&boundary, transmittance);
            let right = boundary.refracted(wo).map(|wi| sample(wi, 1.0, arrives));
            (Right::Sample(right), boundary.bound(tier))
        }
        SpecularCall::Glass {
            reflectance,
            transmittance,
            ior,
            wo,
            choice,
        } => {
            let boundary = Boundary::seen_from(wo, ior);
            let share = boundary.reflected();
            let right = if wo[2] == 0.0 {
                None
            } else if choice < share {
                Some(sample(mirrored(wo), share, reflectance.into()))
            } else {
                let arrives = refracted_radiance(&boundary, transmittance);
                let wi = boundary.refracted(wo);
                wi.map(|wi| sample(wi, 1.0 - share, arrives))
            };
            (Right::Sample(right), boundary.bound(tier))
        }
    }
}

/// The aspects of an answer.
fn aspects(answer: &SpecularAnswer) -> &'static [Aspect] {
    use Aspect::{Bsdf, Fresnel, HitOrMiss, Pdf, SampledDirection};
    match answer {
        SpecularAnswer::Share(_) => &[Fresnel],
        SpecularAnswer::Direction(_) => &[HitOrMiss, SampledDirection],
        SpecularAnswer::Sample(_) => &[HitOrMiss, SampledDirection, Pdf, Bsdf],
    }
}

fn one(tally: &mut Tally, tier: Tier, call: usize, input: &SpecularCall, answer: &SpecularAnswer) {
    if !tally.is_written(function(input), aspects(answer)) {
        return;
    }
    tally.answers_of(function(input));
    tally.count_for(function(input));
    let (_, bound) = right(tier, input);
    if bound > WIDE {
        let aspect = match answer {
            SpecularAnswer::Share(_) => Aspect::Fresnel,
            SpecularAnswer::Direction(_) => Aspect::SampledDirection,
            SpecularAnswer::Sample(_) => Aspect::Pdf,
        };
        tally.not_judged(aspect, call, TOO_WIDE);
    }
    match (right(tier, input), answer) {
        ((Right::Share(right), bound), SpecularAnswer::Share(share)) => {
            tally.expect(Aspect::Fresnel);
            let off = (share - right).abs();
            let class = (off.is_nan() || off > bound).then(|| Class::of_number(*share, right));
            tally.judge_class(Aspect::Fresnel, call, class, off, || {
                format!("your result: {share:?}; expected: {right:?}. {input:?}")
            });
        }
        ((Right::Direction(right), bound), SpecularAnswer::Direction(wi)) => {
            optional_direction(tally, call, input, *wi, right, bound);
        }
        ((Right::Sample(right), bound), SpecularAnswer::Sample(sample)) => {
            record(tally, call, input, sample.as_ref(), right, bound);
        }
        _ => debug_assert!(false, "`fits` accepted {answer:?} for {input:?}"),
    }
}

/// Judges a direction, which may be `None`.
fn optional_direction(
    tally: &mut Tally,
    call: usize,
    input: &SpecularCall,
    answered: Option<Xyz>,
    right: Option<Vec3>,
    bound: f64,
) {
    tally.expect(Aspect::HitOrMiss);
    let class = match (answered, right) {
        (Some(_), None) => Some(Class::FalseHit),
        (None, Some(_)) => Some(Class::FalseMiss),
        _ => None,
    };
    tally.judge_class(Aspect::HitOrMiss, call, class, 1.0, || {
        let right = right.map_or("no direction".into(), show);
        format!("your result: {answered:?}; expected: {right}. {input:?}")
    });
    if let Some(right) = right {
        tally.expect(Aspect::SampledDirection);
        if let Some(answered) = answered {
            let aspect = Aspect::SampledDirection;
            numbers::direction(tally, aspect, call, answered, right, bound, || {
                format!("{input:?}")
            });
        }
    }
}

/// Judges a sample, which may be `None`: its direction, its probability and its weight.
fn record(
    tally: &mut Tally,
    call: usize,
    input: &SpecularCall,
    answered: Option<&BsdfSample>,
    right: Option<BsdfSample>,
    bound: f64,
) {
    let direction = |sample: &BsdfSample| Vec3::from(sample.wi);
    let wi = answered.map(|sample| sample.wi);
    optional_direction(tally, call, input, wi, right.as_ref().map(direction), bound);
    let Some(right) = right else { return };
    tally.expect(Aspect::Pdf);
    tally.expect(Aspect::Bsdf);
    let Some(answered) = answered else { return };
    let off = (answered.pdf - right.pdf).abs();
    let class = (off.is_nan() || off > bound).then(|| Class::of_number(answered.pdf, right.pdf));
    let class = class.or((!answered.delta).then_some(Class::Wrong));
    tally.judge_class(Aspect::Pdf, call, class, off, || {
        format!(
            "your result: pdf = {:?}, delta = {}; expected: pdf = {:?}, delta = true. {input:?}",
            answered.pdf, answered.delta, right.pdf
        )
    });
    // The weight f · |cos θ| / pdf, by which a path multiplies its throughput.
    let arrives = |sample: &BsdfSample| sample.f.map(|f| f * sample.wi[2].abs() / sample.pdf);
    let (right, bound) = (arrives(&right), weight_bound(bound, right.pdf));
    numbers::colour(
        tally,
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
fn frequency(tally: &mut Tally, calls: &[SpecularCall], answers: &[SpecularAnswer]) {
    let Some(&SpecularCall::Glass { ior, wo, .. }) = calls.first() else {
        return;
    };
    let reflected: SampleTally = answers
        .iter()
        .map(|answer| match answer {
            SpecularAnswer::Sample(Some(sample)) if sample.wi[2] * wo[2] > 0.0 => 1.0,
            _ => 0.0,
        })
        .collect();
    let share = Boundary::seen_from(wo, ior).reflected();
    chance::mean(tally, "choices to reflect", &reflected, share);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boundaries_match_textbook_values() {
        let head_on = Boundary::new(1.0, 1.5).reflected();
        assert!((head_on - 0.04).abs() < 1e-15);
        assert_eq!(Boundary::new(0.0, 1.5).reflected(), 1.0);
        // From glass, sine 0.8: beyond the critical angle.
        assert_eq!(Boundary::new(0.6, 1.0 / 1.5).reflected(), 1.0);
        // Brewster's angle.
        let cos = 1.0 / (1.0 + 2.25_f64).sqrt();
        let right = 0.5 * (1.25_f64 / 3.25).powi(2);
        assert!((Boundary::new(cos, 1.5).reflected() - right).abs() < 1e-15);
        let straight = Boundary::seen_from([0.6, 0.0, 0.8], 1.0).refracted([0.6, 0.0, 0.8]);
        assert!((straight.unwrap() - Vec3::new(-0.6, 0.0, -0.8)).length() < 1e-15);
    }
}
