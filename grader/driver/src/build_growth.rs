//! Times `construct_bvh` over ever more primitives, beside a control.

use kit::{Aabb, Bvh, PixelSampler};
use std::hint::black_box;
use wire::answer::{BuildGrowthAnswer, BuildTime};
use wire::work::BuildGrowthWork;

/// Trees over fewer primitives are built [`REPEATS`] times in a round, because they take only
/// milliseconds.
const FEW: u32 = 20_000;

/// Of so many builds of a small tree the fastest counts.
const REPEATS: u32 = 3;

/// Builds the sizes in turn, round by round, each between two runs of the control: whatever slows
/// the machine down for a while slows both. There is no other round after one in which the largest
/// tree was built fast.
pub fn time_builds(
    work: &BuildGrowthWork,
    construct: impl Fn(&[Aabb], usize) -> Bvh,
) -> BuildGrowthAnswer {
    let mut answer = BuildGrowthAnswer {
        nodes: Vec::new(),
        rounds: Vec::new(),
    };
    let mut sizes = work.sizes.as_slice();
    for round in 0..work.rounds {
        let mut times: Vec<BuildTime> = Vec::new();
        for &size in sizes {
            let build = |boxes: &[Aabb]| construct(boxes, work.max_leaf_size as usize);
            let (nodes, time) = one(size, work.fast, build);
            times.push(time);
            if round == 0 {
                answer.nodes.push(nodes);
            }
            if round == 0 && times.len() >= 2 && !time.is_within(work.enough) {
                break;
            }
        }
        sizes = &work.sizes[..times.len()];
        let is_fast = times.last().is_some_and(|time| time.is_within(work.fast));
        answer.rounds.push(times);
        if is_fast {
            break;
        }
    }
    answer
}

/// The number of nodes of a tree over `size` primitives, and the times. After a build that is fast
/// beside the first control, no second one is needed.
fn one(size: u32, fast: f64, construct: impl Fn(&[Aabb]) -> Bvh) -> (u32, BuildTime) {
    let boxes = cloud(size);
    let mut nodes = 0;
    let mut least = [f64::INFINITY; 3];
    for _ in 0..if size < FEW { REPEATS } else { 1 } {
        let before = seconds(|| control(&boxes));
        let build = seconds(|| nodes = construct(&boxes).nodes.len());
        let after = match build <= fast * before {
            true => before,
            false => seconds(|| control(&boxes)),
        };
        for (least, time) in least.iter_mut().zip([before, build, after]) {
            *least = least.min(time);
        }
    }
    let [before, seconds, after] = least;
    let time = BuildTime {
        seconds,
        control: [before, after],
    };
    (u32::try_from(nodes).unwrap_or(u32::MAX), time)
}

fn seconds(run: impl FnOnce()) -> f64 {
    let before = harness::code_time();
    run();
    harness::code_time().saturating_sub(before).as_secs_f64()
}

/// The work of a slow build in O(n log² n), without building anything: at each level sorts parts of
/// a list by something of their boxes, and copies the list twice. It sorts by scrambled bits, which
/// puts nothing near anything.
fn control(boxes: &[Aabb]) {
    const SCRAMBLE: u64 = 0x9e37_79b9_7f4a_7c15;
    let mut list: Vec<usize> = (0..boxes.len()).collect();
    let mut part = list.len();
    while part > 4 {
        let axis = part % 3;
        let key = |i: &usize| boxes[*i].centroid()[axis].to_bits().wrapping_mul(SCRAMBLE);
        for part in list.chunks_mut(part) {
            part.sort_by_key(key);
        }
        black_box((list.clone(), list.clone()));
        part = part.div_ceil(2);
    }
    black_box(list);
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
