//! The worst answer as a Rust test: to paste into a stage's `tests/` folder, run in a debugger, keep.
//!
//! It fails on the code that gave the answer and passes on any that earns the points. One file for each kind of work:
//! `camera` and `pixel`, `hits` (triangles and spheres), `boxes`, `tree` and
//! `traverse`, `light` (matte and smooth surfaces, roulette) and `stop` (when a pixel has had enough).

mod boxes;
mod camera;
mod hits;
mod light;
mod numbers;
mod pixel;
mod stop;
mod traverse;
mod tree;

use crate::Tier;
use crate::cases::Spec;
use crate::tally::{Aspect, Finding};
use std::fmt::Write;
use wire::Work;

/// A case that lost points, and why.
#[derive(Clone, Copy, Debug)]
pub struct FailedCase<'a> {
    /// Name of the case.
    pub name: &'a str,
    /// What its points are for.
    pub tier: Tier,
    /// What is wrong.
    pub findings: &'a [Finding],
}

/// A test for the worst answer of a task's failed cases, core points first. `None` if no answer fits in a short test.
pub fn worst<'a>(
    failed: impl IntoIterator<Item = FailedCase<'a>>,
    specs: &[Spec],
    task: &str,
) -> Option<String> {
    let mut failed: Vec<FailedCase<'a>> = failed.into_iter().collect();
    failed.sort_by_key(|case| case.tier == Tier::Robust);
    let found = failed.into_iter().find_map(|case| {
        let spec = specs.iter().find(|spec| spec.is(task, case.name))?;
        let worst = case
            .findings
            .iter()
            .filter_map(|finding| finding.worst.as_ref().map(|worst| (finding.aspect, worst)));
        worst
            .filter(|(aspect, _)| can_show(&spec.work, *aspect))
            .find_map(|(_, worst)| test(spec, case.tier, worst.call as usize))
    });
    found.map(|test| as_file(task, &test))
}

/// The test as a file of a stage's `tests/` folder, where the compiler asks for a comment at the top.
pub fn as_file(task: &str, test: &str) -> String {
    format!("//! The worst answer of {task}, as the grader saw it.\n\n{test}")
}

/// Whether a test of one call asks for the aspect: none of a tree or a walk through one asks what it costs, and none of
/// light asks what only many calls show.
fn can_show(work: &Work, aspect: Aspect) -> bool {
    match work {
        Work::Build { .. } | Work::Traverse(_) => aspect != Aspect::Work,
        Work::Lambert(_) | Work::Specular(_) | Work::Roulette(_) => {
            !matches!(aspect, Aspect::Spread | Aspect::Mean)
        }
        _ => true,
    }
}

/// A test for one call of a case.
pub fn test(spec: &Spec, tier: Tier, call: usize) -> Option<String> {
    let body = match &spec.work {
        Work::Triangles { triangles, probes } => {
            hits::triangle(tier, triangles, probes.get(call)?)?
        }
        Work::Spheres { spheres, probes } => hits::sphere(tier, spheres, probes.get(call)?)?,
        Work::CameraRays { cameras, sensor } if !sensor.is_empty() => camera::ray(
            cameras.get(call / sensor.len())?,
            sensor[call % sensor.len()],
        ),
        Work::Pixels(work) => pixel::samples(work, *work.pixels.get(call)?),
        Work::Boxes { boxes, probes } => boxes::interval(tier, boxes, probes.get(call)?)?,
        Work::BruteForce {
            triangles,
            spheres,
            rays,
        } => hits::first_of(tier, triangles, spheres, rays.get(call)?)?,
        Work::Build {
            bounds,
            max_leaf_size,
        } => tree::over(bounds, *max_leaf_size)?,
        Work::Traverse(world) => traverse::walk(world, call)?,
        Work::Lambert(probes) => light::matte(probes.get(call)?),
        Work::Specular(calls) => light::smooth(tier, calls.get(call)?),
        Work::Roulette(work) => light::game(work, call)?,
        Work::Stop(calls) => stop::plain(calls.get(call)?)?,
        Work::SureStop(calls) => stop::mended(calls.get(call)?)?,
        Work::AdaptivePixels(works) => stop::pixel(works.get(call)?)?,
        _ => return None,
    };
    let mut text = format!(
        "/// {}\n#[test]\nfn {}_{call}() {{\n",
        spec.about, spec.name
    );
    body.lines().for_each(|line| {
        let _ = writeln!(text, "    {line}");
    });
    text.push_str("}\n");
    Some(text)
}
