//! Judging: from what the student's code answered to what is right and wrong about it.
//!
//! [`judge`] picks the judge for the kind of work; [`tally`] counts aspect by aspect; [`expected`] is the
//! form in which truth comes.

mod boxes;
pub mod expected;
mod hits;
mod shapes;
pub mod tally;
mod traverse;
mod tree;

use crate::cases::{self, Spec};
use crate::course::Tier;
use crate::truth;
use tally::{Finding, Tally};
use wire::{Answer, Work};

/// What is right and wrong about `answer` to the case `spec`, which gives points of `tier`: core points ask
/// of rounding errors what textbook code can give, robust points what stable code can.
pub fn judge(spec: &Spec, tier: Tier, answer: &Answer) -> Vec<Finding> {
    let mut tally = Tally::default();
    match (&spec.work, answer) {
        (Work::Triangles { triangles, probes }, Answer::Triangles(answers)) => {
            shapes::triangles(
                &mut tally,
                probes,
                |probe| truth::triangle(tier, &triangles[probe.shape as usize], &probe.ray),
                answers,
            );
        }
        (Work::Spheres { spheres, probes }, Answer::Spheres(answers)) => {
            shapes::spheres(
                &mut tally,
                probes,
                |probe| truth::sphere(tier, &spheres[probe.shape as usize], &probe.ray),
                answers,
            );
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
        (Work::Traverse(world), Answer::Traverse(answers)) => {
            let counts_work = cases::part2_task3::counts_work(spec.name);
            traverse::traverse(&mut tally, world, answers, counts_work);
        }
        _ => unreachable!("the worker answers each kind of work with its own kind of answer"),
    }
    tally.into_findings()
}
