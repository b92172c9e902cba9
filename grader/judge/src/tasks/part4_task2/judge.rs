//! Judges paths: the traced rays, the calls of other functions, and the radiance.

use super::draws;
use super::throughput;
use super::truth::Right;
use crate::plural;
use crate::tools::aspects::hits::show;
use crate::tools::aspects::numbers;
use crate::tools::call_text::{all_or_none, material, point};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::Vec3;
use wire::global::{PathAnswer, ScriptedPath, Step};
use wire::work::{Ray, Xyz};

/// Relative error allowed in a sum: a few roundings per bounce.
pub(crate) const SUM_BOUND: f64 = 1e-11;

/// How far a direction or an origin may be off.
pub(super) const PLACE_BOUND: f64 = 1e-9;

/// Judges every path.
pub(crate) fn paths(findings: &mut Findings, paths: &[ScriptedPath], answers: &[PathAnswer]) {
    for (call, (path, answer)) in paths.iter().zip(answers).enumerate() {
        let right = Right::of(path);
        let about = || {
            let steps = path.steps.iter().map(|step| material(&step.material));
            format!(
                "-m {}, a path of {}: {}",
                path.max_depth,
                plural(path.steps.len(), "surface", "surfaces"),
                steps.collect::<Vec<_>>().join(", ")
            )
        };
        findings.expect(Aspect::Radiance);
        let (sum, aspect) = (right.radiance, Aspect::Radiance);
        numbers::colour(
            findings,
            aspect,
            call,
            answer.radiance,
            sum,
            SUM_BOUND,
            about,
        );
        rays(findings, call, path, answer, &right, &about);
        direct(findings, call, answer, &right, &about);
        throughput::judge(findings, call, path, answer, &right, &about);
        draws::judge(findings, call, path, answer, &right, &about);
    }
}

fn rays(
    findings: &mut Findings,
    call: usize,
    path: &ScriptedPath,
    answer: &PathAnswer,
    right: &Right,
    about: &impl Fn() -> String,
) {
    findings.expect(Aspect::Rays);
    let (traced, wanted) = (
        answer.rays.len(),
        right.surfaces + usize::from(right.leaves),
    );
    let class = (traced != wanted).then(|| Class::of_size(traced as f64 - wanted as f64));
    let off = traced.abs_diff(wanted) as f64;
    findings.judge_class(Aspect::Rays, call, class, off, || {
        let traced = plural(traced, "ray", "rays");
        Message::new(format!("your result: {traced}; expected: {wanted}")).asked(about())
    });
    for (i, ray) in answer.rays.iter().enumerate().take(wanted) {
        findings.expect(Aspect::Direction);
        let d = Vec3::from(right.directions[i]);
        numbers::direction(
            findings,
            Aspect::Direction,
            call,
            ray.d,
            d,
            PLACE_BOUND,
            || format!("Ray {i} of {}", about()),
        );
        findings.expect(Aspect::Origin);
        let class = match i.checked_sub(1) {
            None => (*ray != path.ray).then_some(Class::Wrong),
            Some(before) => leaves(ray, &path.steps[before]),
        };
        findings.judge_class(Aspect::Origin, call, class, 1.0, || {
            let from = i
                .checked_sub(1)
                .map_or("the first ray, unchanged".into(), |i| {
                    let p = show(path.steps[i].p.into());
                    format!("an origin that Surface::leave returns at {p}, and the whole range")
                });
            let from_o = i
                .checked_sub(1)
                .map_or(path.ray.o, |before| path.steps[before].p);
            Message::new(format!(
                "your result: ray {i} starts at {} with t in [{:?}, {:?}]; expected: {from}",
                show(ray.o.into()),
                ray.min_t,
                ray.max_t
            ))
            .compares(ray.o, from_o)
            .asked(about())
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
    findings: &mut Findings,
    call: usize,
    answer: &PathAnswer,
    Right { direct: wanted, .. }: &Right,
    about: &impl Fn() -> String,
) {
    findings.expect(Aspect::Questions);
    let pairs = answer.direct.iter().zip(wanted);
    let same = answer.direct.len() == wanted.len()
        && pairs.into_iter().all(|((i, wo), (j, right))| {
            i == j && (Vec3::from(*wo) - Vec3::from(*right)).length() < PLACE_BOUND
        });
    findings.judge(Aspect::Questions, call, same, 1.0, || {
        let calls = |of: &[(u32, Xyz)]| {
            let each = of.iter();
            all_or_none(each.map(|(i, wo)| format!("surface {i} with wo = {}", point(*wo))))
        };
        let numbers = |(i, wo): &(u32, Xyz)| [f64::from(*i), wo[0], wo[1], wo[2]];
        Message::new(format!(
            "your calls of direct: {}; expected: {}",
            calls(&answer.direct),
            calls(wanted)
        ))
        .compares(
            answer.direct.iter().flat_map(numbers),
            wanted.iter().flat_map(numbers),
        )
        .asked(about())
    });
}
