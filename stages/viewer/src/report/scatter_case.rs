//! How a surface scatters: the directions of a call, and the lobe of all samples of the case.

use judge::shown::{ShownBounce, ShownCall};
use judge::{Tier, cases::Spec, diffuse_density};
use kit::{Aabb, Vec3};
use std::f64::consts::{FRAC_PI_2, TAU};
use wire::Answer;
use wire::direct::{LambertAnswer, LambertProbe};
use wire::work::Xyz;

/// Directions at a surface whose normal points along +y.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScatterCase {
    /// To the viewer.
    pub wo: Vec3,
    /// To the light: what a diffuse surface is asked about.
    pub wi: Option<Vec3>,
    /// The right direction of a mirror or glass, if there is one.
    pub expected: Option<Vec3>,
    /// The stage's: what it sampled, reflected or refracted, if anything.
    pub yours: Option<Vec3>,
    /// Curves of the right density, relative to the largest: of diffuse surfaces.
    pub curves: Vec<Vec<Vec3>>,
    /// The directions that all calls of the case sampled on the side of the viewer, each as long as
    /// the density that the stage returned with it, relative to the largest right one.
    pub samples: Vec<Vec3>,
}

/// Curves of a lobe, and pieces of each.
const CURVES: u32 = 12;
const PIECES: u32 = 24;

/// Longer than this, relative to the largest right density, no sample is drawn.
const LONGEST: f64 = 1.6;

/// From local space, where the normal is +z, to a view in which it points up.
fn upright(w: Xyz) -> Vec3 {
    Vec3::new(w[0], w[2], -w[1])
}

impl ScatterCase {
    /// A call of the functions of diffuse surfaces.
    pub fn of_diffuse(
        probes: &[LambertProbe],
        answers: &[LambertAnswer],
        call: usize,
    ) -> Option<ScatterCase> {
        let (probe, answer) = (probes.get(call)?, answers.get(call)?);
        let side = if probe.wo[2] < 0.0 { -1.0 } else { 1.0 };
        let density = diffuse_density();
        let largest = density(1.0);
        let curve = |turn: f64| {
            let pieces = (0..=PIECES).map(move |piece| {
                let angle = FRAC_PI_2 * f64::from(piece) / f64::from(PIECES);
                let (sin, cos) = angle.sin_cos();
                let w = [sin * turn.cos(), sin * turn.sin(), side * cos];
                (w, cos)
            });
            let points = pieces.map(|(w, cos)| upright(w) * (density(cos) / largest));
            points.collect::<Vec<Vec3>>()
        };
        let pairs = probes.iter().zip(answers);
        let samples = pairs
            .filter(|(probe, _)| probe.wo[2] * side > 0.0)
            .filter_map(|(_, answer)| answer.sample);
        Some(ScatterCase {
            wo: upright(probe.wo),
            wi: Some(upright(probe.wi)),
            expected: None,
            yours: answer.sample.map(|sample| upright(sample.wi)),
            curves: (0..CURVES)
                .map(|i| curve(TAU * f64::from(i) / f64::from(CURVES)))
                .collect(),
            samples: samples
                .map(|sample| {
                    let length = (sample.pdf / largest).clamp(0.0, LONGEST);
                    upright(sample.wi).normalize_or_zero() * length
                })
                .filter(|p| p.is_finite())
                .collect(),
        })
    }

    /// A call of the functions of mirrors and glass; `None` for one that returns no direction.
    pub fn of_specular(spec: &Spec, tier: Tier, answer: &Answer, call: usize) -> Option<Self> {
        let ShownCall::Bounce(ShownBounce {
            wo,
            expected,
            yours,
        }) = spec.shown(tier, call, Some(answer))?
        else {
            return None;
        };
        Some(ScatterCase {
            wo: upright(wo),
            expected: expected.map(upright),
            yours: yours.map(upright).filter(|w| w.is_finite()),
            ..ScatterCase::default()
        })
    }

    /// A box around the surface and unit directions on both of its sides.
    pub fn bounds(&self) -> Aabb {
        let ends = [Some(self.wo), self.wi, self.expected, self.yours]
            .into_iter()
            .flatten()
            .chain(self.samples.clone());
        let flat = Aabb::of([Vec3::new(-1.0, 0.0, -1.0), Vec3::ONE]);
        ends.filter(|p| p.is_finite())
            .map(|p| p.clamp_length_max(LONGEST))
            .fold(flat, Aabb::grown_by)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::light::BsdfSample;

    #[test]
    fn right_samples_of_a_diffuse_surface_lie_on_its_lobe_and_others_do_not() {
        let probe = LambertProbe {
            reflectance: [0.5; 3],
            wo: [0.0, 0.6, 0.8],
            wi: [0.0, 0.0, 1.0],
            u: [0.5; 2],
        };
        let density = diffuse_density();
        let answer = |pdf: f64| LambertAnswer {
            f: [0.0; 3],
            pdf: 0.0,
            sample: Some(BsdfSample {
                wi: [0.6, 0.0, 0.8],
                f: [0.0; 3],
                pdf,
                delta: false,
            }),
        };
        let answers = [answer(density(0.8)), answer(density(0.5))];
        let case = ScatterCase::of_diffuse(&[probe; 2], &answers, 0).expect("a call");
        // The lobe of a diffuse surface is a sphere that touches the surface.
        let is_on_lobe = |p: &Vec3| (p.distance(0.5 * Vec3::Y) - 0.5).abs() < 1e-9;
        assert!(case.curves.iter().flatten().all(is_on_lobe));
        let are_on_lobe: Vec<bool> = case.samples.iter().map(is_on_lobe).collect();
        assert_eq!(are_on_lobe, [true, false], "{:?}", case.samples);
        assert_eq!(case.wo, Vec3::new(0.0, 0.8, -0.6));
    }
}
