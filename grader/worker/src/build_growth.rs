//! Times `construct_bvh` over ever more primitives.

use kit::{Aabb, PixelSampler};
use wire::answer::BuildGrowthAnswer;
use wire::work::BuildGrowthWork;

/// Builds the sizes in turn, round by round, so that a change of the machine's speed affects all of
/// them. Processor time is measured, so that waiting for a processor does not count.
pub(crate) fn build(work: &BuildGrowthWork) -> BuildGrowthAnswer {
    let mut answer = BuildGrowthAnswer {
        nodes: Vec::new(),
        seconds: Vec::new(),
    };
    for size in &work.sizes {
        let (nodes, seconds) = one(work, *size);
        answer.nodes.push(nodes);
        answer.seconds.push(seconds);
        if answer.seconds.len() >= 2 && 1e3 * seconds > work.enough_ms as f64 {
            break;
        }
    }
    for _ in 1..work.rounds {
        for (size, fastest) in work.sizes.iter().zip(&mut answer.seconds) {
            *fastest = fastest.min(one(work, *size).1);
        }
    }
    answer
}

/// The number of nodes of a tree over `size` primitives, and the seconds to build it.
fn one(work: &BuildGrowthWork, size: u32) -> (u32, f64) {
    let boxes = cloud(size);
    let before = harness::code_time();
    let tree = bvh::construct_bvh(&boxes, work.max_leaf_size as usize);
    let seconds = harness::code_time().saturating_sub(before).as_secs_f64();
    (u32::try_from(tree.nodes.len()).unwrap_or(u32::MAX), seconds)
}

/// Small boxes at random points of the unit cube.
fn cloud(size: u32) -> Vec<Aabb> {
    let mut sampler = PixelSampler::new(size, 0, 0);
    let half = 0.25 / f64::from(size.max(1)).cbrt();
    let mut one = || {
        let center = sampler.next_2d().extend(sampler.next_1d());
        Aabb {
            min: center - half,
            max: center + half,
        }
    };
    (0..size).map(|_| one()).collect()
}
