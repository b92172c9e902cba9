//! Judges paths: the traced rays, the calls of other functions, and the radiance.

use super::draws;
use super::throughput;
use super::truth::Right;
use crate::plural;
use crate::tools::aspects::hits::show;
use crate::tools::aspects::numbers;
use crate::tools::call_text::{all_or_none, material, point};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::{Frame, Vec3};
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
        direct(findings, call, path, answer, &right, &about);
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
    let is_whole = ray.min_t == 0.0 && ray.max_t == f64::INFINITY;
    if off.is_nan() || off.length() > PLACE_BOUND {
        Some(Class::of_offset(off.length(), off.length()))
    } else if !is_whole {
        Some(Class::Named("another range"))
    } else if off == Vec3::ZERO {
        Some(Class::of_offset(0.0, 0.0))
    } else {
        (off.dot(n) * d.dot(n) <= 0.0).then_some(Class::Negated)
    }
}

/// The class of wrong calls of `direct`: all in the local space, all along the ray, or others.
/// `None` if they are right.
fn class_of_calls(
    path: &ScriptedPath,
    called: &[(u32, Xyz)],
    wanted: &[(u32, Xyz)],
) -> Option<Class> {
    let all = |other: &dyn Fn(&Step, Vec3) -> Vec3| {
        let mut pairs = called.iter().zip(wanted);
        let is_other = |((i, wo), (j, right)): (&(u32, Xyz), &(u32, Xyz))| {
            let other = other(&path.steps[*j as usize], Vec3::from(*right));
            i == j && (Vec3::from(*wo) - other).length() < PLACE_BOUND
        };
        called.len() == wanted.len() && pairs.all(is_other)
    };
    if all(&|_, wo| wo) {
        None
    } else if all(&|_, wo| -wo) {
        Some(Class::Named("along the ray"))
    } else if all(&|step, wo| Frame::around(step.n.into()).to_local(wo)) {
        Some(Class::Named("in the local space"))
    } else {
        Some(Class::Wrong)
    }
}

/// Judges the calls of `direct`: one at every surface except mirrors and glass.
fn direct(
    findings: &mut Findings,
    call: usize,
    path: &ScriptedPath,
    answer: &PathAnswer,
    Right { direct: wanted, .. }: &Right,
    about: &impl Fn() -> String,
) {
    findings.expect(Aspect::Questions);
    let class = class_of_calls(path, &answer.direct, wanted);
    findings.judge_class(Aspect::Questions, call, class, 1.0, || {
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

#[cfg(test)]
mod tests {
    use super::*;
    use wire::Work;

    fn path() -> ScriptedPath {
        let specs = crate::tasks::part4_task2::cases::cases(0).into_iter();
        let mut paths = specs.filter_map(|spec| match spec.work {
            Work::Paths(paths) => paths.into_iter().find(|path| path.steps.len() > 1),
            _ => None,
        });
        paths.next().expect("a case has a path of two surfaces")
    }

    #[test]
    fn wrong_origins_have_classes_of_their_own() {
        let step = path().steps[0];
        let (p, n) = (Vec3::from(step.p), Vec3::from(step.n));
        let moved = |offset: Vec3| Ray {
            o: (p + offset).into(),
            d: step.n,
            min_t: 0.0,
            max_t: f64::INFINITY,
        };
        let class = |offset: Vec3| leaves(&moved(offset), &step);
        assert_eq!(class(1e-12 * n), None);
        assert_eq!(class(-1e-12 * n), Some(Class::Negated));
        assert_eq!(
            class(Vec3::ZERO),
            Some(Class::Named("at the surface itself"))
        );
        let late = Ray {
            min_t: 1e-3,
            ..moved(Vec3::ZERO)
        };
        assert_eq!(leaves(&late, &step), Some(Class::Named("another range")));
    }

    #[test]
    fn a_local_wo_is_told_from_one_along_the_ray() {
        let path = path();
        let n = path.steps[0].n;
        let wo = Frame::around(n.into()).to_world(Vec3::new(0.6, 0.0, 0.8));
        let class = |called: Vec3| class_of_calls(&path, &[(0, called.into())], &[(0, wo.into())]);
        assert_eq!(class(wo), None);
        assert_eq!(class(-wo), Some(Class::Named("along the ray")));
        assert_eq!(
            class(Vec3::new(0.6, 0.0, 0.8)),
            Some(Class::Named("in the local space"))
        );
        assert_eq!(class(n.into()), Some(Class::Wrong));
    }
}
