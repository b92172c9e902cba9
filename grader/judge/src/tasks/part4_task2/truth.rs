//! The right rays, calls and radiance of a scripted path.

use crate::tools::packed_truth;
// BEGIN SOLUTION(part4.task2)
use kit::{Frame, Vec3};
// END SOLUTION(part4.task2)
use serde::{Deserialize, Serialize};
use wire::global::ScriptedPath;
// BEGIN SOLUTION(part4.task2)
use wire::global::Step;
use wire::light::{BsdfSample, Material};
// END SOLUTION(part4.task2)
use wire::work::Xyz;

/// The right results for a scripted path.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Right {
    /// The number of surfaces that are hit.
    pub(super) surfaces: usize,
    /// Whether one more ray is traced, which hits nothing.
    pub(super) leaves: bool,
    /// The directions of the rays to each surface, and of the last ray, which misses.
    pub(super) directions: Vec<Xyz>,
    /// The calls of `direct`: the surface, and the direction to the viewer.
    pub(super) direct: Vec<(u32, Xyz)>,
    /// At each bounce that calls roulette, the throughput before it.
    pub(super) bounces: Vec<Bounce>,
    /// The radiance of the path.
    pub(super) radiance: Xyz,
}

/// A bounce at which roulette is called.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Bounce {
    /// The number of its surface.
    pub(super) surface: usize,
    /// The throughput before it.
    pub(super) before: Xyz,
    /// The throughput after it, with which roulette is called.
    pub(super) after: Xyz,
}

impl Right {
    /// The right results for `path`.
    pub(super) fn of(path: &ScriptedPath) -> Right {
        // BEGIN SOLUTION(part4.task2)
        let right = Walk::of(path).right(path);
        packed_truth::record("part4.task2", "path", path, right)
        // STUB: packed_truth::find("part4.task2", "path", path)
        // END SOLUTION(part4.task2)
    }
}

// BEGIN SOLUTION(part4.task2)
/// The way of a path over its surfaces.
struct Walk {
    surfaces: usize,
    leaves: bool,
    directions: Vec<Vec3>,
    /// The throughput of the ray along each direction.
    weights: Vec<Vec3>,
}

/// The weight of `sample`, f · |cos θ| / pdf.
fn factor(sample: &BsdfSample) -> Vec3 {
    Vec3::from(sample.f) * sample.wi[2].abs() / sample.pdf
}

/// The sampled direction and the factor of roulette where a path continues.
fn goes_on(step: &Step) -> Option<(BsdfSample, f64)> {
    step.sample.zip(step.roulette)
}

fn is_delta(step: &Step) -> bool {
    matches!(step.material, Material::Mirror(_) | Material::Glass(_))
}

impl Walk {
    fn of(path: &ScriptedPath) -> Walk {
        let most = path.max_depth.max(1) as usize;
        let bounces: Vec<(BsdfSample, f64)> = path.steps.iter().map_while(goes_on).collect();
        let surfaces = path.steps.len().min(bounces.len() + 1).min(most);
        let leaves = bounces.len() == path.steps.len() && most > path.steps.len();
        let drawn = path.steps.iter().zip(&bounces);
        let behind = drawn
            .map(|(step, (sample, _))| Frame::around(step.n.into()).to_world(sample.wi.into()));
        let weights = bounces
            .iter()
            .scan(Vec3::ONE, |weight, (sample, roulette)| {
                *weight *= factor(sample) * *roulette;
                Some(*weight)
            });
        Walk {
            surfaces,
            leaves,
            directions: std::iter::once(path.ray.d.into()).chain(behind).collect(),
            weights: std::iter::once(Vec3::ONE).chain(weights).collect(),
        }
    }

    fn right(self, path: &ScriptedPath) -> Right {
        let surfaces = (0..).zip(&path.steps).zip(&self.directions);
        let direct = surfaces
            .take(self.surfaces)
            .filter(|((_, step), _)| path.max_depth > 0 && !is_delta(step))
            .map(|((i, _), d)| (i, (-*d).into()));
        // No ray continues from the last surface that the depth allows, nor from one without a
        // sampled direction.
        let most = (path.max_depth as usize)
            .saturating_sub(1)
            .min(self.surfaces);
        let steps = path.steps.iter().zip(&self.weights).enumerate();
        let bounces = steps.take(most).filter_map(|(surface, (step, before))| {
            Some(Bounce {
                surface,
                before: (*before).into(),
                after: (*before * factor(step.sample.as_ref()?)).into(),
            })
        });
        Right {
            surfaces: self.surfaces,
            leaves: self.leaves,
            direct: direct.collect(),
            bounces: bounces.collect(),
            radiance: self.radiance(path).into(),
            directions: self.directions.into_iter().map(Into::into).collect(),
        }
    }

    /// The right radiance of the path.
    fn radiance(&self, path: &ScriptedPath) -> Vec3 {
        let ways = self.directions.iter().zip(&self.weights).enumerate();
        ways.map(|(i, (d, weight))| {
            let eye_sees = i == 0 || goes_on(&path.steps[i - 1]).is_some_and(|(s, _)| s.delta);
            let seen = if i < self.surfaces {
                self.sent(path, &path.steps[i], *d, eye_sees)
            } else if i == path.steps.len() && self.leaves && eye_sees {
                path.background_along((*d).into()).into()
            } else {
                Vec3::ZERO
            };
            *weight * seen
        })
        .sum()
    }

    /// The radiance that one surface emits and scatters back along `d`.
    fn sent(&self, path: &ScriptedPath, step: &Step, d: Vec3, eye_sees: bool) -> Vec3 {
        let emitted = match step.material {
            Material::Emission(radiance) if eye_sees && d.dot(step.n.into()) < 0.0 => {
                radiance.into()
            }
            _ => Vec3::ZERO,
        };
        let is_lit = path.max_depth > 0 && !is_delta(step);
        emitted
            + if is_lit {
                step.direct.into()
            } else {
                Vec3::ZERO
            }
    }
}
// END SOLUTION(part4.task2)
