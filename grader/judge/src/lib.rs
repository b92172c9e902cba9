//! Judging: from what the student's code answered to what is right and wrong about it.
//!
//! [`judge`] picks the judge for the kind of work: `pixels` and `camera` for the rays of Part 1, `shapes` for
//! what they hit, with `hits` for a single hit record; `lambert`, `direct` (with `lamps` for what lights send), `specular`,
//! `paths` (with `games` for what roulette hears), `roulette` and `adaptive` (with `places` in the pixel) for light, with
//! `chance` for what only many samples show and `suspects` for what mistakes make of the same rays. `truths` keeps what
//! the oracle has said. [`tally`] counts aspect by aspect, [`errors`] tells how far off numbers are; [`expected`] is the
//! form in which truth comes.

pub(crate) mod adaptive;
mod boxes;
mod camera;
pub mod cases;
mod chance;
pub mod convert;
mod direct;
pub mod errors;
pub mod expected;
mod games;
mod hits;
pub(crate) mod lambert;
mod lamps;
mod numbers;
mod paths;
mod pixels;
mod places;
mod plural;
pub mod repro;
pub(crate) mod roulette;
pub mod scene;
mod shapes;
pub mod snapshot;
pub(crate) mod specular;
mod suspects;
pub mod tally;
mod tier;
mod traverse;
mod tree;
pub mod truth;
pub mod truths;

pub use plural::plural;
pub use tier::Tier;

use cases::Spec;
use tally::{Finding, Tally};
use wire::{Answer, Work};

/// What is right and wrong about `answer` to the case `spec`, which gives points of `tier`: core points ask
/// of rounding errors what textbook code can give, robust points what stable code can.
pub fn judge(spec: &Spec, tier: Tier, answer: &Answer) -> Vec<Finding> {
    let mut tally = Tally::default();
    match (&spec.work, answer) {
        (Work::Pixels(work), Answer::Pixels(answers)) => pixels::pixels(&mut tally, work, answers),
        (Work::CameraRays { cameras, sensor }, Answer::CameraRays(answers)) => {
            camera::rays(&mut tally, tier, cameras, sensor, answers);
        }
        (Work::Triangles { probes, .. }, Answer::Triangles(answers)) => {
            let expected = spec.truths.of_shapes(spec, tier);
            shapes::triangles(&mut tally, probes, expected, answers);
        }
        (Work::Spheres { probes, .. }, Answer::Spheres(answers)) => {
            let expected = spec.truths.of_shapes(spec, tier);
            shapes::spheres(&mut tally, probes, expected, answers);
        }
        (Work::BruteForce { rays, .. }, Answer::Hits(answer)) => {
            let expected = spec.truths.of_shapes(spec, tier);
            shapes::brute_force(&mut tally, rays, expected, answer);
        }
        (
            Work::Boxes {
                boxes: shapes,
                probes,
            },
            Answer::Boxes(answers),
        ) => boxes::boxes(&mut tally, tier, shapes, probes, answers),
        (
            Work::Build {
                bounds,
                max_leaf_size,
            },
            Answer::Build(answer),
        ) => {
            let recorded = cases::recorded::tree(spec.name);
            tree::build(&mut tally, bounds, *max_leaf_size, answer, recorded);
        }
        (
            Work::SceneHits {
                scene,
                rays,
                any_hit,
                ..
            },
            Answer::Hits(answer),
        ) => {
            let truths = spec.truths.of_scene(scene, rays);
            scene::hits(&mut tally, tier, truths, rays, *any_hit, answer);
        }
        (Work::Traverse(world), Answer::Traverse(answers)) => {
            let counts_work = cases::part2_task3::counts_work(spec.name);
            traverse::traverse(&mut tally, world, answers, counts_work);
        }
        (Work::Lambert(probes), Answer::Lambert(answers)) => {
            lambert::lambert(&mut tally, probes, answers);
        }
        (Work::Direct(work), Answer::Direct(answers)) => direct::direct(&mut tally, work, answers),
        (Work::Specular(calls), Answer::Specular(answers)) => {
            specular::specular(&mut tally, tier, calls, answers);
        }
        (Work::Paths(paths), Answer::Paths(answers)) => paths::paths(&mut tally, paths, answers),
        (Work::Roulette(work), Answer::Roulette(answers)) => {
            roulette::roulette(&mut tally, work, answers);
        }
        (Work::Stop(calls), Answer::Stop(answers)) => adaptive::stop(&mut tally, calls, answers),
        (Work::SureStop(calls), Answer::Stop(answers)) => {
            adaptive::sure_stop(&mut tally, calls, answers);
        }
        (Work::AdaptivePixels(works), Answer::AdaptivePixels(answers)) => {
            adaptive::pixels(&mut tally, works, answers);
        }
        _ => unreachable!("the worker answers each kind of work with its own kind of answer"),
    }
    let mut findings = tally.into_findings();
    let is_about = |finding: &Finding| {
        spec.about_aspects.is_empty() || spec.about_aspects.contains(&finding.aspect)
    };
    findings.retain(is_about);
    findings
}
