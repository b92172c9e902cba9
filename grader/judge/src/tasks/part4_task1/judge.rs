//! Judging mirrors, refraction and glass.

use crate::Tier;
use crate::chance::{self, MIN_ESTIMATES};
use crate::hits::show;
use crate::numbers;
use crate::tally::{Aspect, Class, Tally};
use kit::{Tally as SampleTally, Vec3};
use wire::global::{SpecularAnswer, SpecularCall};
use wire::light::BsdfSample;
use wire::work::Xyz;

/// What core points forgive: a hundred-millionth. Probes stay away from where formulas lose more.
const CORE_BOUND: f64 = 1e-9;

/// What robust points forgive, where nothing cancels.
const ROBUST_BOUND: f64 = 1e-13;

/// A boundary seen from `wo`: what Snell and Fresnel say of it.
struct Boundary {
    /// Cosine to the normal, on the side of `wo`.
    cos: f64,
    /// Index of the other side over that of this one.
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

    /// Fresnel's share as Cook and Torrance write it ("A reflectance model for computer graphics",
    /// 1982).
    fn reflected(&self) -> f64 {
        let (Some(g), c) = (self.g, self.cos) else {
            return 1.0;
        };
        let (apart, together) = (g - c, g + c);
        let swing = (c * together - 1.0) / (c * apart + 1.0);
        0.5 * (apart / together).powi(2) * (1.0 + swing * swing)
    }

    /// The direction on the other side.
    fn refracted(&self, wo: Xyz) -> Option<Vec3> {
        let height = self.g? / self.n;
        let wi = [-wo[0] / self.n, -wo[1] / self.n, -height.copysign(wo[2])];
        Some(Vec3::from(wi))
    }

    /// How far results may be off: near the critical angle the root magnifies each rounding.
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

/// Judges calls of all these functions.
pub(crate) fn specular(
    tally: &mut Tally,
    tier: Tier,
    calls: &[SpecularCall],
    answers: &[SpecularAnswer],
) {
    for (call, (asked, answer)) in calls.iter().zip(answers).enumerate() {
        one(tally, tier, call, asked, answer);
    }
    if calls.len() >= MIN_ESTIMATES {
        frequency(tally, calls, answers);
    }
}

/// The function that a call is of.
pub(crate) fn function(asked: &SpecularCall) -> &'static str {
    match asked {
        SpecularCall::Fresnel { .. } => "fresnel_dielectric",
        SpecularCall::Reflect { .. } => "reflect",
        SpecularCall::Refract { .. } => "refract",
        SpecularCall::Mirror { .. } => "mirror_sample",
        SpecularCall::Refraction { .. } => "refraction_sample",
        SpecularCall::Glass { .. } => "glass_sample",
    }
}

/// Whether an answer has the form that the function of the call gives.
pub(crate) fn is_answer_to(asked: &SpecularCall, answer: &SpecularAnswer) -> bool {
    matches!(
        (asked, answer),
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

/// What is right, and how far an answer may be from it.
pub(crate) enum Right {
    /// The share of light that is reflected.
    Share(f64),
    /// A direction, if there is one.
    Direction(Option<Vec3>),
    /// A sample, if there is one.
    Sample(Option<BsdfSample>),
}

/// The right answer to a call; for core points this much off is forgiven.
pub(crate) fn right(tier: Tier, asked: &SpecularCall) -> (Right, f64) {
    let sample = |wi: Vec3, pdf: f64, arrives: Vec3| BsdfSample {
        wi: wi.into(),
        f: (arrives * pdf / wi.z.abs()).into(),
        pdf,
        delta: true,
    };
    let mirrored = |wo: Xyz| Vec3::new(-wo[0], -wo[1], wo[2]);
    let squeezed = |boundary: &Boundary, tint: Xyz| Vec3::from(tint) / (boundary.n * boundary.n);
    match *asked {
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
            let arrives = squeezed(&boundary, transmittance);
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
                let arrives = squeezed(&boundary, transmittance);
                let wi = boundary.refracted(wo);
                wi.map(|wi| sample(wi, 1.0 - share, arrives))
            };
            (Right::Sample(right), boundary.bound(tier))
        }
    }
}

fn one(tally: &mut Tally, tier: Tier, call: usize, asked: &SpecularCall, answer: &SpecularAnswer) {
    tally.answers_of(function(asked));
    match (right(tier, asked), answer) {
        ((Right::Share(right), bound), SpecularAnswer::Share(share)) => {
            tally.expect(Aspect::Fresnel);
            let off = (share - right).abs();
            let class = (off.is_nan() || off > bound).then(|| Class::of_number(*share, right));
            tally.judge_class(Aspect::Fresnel, call, class, off, || {
                format!("it is {share:?}, right is {right:?}. {asked:?}")
            });
        }
        ((Right::Direction(right), bound), SpecularAnswer::Direction(wi)) => {
            way(tally, call, asked, *wi, right, bound);
        }
        ((Right::Sample(right), bound), SpecularAnswer::Sample(sample)) => {
            record(tally, call, asked, sample.as_ref(), right, bound);
        }
        _ => debug_assert!(false, "`fits` has let {answer:?} to {asked:?} pass"),
    }
}

/// Judges a direction that may not exist.
fn way(
    tally: &mut Tally,
    call: usize,
    asked: &SpecularCall,
    answered: Option<Xyz>,
    right: Option<Vec3>,
    bound: f64,
) {
    tally.expect(Aspect::Decision);
    let class = match (answered, right) {
        (Some(_), None) => Some(Class::FalseHit),
        (None, Some(_)) => Some(Class::FalseMiss),
        _ => None,
    };
    tally.judge_class(Aspect::Decision, call, class, 1.0, || {
        let right = right.map_or("no direction at all".into(), show);
        format!("the answer is {answered:?}, right is {right}. {asked:?}")
    });
    if let Some(right) = right {
        tally.expect(Aspect::SampledDirection);
        if let Some(answered) = answered {
            let aspect = Aspect::SampledDirection;
            numbers::direction(tally, aspect, call, answered, right, bound, || {
                format!("{asked:?}")
            });
        }
    }
}

/// Judges a sample that may not exist: its direction, its probability, and the light that arrives
/// by it.
fn record(
    tally: &mut Tally,
    call: usize,
    asked: &SpecularCall,
    answered: Option<&BsdfSample>,
    right: Option<BsdfSample>,
    bound: f64,
) {
    let direction = |sample: &BsdfSample| Vec3::from(sample.wi);
    let wi = answered.map(|sample| sample.wi);
    way(tally, call, asked, wi, right.as_ref().map(direction), bound);
    let Some(right) = right else { return };
    tally.expect(Aspect::Pdf);
    tally.expect(Aspect::Bsdf);
    let Some(answered) = answered else { return };
    let off = (answered.pdf - right.pdf).abs();
    let class = (off.is_nan() || off > bound).then(|| Class::of_number(answered.pdf, right.pdf));
    let class = class.or((!answered.delta).then_some(Class::Wrong));
    tally.judge_class(Aspect::Pdf, call, class, off, || {
        format!(
            "pdf = {:?} and delta = {}, right are {:?} and true. {asked:?}",
            answered.pdf, answered.delta, right.pdf
        )
    });
    // The light that arrives, f · |cos θ| / pdf: what a path multiplies by.
    let arrives = |sample: &BsdfSample| sample.f.map(|f| f * sample.wi[2].abs() / sample.pdf);
    let (right, bound) = (arrives(&right), weight_bound(bound, right.pdf));
    numbers::colour(
        tally,
        Aspect::Bsdf,
        call,
        arrives(answered),
        right,
        bound,
        || format!("f · |cos| / pdf of {asked:?}, f = {:?}", answered.f),
    );
}

/// How far the light that arrives by a sample may be off, as a share, where its other numbers may
/// be off by `bound`.
pub(crate) fn weight_bound(bound: f64, pdf: f64) -> f64 {
    bound / pdf.max(1e-3)
}

/// How often glass reflects, over many choices at the same place.
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
    fn the_boundary_knows_its_textbook_values() {
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
