//! The right results of mirrors and glass: Snell's law and Fresnel's equations.

use crate::tools::Tier;
use crate::tools::packed_truth;
// BEGIN SOLUTION(part4.task1)
use kit::Vec3;
// END SOLUTION(part4.task1)
use serde::{Deserialize, Serialize};
use wire::global::SpecularCall;
use wire::light::BsdfSample;
use wire::work::Xyz;

/// The error that core points allow. Core probes avoid directions where formulas lose more digits.
const CORE_BOUND: f64 = 1e-9;

/// The error that robust points allow, where no digits cancel.
const ROBUST_BOUND: f64 = 1e-13;

/// The right result of a call.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) enum Right {
    /// The Fresnel reflectance.
    Share(f64),
    /// A direction, if there is one.
    Direction(Option<Xyz>),
    /// A sample, if there is one.
    Sample(Option<BsdfSample>),
}

/// The right result of a call, and how far an answer may be from it.
pub(super) fn right(tier: Tier, input: &SpecularCall) -> (Right, f64) {
    let (right, rounding) = result(input);
    let bound = match (rounding, tier) {
        (None, _) => ROBUST_BOUND,
        (Some(rounding), Tier::Core) => rounding + CORE_BOUND,
        (Some(rounding), Tier::Robust) => rounding + ROBUST_BOUND,
    };
    (right, bound)
}

/// The right result of a call, and how far rounding may take an answer off; `None` if nothing
/// rounds.
pub(super) fn result(input: &SpecularCall) -> (Right, Option<f64>) {
    // BEGIN SOLUTION(part4.task1)
    let right = computed(input);
    packed_truth::record("part4.task1", "result", input, right)
    // STUB: packed_truth::find("part4.task1", "result", input)
    // END SOLUTION(part4.task1)
}

/// The Fresnel reflectance of glass with the index `ior` seen from `wo`.
pub(super) fn reflected_share(wo: Xyz, ior: f64) -> f64 {
    // BEGIN SOLUTION(part4.task1)
    let share = Boundary::seen_from(wo, ior).reflected();
    packed_truth::record("part4.task1", "reflected share", &(wo, ior), share)
    // STUB: packed_truth::find("part4.task1", "reflected share", &(wo, ior))
    // END SOLUTION(part4.task1)
}

// BEGIN SOLUTION(part4.task1)
fn computed(input: &SpecularCall) -> (Right, Option<f64>) {
    let sample = |wi: Xyz, pdf: f64, arrives: Vec3| BsdfSample {
        wi,
        f: (arrives * pdf / wi[2].abs()).into(),
        pdf,
        delta: true,
    };
    let mirrored = |wo: Xyz| [-wo[0], -wo[1], wo[2]];
    let refracted_radiance =
        |boundary: &Boundary, tint: Xyz| Vec3::from(tint) / (boundary.n * boundary.n);
    match *input {
        SpecularCall::Fresnel { cos_i, eta } => {
            let boundary = Boundary::new(cos_i, 1.0 / eta);
            (
                Right::Share(boundary.reflected()),
                Some(boundary.rounding()),
            )
        }
        SpecularCall::Reflect { wo } => (Right::Direction(Some(mirrored(wo))), None),
        SpecularCall::Refract { wo, ior } => {
            let boundary = Boundary::seen_from(wo, ior);
            let wi = boundary.refracted(wo);
            (Right::Direction(wi), Some(boundary.rounding()))
        }
        SpecularCall::Mirror { reflectance, wo } => {
            let wi = mirrored(wo);
            let right = (wi[2] != 0.0).then(|| sample(wi, 1.0, reflectance.into()));
            (Right::Sample(right), None)
        }
        SpecularCall::Refraction {
            transmittance,
            ior,
            wo,
        } => {
            let boundary = Boundary::seen_from(wo, ior);
            let arrives = refracted_radiance(&boundary, transmittance);
            let right = boundary.refracted(wo).map(|wi| sample(wi, 1.0, arrives));
            (Right::Sample(right), Some(boundary.rounding()))
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
            (Right::Sample(right), Some(boundary.rounding()))
        }
    }
}

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
    fn refracted(&self, wo: Xyz) -> Option<Xyz> {
        let height = self.g? / self.n;
        Some([-wo[0] / self.n, -wo[1] / self.n, -height.copysign(wo[2])])
    }

    /// How far rounding may take results off: near the critical angle the square root magnifies it.
    fn rounding(&self) -> f64 {
        let g = self.g.unwrap_or(1.0).max(1e-12);
        64.0 * f64::EPSILON * (1.0 + self.n * self.n) / (g * self.cos.max(g) * self.n.min(1.0))
    }
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
        let straight = Vec3::from(straight.unwrap());
        assert!((straight - Vec3::new(-0.6, 0.0, -0.8)).length() < 1e-15);
    }
}
// END SOLUTION(part4.task1)
