//! Judging a walk through a tree in a world whose answers are written down.

use crate::hits;
use crate::tally::{Aspect, Class, Tally};
use std::collections::BTreeMap;
use wire::answer::TraverseAnswer;
use wire::work::{NodeKind, Ray, ScriptedRay, ScriptedWorld, Tree};

/// A traversal may make this many times the tests of one that takes children as they come, from
/// left to right or from right to left, on rays of which half run one way and half the other. Going
/// farther-first or everywhere makes twice as many.
const WORK_FACTOR: f64 = 1.5;

/// Judges the answers of `intersect_bvh` or `occludes_bvh`; with `counts_work` also the number of
/// tests.
pub(crate) fn traverse(
    tally: &mut Tally,
    world: &ScriptedWorld,
    answers: &[TraverseAnswer],
    counts_work: bool,
) {
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        if world.any_hit {
            any(tally, call, scripted, answer);
        } else {
            closest(tally, call, scripted, answer);
        }
    }
    if counts_work {
        tally.expect(Aspect::Work);
        // Whoever does not find the hits is soon done.
        if tally.is_right(Aspect::Decision) {
            work(tally, world, answers);
        }
    }
}

/// The hits in the ray's range: primitive and `t`.
fn in_range(scripted: &ScriptedRay) -> impl Iterator<Item = (u32, f64)> {
    let Ray { min_t, max_t, .. } = scripted.ray;
    let met = (0..).zip(&scripted.prims);
    met.filter_map(|(id, &t)| Some((id, t?)))
        .filter(move |&(_, t)| min_t <= t && t <= max_t)
}

fn closest(tally: &mut Tally, call: usize, scripted: &ScriptedRay, answer: &TraverseAnswer) {
    let right = in_range(scripted).min_by(|a, b| a.1.total_cmp(&b.1));
    tally.expect(Aspect::Decision);
    tally.expect(Aspect::RayAfter);
    if right.is_some() {
        tally.expect(Aspect::T);
        tally.expect(Aspect::Primitive);
    }
    let decided = right.is_some() == answer.hit.is_some();
    let class = hits::decision_class(decided, answer.hit.is_some());
    tally.judge_class(Aspect::Decision, call, class, 1.0, || {
        let said = match right {
            Some((id, t)) => format!("intersect_bvh says miss; primitive {id} is hit at t = {t}"),
            None => "intersect_bvh says hit; nothing is hit".into(),
        };
        format!("{said}.{} {}", asked(answer), hits::show_ray(&scripted.ray))
    });
    if let (Some((id, t)), Some((given_t, given))) = (right, answer.hit) {
        let off = (given_t - t).abs();
        tally.judge(Aspect::T, call, given_t == t, off, || {
            format!(
                "intersect_bvh gives primitive {given} at t = {given_t}; the closest is primitive {id} at t = {t}.{} {}",
                asked(answer),
                hits::show_ray(&scripted.ray)
            )
        });
        let is_there = in_range(scripted).any(|(id, at)| id == given && at == t);
        tally.judge(Aspect::Primitive, call, is_there, 1.0, || {
            format!(
                "intersect_bvh gives primitive {given}; at t = {t} is primitive {id}. {}",
                hits::show_ray(&scripted.ray)
            )
        });
    }
    let hit_t = answer.hit.map(|(t, _)| t);
    let mut call = hits::Call {
        tally,
        number: call,
        function: "intersect_bvh",
        ray: &scripted.ray,
    };
    call.ray_after(hit_t, &answer.ray_after);
}

fn any(tally: &mut Tally, call: usize, scripted: &ScriptedRay, answer: &TraverseAnswer) {
    let blocker = in_range(scripted).next();
    tally.expect(Aspect::Decision);
    let decided = blocker.is_some() == answer.hit.is_some();
    let class = hits::decision_class(decided, answer.hit.is_some());
    tally.judge_class(Aspect::Decision, call, class, 1.0, || {
        let said = match blocker {
            Some((id, t)) => {
                format!("occludes_bvh says no; primitive {id} is in the way at t = {t}")
            }
            None => "occludes_bvh says yes; nothing is in the way".into(),
        };
        format!("{said}.{} {}", asked(answer), hits::show_ray(&scripted.ray))
    });
}

/// What is odd about the questions, if anything.
fn asked(answer: &TraverseAnswer) -> String {
    if answer.unknown_boxes > 0 {
        return format!(
            " It asked for {} boxes that are no node's: ask with the node's own bounds.",
            answer.unknown_boxes
        );
    }
    if answer.repeated_prims > 0 {
        return format!(
            " It asked {} primitives more than once.",
            answer.repeated_prims
        );
    }
    String::new()
}

/// Tests of many rays.
#[derive(Clone, Copy, Debug, Default)]
struct Tests {
    boxes: u64,
    prims: u64,
}

/// Judges the number of tests, for the rays along each axis apart.
fn work(tally: &mut Tally, world: &ScriptedWorld, answers: &[TraverseAnswer]) {
    let function = if world.any_hit {
        "occludes_bvh"
    } else {
        "intersect_bvh"
    };
    let orders = [
        left_to_right(&world.tree, false),
        left_to_right(&world.tree, true),
    ];
    let mut by_axis: BTreeMap<usize, Made> = BTreeMap::new();
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        let axis = kit::Vec3::from(scripted.ray.d).abs().max_position();
        let made = by_axis.entry(axis).or_insert_with(|| Made::since(call));
        made.tests.boxes += u64::from(answer.box_tests);
        made.tests.prims += u64::from(answer.prim_tests);
        made.hits += u64::from(answer.prim_hits);
        made.could_hit += in_range(scripted).count() as u64;
        for order in &orders {
            let tests = plain_tests(world, order, scripted);
            made.twice_plain.boxes += tests.boxes;
            made.twice_plain.prims += tests.prims;
        }
    }
    for made in by_axis.into_values() {
        let Made {
            call,
            tests,
            twice_plain,
            ..
        } = made;
        let mut count = |what: &str, tests: u64, twice_plain: u64| {
            let plain = twice_plain as f64 / 2.0;
            let times = tests as f64 / plain;
            let class = (times > WORK_FACTOR).then(|| made.why(times));
            tally.judge_class(Aspect::Work, call, class, times, || {
                format!(
                    "{function} makes {tests} {what} tests where taking children as they come makes {plain:.0} (up to {WORK_FACTOR} times that is fine). {}",
                    hits::show_ray(&world.rays[call].ray)
                )
            });
        };
        count("box", tests.boxes, twice_plain.boxes);
        count("primitive", tests.prims, twice_plain.prims);
        tally.judge(Aspect::Work, call, tests.boxes > 0, f64::INFINITY, || {
            format!(
                "{function} never asks about a box: ask world.hit_box before going below a node"
            )
        });
    }
}

/// What was made of all rays along an axis.
struct Made {
    /// The first of them.
    call: usize,
    tests: Tests,
    /// What taking children as they come makes of them, from the left and from the right together.
    twice_plain: Tests,
    /// Primitives that were hit when they were asked for.
    hits: u64,
    /// Primitives that are hit in the rays' ranges.
    could_hit: u64,
}

impl Made {
    fn since(call: usize) -> Made {
        Made {
            call,
            tests: Tests::default(),
            twice_plain: Tests::default(),
            hits: 0,
            could_hit: 0,
        }
    }

    /// The class of too many tests: going to the farther child first, or on after a hit, finds all
    /// that is hit; not cutting boxes off at a hit finds no more than the nearest.
    fn why(&self, times: f64) -> Class {
        match self.hits as f64 / self.could_hit.max(1) as f64 {
            ALL_FROM.. => Class::Named("finds all that is hit"),
            MANY_FROM.. => Class::Named("finds much of what is hit"),
            _ => Class::of_size(times),
        }
    }
}

/// From this share on, all of what is hit was found,
const ALL_FROM: f64 = 0.9;

/// from this one on, much of it.
const MANY_FROM: f64 = 0.25;

/// All nodes, each before what is below it, left before right or `mirrored`.
fn left_to_right(tree: &Tree, mirrored: bool) -> Vec<usize> {
    let mut order = Vec::new();
    let mut next = Vec::from_iter((!tree.nodes.is_empty()).then_some(0));
    while let Some(at) = next.pop() {
        order.push(at);
        if let NodeKind::Interior { left, right } = tree.nodes[at].kind {
            let (first, second) = if mirrored {
                (right, left)
            } else {
                (left, right)
            };
            next.extend([second as usize, first as usize]);
        }
    }
    order
}

/// The tests that a traversal makes which takes the nodes in this `order` and skips what is out of
/// range: no walk is needed to count them. A node is entered exactly if its box is met before the
/// closest hit among all primitives that come earlier in the order; for any hit, if none of those
/// is a hit.
fn plain_tests(world: &ScriptedWorld, order: &[usize], scripted: &ScriptedRay) -> Tests {
    let tree = &world.tree;
    let mut tests = Tests { boxes: 1, prims: 0 };
    let mut max_t = scripted.ray.max_t;
    for &at in order {
        let entered = scripted.spans[at]
            .is_some_and(|[enters, leaves]| enters <= max_t && leaves >= scripted.ray.min_t);
        let NodeKind::Leaf { first, count } = tree.nodes[at].kind else {
            tests.boxes += if entered { 2 } else { 0 };
            continue;
        };
        let prims = &tree.order[first as usize..first as usize + count as usize];
        tests.prims += if entered { u64::from(count) } else { 0 };
        let met = prims.iter().filter_map(|&id| scripted.prims[id as usize]);
        let hit = met
            .filter(|&t| scripted.ray.min_t <= t)
            .fold(f64::INFINITY, f64::min);
        if hit <= max_t && world.any_hit {
            return tests;
        }
        max_t = max_t.min(hit);
    }
    tests
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::tally::Finding;
    use wire::Work;

    fn script(name: &str) -> ScriptedWorld {
        let spec = cases::all(0)
            .into_iter()
            .find(|spec| spec.is("part2.task3", name));
        match spec.map(|spec| spec.work) {
            Some(Work::Traverse(world)) => world,
            other => panic!("{name} is {other:?}"),
        }
    }

    /// What code answers that asks all primitives: right, with `box_tests` and `prim_tests` each
    /// ray.
    fn right(world: &ScriptedWorld, box_tests: u32, prim_tests: u32) -> Vec<TraverseAnswer> {
        let each = world.rays.iter();
        each.map(|scripted| {
            let closest = in_range(scripted).min_by(|a, b| a.1.total_cmp(&b.1));
            let max_t = closest.map_or(scripted.ray.max_t, |(_, t)| t);
            TraverseAnswer {
                hit: closest.map(|(id, t)| (t, id)),
                ray_after: Ray {
                    max_t,
                    ..scripted.ray
                },
                box_tests,
                prim_tests,
                prim_hits: 1,
                repeated_prims: 0,
                unknown_boxes: 0,
            }
        })
        .collect()
    }

    fn failed(world: &ScriptedWorld, answers: &[TraverseAnswer], counts_work: bool) -> Vec<Aspect> {
        let mut tally = Tally::default();
        traverse(&mut tally, world, answers, counts_work);
        let findings = tally.into_findings();
        let failed = findings.iter().filter(|finding| !finding.passed());
        failed.map(|finding: &Finding| finding.aspect).collect()
    }

    #[test]
    fn right_answers_pass() {
        for name in [
            "both_children",
            "box_in_box",
            "ties",
            "rounded_boxes",
            "deep_tree",
        ] {
            let world = script(name);
            assert_eq!(failed(&world, &right(&world, 9, 9), false), [], "{name}");
        }
    }

    #[test]
    fn the_farther_hit_loses_t() {
        let world = script("box_in_box");
        let mut answers = right(&world, 9, 9);
        let (scripted, answer) = (&world.rays[0], &mut answers[0]);
        let farthest = in_range(scripted).max_by(|a, b| a.1.total_cmp(&b.1));
        answer.hit = farthest.map(|(id, t)| (t, id));
        answer.ray_after.max_t = farthest.map_or(0.0, |(_, t)| t);
        assert_eq!(
            failed(&world, &answers, false),
            [Aspect::T, Aspect::Primitive]
        );
    }

    #[test]
    fn a_ray_that_keeps_its_range_loses_only_that() {
        let world = script("both_children");
        let mut answers = right(&world, 9, 9);
        for (scripted, answer) in world.rays.iter().zip(&mut answers) {
            answer.ray_after = scripted.ray;
        }
        assert_eq!(failed(&world, &answers, false), [Aspect::RayAfter]);
    }

    /// 256 layers have 511 nodes; half of the rays should see few of them.
    #[test]
    fn going_everywhere_or_nowhere_loses_work() {
        let world = script("nearer_first");
        assert_eq!(failed(&world, &right(&world, 270, 130), true), []);
        assert_eq!(
            failed(&world, &right(&world, 511, 130), true),
            [Aspect::Work]
        );
        assert_eq!(failed(&world, &right(&world, 0, 130), true), [Aspect::Work]);
        assert_eq!(
            failed(&world, &right(&world, 270, 256), true),
            [Aspect::Work]
        );
    }

    #[test]
    fn what_is_found_on_the_way_tells_why_too_much_is_asked() {
        let world = script("nearer_first");
        let class = |prim_hits: u32| {
            let mut answers = right(&world, 511, 256);
            for answer in &mut answers {
                answer.prim_hits = prim_hits;
            }
            let mut tally = Tally::default();
            traverse(&mut tally, &world, &answers, true);
            let findings = tally.into_findings();
            let work = findings.iter().find(|finding| !finding.passed());
            work.map(|finding| finding.faults[0].class)
        };
        assert_eq!(class(256), Some(Class::Named("finds all that is hit")));
        assert_eq!(class(128), Some(Class::Named("finds much of what is hit")));
        assert!(matches!(class(1), Some(Class::Off(_))));
    }
}
