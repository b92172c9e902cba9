//! Judges paths: the traced rays, the calls of other functions, and the radiance.

use super::draws;
use super::throughput;
use crate::tools::aspects::hits::show;
use crate::tools::aspects::numbers;
use crate::tools::tally::{Aspect, Class, Tally};
use kit::{Frame, Vec3};
use wire::global::{PathAnswer, ScriptedPath, Step};
use wire::light::{BsdfSample, Material};
use wire::work::Ray;

/// Relative error allowed in a sum: a few roundings per bounce.
pub(crate) const SUM_BOUND: f64 = 1e-11;

/// How far a direction or an origin may be off.
pub(super) const PLACE_BOUND: f64 = 1e-9;

/// The right results for a scripted path.
pub(crate) struct Right {
    /// The number of surfaces that are hit.
    pub(crate) surfaces: usize,
    /// Whether one more ray is traced, which hits nothing.
    leaves: bool,
    /// The directions of the rays to each surface, and of the last ray, which misses.
    pub(crate) directions: Vec<Vec3>,
    /// The throughput of each of these rays.
    pub(crate) weights: Vec<Vec3>,
}

/// The weight of `sample`, f · |cos θ| / pdf.
pub(crate) fn factor(sample: &BsdfSample) -> Vec3 {
    Vec3::from(sample.f) * sample.wi[2].abs() / sample.pdf
}

/// The sampled direction and the factor of roulette where a path continues.
fn goes_on(step: &Step) -> Option<(BsdfSample, f64)> {
    step.sample.zip(step.roulette)
}

impl Right {
    pub(super) fn of(path: &ScriptedPath) -> Right {
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
        Right {
            surfaces,
            leaves,
            directions: std::iter::once(path.ray.d.into()).chain(behind).collect(),
            weights: std::iter::once(Vec3::ONE).chain(weights).collect(),
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
                path.background.into()
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

fn is_delta(step: &Step) -> bool {
    matches!(step.material, Material::Mirror(_) | Material::Glass(_))
}

/// Judges every path.
pub(crate) fn paths(tally: &mut Tally, paths: &[ScriptedPath], answers: &[PathAnswer]) {
    for (call, (path, answer)) in paths.iter().zip(answers).enumerate() {
        let right = Right::of(path);
        let about = || {
            let steps = path.steps.iter().map(|step| format!("{:?}", step.material));
            format!(
                "-m {}, a path of {} surfaces: {}",
                path.max_depth,
                path.steps.len(),
                steps.collect::<Vec<_>>().join(", ")
            )
        };
        tally.expect(Aspect::Radiance);
        let (sum, aspect) = (right.radiance(path), Aspect::Radiance);
        numbers::colour(
            tally,
            aspect,
            call,
            answer.radiance,
            sum.into(),
            SUM_BOUND,
            about,
        );
        rays(tally, call, path, answer, &right, &about);
        direct(tally, call, path, answer, &right, &about);
        throughput::judge(tally, call, path, answer, &right, &about);
        draws::judge(tally, call, path, answer, &right, &about);
    }
}

fn rays(
    tally: &mut Tally,
    call: usize,
    path: &ScriptedPath,
    answer: &PathAnswer,
    right: &Right,
    about: &impl Fn() -> String,
) {
    tally.expect(Aspect::Rays);
    let (traced, wanted) = (
        answer.rays.len(),
        right.surfaces + usize::from(right.leaves),
    );
    let class = (traced != wanted).then(|| Class::of_size(traced as f64 - wanted as f64));
    let off = traced.abs_diff(wanted) as f64;
    tally.judge_class(Aspect::Rays, call, class, off, || {
        format!(
            "your result: {traced} rays; expected: {wanted}. {}",
            about()
        )
    });
    for (i, ray) in answer.rays.iter().enumerate().take(wanted) {
        tally.expect(Aspect::Direction);
        let d = right.directions[i];
        numbers::direction(
            tally,
            Aspect::Direction,
            call,
            ray.d,
            d,
            PLACE_BOUND,
            || format!("Ray {i} of {}", about()),
        );
        tally.expect(Aspect::Origin);
        let class = match i.checked_sub(1) {
            None => (*ray != path.ray).then_some(Class::Wrong),
            Some(before) => leaves(ray, &path.steps[before]),
        };
        tally.judge_class(Aspect::Origin, call, class, 1.0, || {
            let from = i
                .checked_sub(1)
                .map_or("the first ray, unchanged".into(), |i| {
                    let p = show(path.steps[i].p.into());
                    format!("an origin that Surface::leave returns at {p}, and the whole range")
                });
            format!(
                "your result: ray {i} starts at {} with t in [{:?}, {:?}]; expected: {from}. {}",
                show(ray.o.into()),
                ray.min_t,
                ray.max_t,
                about()
            )
        });
    }
}

/// The class of a ray with a wrong origin or range; `None` if both are right.
fn leaves(ray: &Ray, step: &Step) -> Option<Class> {
    let (n, d) = (Vec3::from(step.n), Vec3::from(ray.d));
    let off = Vec3::from(ray.o) - Vec3::from(step.p);
    if off.is_nan() || off.length() > PLACE_BOUND || ray.min_t != 0.0 || ray.max_t != f64::INFINITY
    {
        return Some(Class::of_offset(off.length()));
    }
    (off.dot(n) * d.dot(n) <= 0.0).then_some(Class::Negated)
}

/// Judges the calls of `direct`: one at every surface except mirrors and glass.
fn direct(
    tally: &mut Tally,
    call: usize,
    path: &ScriptedPath,
    answer: &PathAnswer,
    right: &Right,
    about: &impl Fn() -> String,
) {
    let surfaces = path
        .steps
        .iter()
        .zip(&right.directions)
        .take(right.surfaces);
    let wanted: Vec<(u32, Vec3)> = (0..)
        .zip(surfaces)
        .filter(|(_, (step, _))| path.max_depth > 0 && !is_delta(step))
        .map(|(i, (_, d))| (i, -*d))
        .collect();
    tally.expect(Aspect::Questions);
    let pairs = answer.direct.iter().zip(&wanted);
    let same = answer.direct.len() == wanted.len()
        && pairs.into_iter().all(|((i, wo), (j, right))| {
            i == j && (Vec3::from(*wo) - *right).length() < PLACE_BOUND
        });
    tally.judge(Aspect::Questions, call, same, 1.0, || {
        format!(
            "your calls of direct: (surface, wo) {:?}; expected: {wanted:?}. {}",
            answer.direct,
            about()
        )
    });
}
