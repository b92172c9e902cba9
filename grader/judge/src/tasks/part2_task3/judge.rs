//! Judges a traversal of a tree in a scripted world, whose test results are given.

use crate::plural;
use crate::tools::aspects::hits;
use crate::tools::findings::{Aspect, Class, Findings, Message};
use crate::tools::truth::tree_tests::{ANY_HIT_WORK_FACTOR, Tests, TracedRay, WORK_FACTOR};
use std::collections::BTreeMap;
use wire::answer::TraverseAnswer;
use wire::work::{NodeKind, Ray, ScriptedRay, ScriptedWorld, Tree};

/// Savings are judged if a traversal that enters every box that a ray meets makes fewer than
/// 1 / `MIN_SAVINGS` of the primitive tests that there are without a tree.
const MIN_SAVINGS: u64 = 4;

/// A traversal may make at most this many times the tests of a traversal that enters exactly the
/// boxes that the ray meets.
const SAVINGS_FACTOR: f64 = 3.0;

/// For a single ray, a traversal may test each box twice: when it finds the box and, because a hit
/// may have shortened the ray since, when it visits the box. Over many rays both are seldom needed.
const BOX_FACTOR_OF_ONE_RAY: f64 = 2.0;

/// Judges the results of `intersect_bvh` or `occludes_bvh`; with `counts_work` also the number of
/// tests, else whether the boxes save tests. Tests that repeat others are always judged.
pub(crate) fn traverse(
    findings: &mut Findings,
    world: &ScriptedWorld,
    answers: &[TraverseAnswer],
    counts_work: bool,
) {
    findings.count_for(function(world));
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        if world.any_hit {
            any(findings, call, scripted, answer);
        } else {
            closest(findings, call, scripted, answer);
        }
    }
    if counts_work {
        findings.expect(Aspect::Work);
    } else {
        savings(findings, world, answers);
    }
    if is_leaf(&world.tree) {
        beside_the_root(findings, world, answers);
    }
    if answers.iter().any(|answer| answer.repeated_prims > 0) {
        // The repeated tests explain the number of tests, which is not judged again.
        repeated(findings, world, answers);
    } else if counts_work && findings.is_right(Aspect::HitOrMiss) {
        // A traversal that misses hits makes fewer tests, so its number is not judged.
        work(findings, world, answers);
    }
}

/// Whether the root of the tree is a leaf.
fn is_leaf(tree: &Tree) -> bool {
    let root = tree.nodes.first();
    root.is_some_and(|root| matches!(root.kind, NodeKind::Leaf { .. }))
}

/// Judges that the box of a root that is a leaf is tested before its primitives: a ray that misses
/// this box tests no primitive.
fn beside_the_root(findings: &mut Findings, world: &ScriptedWorld, answers: &[TraverseAnswer]) {
    findings.expect(Aspect::Work);
    let function = function(world);
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        let met = traced(world, scripted, |ray| ray.all_met());
        let tests = answer.prim_tests;
        let saves = met.prims > 0 || tests == 0;
        findings.judge(Aspect::Work, call, saves, f64::from(tests), || {
            let tests = plural(tests, "primitive test", "primitive tests");
            Message::new(format!(
                "your result: {function} makes {tests}; expected: none, since the ray misses the box of the root. Is it tested, too?"
            ))
            .asked(hits::show_ray(&scripted.ray))
        });
    }
}

/// Judges whether the boxes save tests: the traversal makes at most [`SAVINGS_FACTOR`] times the
/// tests of a traversal that enters every box that the ray meets. In a world where even that
/// traversal saves little, nothing is judged.
fn savings(findings: &mut Findings, world: &ScriptedWorld, answers: &[TraverseAnswer]) {
    let mut met = Tests::default();
    let mut made = Tests::default();
    let mut all = 0;
    for (scripted, answer) in world.rays.iter().zip(answers) {
        met += traced(world, scripted, |ray| ray.all_met());
        made += Tests {
            boxes: u64::from(answer.box_tests),
            prims: u64::from(answer.prim_tests),
        };
        all += scripted.prims.len() as u64;
    }
    if met.prims * MIN_SAVINGS >= all {
        return;
    }
    findings.expect(Aspect::Savings);
    let function = function(world);
    for (what, made, met) in [
        ("box", made.boxes, met.boxes),
        ("primitive", made.prims, met.prims),
    ] {
        let saves = made as f64 <= SAVINGS_FACTOR * met as f64;
        findings.judge(Aspect::Savings, 0, saves, made as f64, || {
            format!(
                "your result: {function} makes {}; entering only boxes that the ray meets makes {met}. Without a tree there are {all} primitive tests",
                plural(made, &format!("{what} test"), &format!("{what} tests"))
            )
        });
    }
}

/// Judges that no primitive is tested twice with the same ray; some of `answers` have such tests.
/// No tree of the cases holds a primitive twice.
fn repeated(findings: &mut Findings, world: &ScriptedWorld, answers: &[TraverseAnswer]) {
    let function = function(world);
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        let (tests, repeated) = (answer.prim_tests, answer.repeated_prims);
        let all = scripted.prims.len() as u32;
        // All primitives are tested, and the number of tests is a multiple of theirs.
        let is_whole_list = repeated + all == tests && tests.is_multiple_of(all);
        let class = (repeated > 0).then_some(match is_whole_list {
            true => Class::Named("all primitives in each leaf"),
            false => Class::Named("primitives tested again"),
        });
        findings.judge_class(Aspect::Work, call, class, f64::from(repeated), || {
            let ray = hits::show_ray(&scripted.ray);
            if is_whole_list {
                return Message::new(format!(
                    "your result: {function} tests all {all} primitives {} times; expected: in each leaf only its own, order[first .. first + count]",
                    tests / all
                ))
                .asked(ray);
            }
            Message::new(format!(
                "your result: {repeated} of {tests} primitive tests of {function} repeat one with the same ray; expected: none, since the tree holds each primitive once. Does each leaf test order[first .. first + count] only, and is each node visited once?"
            ))
            .asked(ray)
        });
    }
}

/// The function that is called.
fn function(world: &ScriptedWorld) -> &'static str {
    if world.any_hit {
        "occludes_bvh"
    } else {
        "intersect_bvh"
    }
}

/// The hits in the ray's range: primitive and `t`.
pub(super) fn in_range(scripted: &ScriptedRay) -> impl Iterator<Item = (u32, f64)> {
    let Ray { min_t, max_t, .. } = scripted.ray;
    let met = (0..).zip(&scripted.prims);
    met.filter_map(|(id, &t)| Some((id, t?)))
        .filter(move |&(_, t)| min_t <= t && t <= max_t)
}

fn closest(findings: &mut Findings, call: usize, scripted: &ScriptedRay, answer: &TraverseAnswer) {
    let right = in_range(scripted).min_by(|a, b| a.1.total_cmp(&b.1));
    findings.expect(Aspect::HitOrMiss);
    findings.expect(Aspect::RayAfter);
    if right.is_some() {
        findings.expect(Aspect::T);
        findings.expect(Aspect::Primitive);
    }
    let decided = right.is_some() == answer.hit.is_some();
    let class = hits::decision_class(decided, answer.hit.is_some());
    findings.judge_class(Aspect::HitOrMiss, call, class, 1.0, || {
        let results = match right {
            Some((id, t)) => format!("your result: miss; expected: primitive {id} at t = {t}"),
            None => "your result: hit; expected: miss".into(),
        };
        Message::new(format!("{results}{}", odd_tests(answer))).asked(hits::show_ray(&scripted.ray))
    });
    if let (Some((id, t)), Some((given_t, given))) = (right, answer.hit) {
        let off = (given_t - t).abs();
        let max_t_is_right = answer.ray_after.max_t == t;
        let class = (given_t != t).then(|| match max_t_is_right {
            true => Class::Named("max_t is right"),
            false => Class::of_size(off),
        });
        findings.judge_class(Aspect::T, call, class, off, || {
            let hint = if max_t_is_right {
                ". ray.max_t is right: is the hit returned that shortened the ray last?"
            } else {
                ""
            };
            Message::new(format!(
                "your result: primitive {given} at t = {given_t}; expected: primitive {id} at t = {t}{}{hint}",
                odd_tests(answer)
            ))
            .compares([given_t], [t])
            .asked(hits::show_ray(&scripted.ray))
        });
        let is_there = in_range(scripted).any(|(id, at)| id == given && at == t);
        findings.judge(Aspect::Primitive, call, is_there, 1.0, || {
            Message::new(format!(
                "your result: primitive {given}; expected: primitive {id} at t = {t}"
            ))
            .asked(hits::show_ray(&scripted.ray))
        });
    }
    let hit_t = answer.hit.map(|(t, _)| t);
    let mut call = hits::Call {
        findings,
        number: call,
        function: "intersect_bvh",
        ray: &scripted.ray,
    };
    let right_t = right.map(|(_, t)| t);
    call.ray_after(hit_t, &answer.ray_after, |max_t| {
        hit_t != right_t && max_t == right_t.unwrap_or(scripted.ray.max_t)
    });
}

fn any(findings: &mut Findings, call: usize, scripted: &ScriptedRay, answer: &TraverseAnswer) {
    let blocker = in_range(scripted).next();
    findings.expect(Aspect::HitOrMiss);
    let decided = blocker.is_some() == answer.hit.is_some();
    let class = hits::decision_class(decided, answer.hit.is_some());
    findings.judge_class(Aspect::HitOrMiss, call, class, 1.0, || {
        let results = match blocker {
            Some((id, t)) => {
                format!(
                    "your result: not occluded; expected: occluded by primitive {id} at t = {t}"
                )
            }
            None => "your result: occluded; expected: not occluded".into(),
        };
        Message::new(format!("{results}{}", odd_tests(answer))).asked(hits::show_ray(&scripted.ray))
    });
}

/// A sentence about tests of boxes that are no node's bounds, if the traversal made any.
fn odd_tests(answer: &TraverseAnswer) -> String {
    if answer.unknown_boxes > 0 {
        return format!(
            ". It tested {} boxes that are no node's bounds: pass the bounds of the node to hit_box",
            answer.unknown_boxes
        );
    }
    String::new()
}

/// Judges the number of tests, separately for the rays along each axis.
fn work(findings: &mut Findings, world: &ScriptedWorld, answers: &[TraverseAnswer]) {
    let function = function(world);
    let mut by_axis: BTreeMap<usize, AxisTotal> = BTreeMap::new();
    for (call, (scripted, answer)) in world.rays.iter().zip(answers).enumerate() {
        let axis = kit::Vec3::from(scripted.ray.d).abs().max_position();
        let total = by_axis
            .entry(axis)
            .or_insert_with(|| AxisTotal::since(call));
        total.rays += 1;
        total.tests.boxes += u64::from(answer.box_tests);
        total.tests.prims += u64::from(answer.prim_tests);
        total.hits += u64::from(answer.prim_hits);
        total.could_hit += in_range(scripted).count() as u64;
        traced(world, scripted, |ray| {
            total.left_first += ray.fixed_order(false);
            total.right_first += ray.fixed_order(true);
        });
    }
    let most = match world.any_hit {
        true => ANY_HIT_WORK_FACTOR,
        false => WORK_FACTOR,
    };
    for total in by_axis.into_values() {
        let (call, tests) = (total.call, total.tests);
        let of_rays = match total.rays {
            1 => String::new(),
            rays => format!(" for {rays} rays, of which the first is shown"),
        };
        let mut count = |what: &str, most: f64, of: fn(&Tests) -> u64| {
            let [tests, left, right] = [&tests, &total.left_first, &total.right_first].map(of);
            let plain = (left + right) as f64 / 2.0;
            let times = tests as f64 / plain;
            let class = (times > most).then(|| match total.why(times) {
                Class::Off(_) if what == "primitive" => Class::Named("too many primitive tests"),
                class => class,
            });
            findings.judge_class(Aspect::Work, call, class, times, || {
                Message::new(format!(
                    "your result: {function} makes {}{of_rays}; always the left child first makes {left}, always the right one {right}; expected: at most {most} times their mean, {}",
                    plural(tests, &format!("{what} test"), &format!("{what} tests")),
                    most * plain
                ))
                .asked(hits::show_ray(&world.rays[call].ray))
            });
        };
        let most_boxes = match total.rays {
            1 => most.max(BOX_FACTOR_OF_ONE_RAY),
            _ => most,
        };
        count("box", most_boxes, |tests| tests.boxes);
        count("primitive", most, |tests| tests.prims);
        let tests_boxes = tests.boxes > 0 || world.tree.nodes.is_empty();
        findings.judge(Aspect::Work, call, tests_boxes, f64::INFINITY, || {
            format!(
                "{function} makes no box test: call world.hit_box before visiting the children of a node"
            )
        });
    }
}

/// The totals over all rays along one axis.
struct AxisTotal {
    /// The number of the first ray along the axis.
    call: usize,
    rays: usize,
    /// The tests that the student's traversal made.
    tests: Tests,
    /// The tests of a traversal that always visits the left child first.
    left_first: Tests,
    /// The tests of a traversal that always visits the right child first.
    right_first: Tests,
    /// The number of primitive tests that were hits.
    hits: u64,
    /// The number of hits in the rays' ranges that there are to find.
    could_hit: u64,
}

impl AxisTotal {
    fn since(call: usize) -> AxisTotal {
        AxisTotal {
            call,
            rays: 0,
            tests: Tests::default(),
            left_first: Tests::default(),
            right_first: Tests::default(),
            hits: 0,
            could_hit: 0,
        }
    }

    /// The class of too many tests. A traversal that visits the farther child first, or does not
    /// stop at a hit, finds nearly all hits. A traversal that does not cull boxes at max_t finds
    /// only the nearest hits.
    fn why(&self, times: f64) -> Class {
        match self.hits as f64 / self.could_hit.max(1) as f64 {
            ALL_HITS_SHARE.. => Class::Named("finds all that is hit"),
            MANY_HITS_SHARE.. => Class::Named("finds much of what is hit"),
            _ => Class::of_size(times),
        }
    }
}

/// From this share of hits on, the class is "finds all that is hit".
const ALL_HITS_SHARE: f64 = 0.9;

/// From this share of hits on, the class is "finds much of what is hit".
const MANY_HITS_SHARE: f64 = 0.25;

/// Calls `of` with `scripted`, as a ray that can be traced through the tree of `world`.
pub(super) fn traced<T>(
    world: &ScriptedWorld,
    scripted: &ScriptedRay,
    of: impl FnOnce(&TracedRay<'_>) -> T,
) -> T {
    of(&TracedRay {
        tree: &world.tree,
        any_hit: world.any_hit,
        range: [scripted.ray.min_t, scripted.ray.max_t],
        span: &|node| scripted.spans[node],
        hit: &|id| scripted.prims[id as usize],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use wire::Work;

    fn script(name: &str) -> ScriptedWorld {
        let spec = cases::of("part2.task3", 0)
            .into_iter()
            .find(|spec| spec.name == name);
        match spec.map(|spec| spec.work) {
            Some(Work::Traverse(world)) => world,
            other => panic!("{name} is {other:?}"),
        }
    }

    /// The right answers, as closest hits, with `box_tests` and `prim_tests` for each ray.
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
        let mut findings = Findings::default();
        traverse(&mut findings, world, answers, counts_work);
        findings.wrong_aspects()
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
    fn the_farther_hit_fails_t() {
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

    /// As of code that tests everything and returns the hit that it found first, the farthest.
    #[test]
    fn a_right_max_t_beside_a_wrong_t_is_part_of_its_class() {
        let world = script("box_in_box");
        let mut answers = right(&world, 9, 9);
        let farthest = in_range(&world.rays[0]).max_by(|a, b| a.1.total_cmp(&b.1));
        answers[0].hit = farthest.map(|(id, t)| (t, id));
        let mut findings = Findings::default();
        traverse(&mut findings, &world, &answers, false);
        let list = findings.into_vec();
        let wrong = list.iter().filter(|finding| !finding.passed());
        let classes: Vec<_> = wrong
            .map(|finding| (finding.aspect, finding.faults[0].class))
            .collect();
        let t = (Aspect::T, Class::Named("max_t is right"));
        assert_eq!(classes[0], t);
        assert_eq!(classes.len(), 2, "the other is the primitive: {classes:?}");
    }

    #[test]
    fn an_unchanged_max_t_fails_only_ray_after() {
        let world = script("both_children");
        let mut answers = right(&world, 9, 9);
        for (scripted, answer) in world.rays.iter().zip(&mut answers) {
            answer.ray_after = scripted.ray;
        }
        assert_eq!(failed(&world, &answers, false), [Aspect::RayAfter]);
    }

    /// A stack of 256 layers has 511 nodes; half of the rays need tests of only a few nodes.
    #[test]
    fn testing_every_box_or_none_fails_work() {
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
    fn a_primitive_that_is_tested_twice_fails_work() {
        for name in ["both_children", "random_trees_any_hit", "nearer_first"] {
            let world = script(name);
            let mut answers = right(&world, 9, 9);
            answers[1].repeated_prims = 1;
            let failed = failed(&world, &answers, name == "nearer_first");
            assert_eq!(failed, [Aspect::Work], "{name}");
        }
    }

    /// The tree has 60 primitives. On average a ray needs 8 box tests and 4 primitive tests.
    #[test]
    fn testing_everything_saves_nothing() {
        let world = script("random_trees");
        let all = world.rays[0].prims.len() as u32;
        assert_eq!(failed(&world, &right(&world, 8, 4), false), []);
        assert_eq!(failed(&world, &right(&world, 20, 9), false), []);
        let without_boxes = failed(&world, &right(&world, 0, all), false);
        assert_eq!(without_boxes, [Aspect::Savings]);
        let boxes_again = failed(&world, &right(&world, 4 * 8, 4), false);
        assert_eq!(boxes_again, [Aspect::Savings]);
    }

    #[test]
    fn savings_are_not_judged_where_a_tree_saves_little() {
        for name in ["empty_tree", "both_children"] {
            let world = script(name);
            let all = world.rays[0].prims.len() as u32;
            assert_eq!(failed(&world, &right(&world, 9, all), false), [], "{name}");
        }
    }

    #[test]
    fn a_ray_beside_a_root_that_is_a_leaf_tests_no_primitive() {
        let world = script("one_leaf");
        let mut answers = right(&world, 1, 3);
        assert_eq!(failed(&world, &answers, false), [Aspect::Work]);
        for (scripted, answer) in world.rays.iter().zip(&mut answers) {
            if traced(&world, scripted, |ray| ray.all_met()).prims == 0 {
                answer.prim_tests = 0;
            }
        }
        assert_eq!(failed(&world, &answers, false), []);
    }

    #[test]
    fn a_leaf_that_tests_the_whole_list_has_a_class_of_its_own() {
        let world = script("both_children");
        let all = world.rays[0].prims.len() as u32;
        let class = |prim_tests: u32, repeated_prims: u32| {
            let mut answers = right(&world, 9, prim_tests);
            answers[0].repeated_prims = repeated_prims;
            let mut findings = Findings::default();
            traverse(&mut findings, &world, &answers, false);
            let list = findings.into_vec();
            let work = list.iter().find(|finding| !finding.passed());
            work.map(|finding| (finding.wrong, finding.faults[0].class))
        };
        let whole = Class::Named("all primitives in each leaf");
        assert_eq!(class(3 * all, 2 * all), Some((1, whole)));
        let again = Class::Named("primitives tested again");
        assert_eq!(class(3 * all, all), Some((1, again)));
        assert_eq!(class(3 * all, 0), None);
    }

    #[test]
    fn one_test_is_told_in_the_singular() {
        let world = script("both_children");
        let mut findings = Findings::default();
        let answers = right(&world, 9, 1);
        beside_the_root(&mut findings, &world, &answers);
        savings(&mut findings, &world, &answers);
        let list = findings.into_vec();
        let messages = list.iter().filter_map(|found| found.worst.as_ref());
        for message in messages.map(|worst| worst.message.to_string()) {
            assert!(!message.contains(" 1 primitive tests"), "{message}");
        }
    }

    #[test]
    fn every_tree_holds_each_primitive_at_most_once() {
        for spec in cases::of("part2.task3", 0) {
            let Work::Traverse(world) = spec.work else {
                continue;
            };
            let mut order = world.tree.order;
            let held = order.len();
            order.sort_unstable();
            order.dedup();
            assert_eq!(order.len(), held, "{}", spec.name);
        }
    }

    #[test]
    fn the_number_of_hits_gives_the_class_of_too_many_tests() {
        let world = script("nearer_first");
        let class = |prim_hits: u32| {
            let mut answers = right(&world, 511, 256);
            for answer in &mut answers {
                answer.prim_hits = prim_hits;
            }
            let mut findings = Findings::default();
            traverse(&mut findings, &world, &answers, true);
            let list = findings.into_vec();
            let work = list.iter().find(|finding| !finding.passed());
            work.map(|finding| finding.faults[0].class)
        };
        assert_eq!(class(256), Some(Class::Named("finds all that is hit")));
        assert_eq!(class(128), Some(Class::Named("finds much of what is hit")));
        assert!(matches!(class(1), Some(Class::Off(_))));
    }
}
