//! Judges what no case grades about rays through a whole scene: the hit records, and the number of
//! tests.

use crate::tools::aspects::hits::{Call, ROUNDING_DECIDES, SEVERAL_FIRST};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::truth::expected::{Expected, HitOrMiss};
use crate::tools::truth::scene::{load, of_each_ray};
use crate::tools::truth::tree_tests::{
    MORE_TESTS, NeededTests, TOO_FEW_TESTS, Tests, TracedRay, WORK_FACTOR,
};
use crate::tools::{Tier, convert, truth};
use kit::{Aabb, PrimId, Primitive};
use oracle::{Closest, KernelClass, Shapes};
use std::cell::RefCell;
use std::collections::HashMap;
use wire::answer::HitsAnswer;
use wire::work::{Ray, SceneWork};

/// The closest hits that score, with all that a hit record contains.
pub(super) fn expected(work: &SceneWork, tier: Tier) -> Vec<Expected> {
    let scene = load(&work.scene);
    let shapes = Shapes::new(scene.primitives());
    of_each_ray(&work.rays, |ray| {
        truth::first_of(tier, &shapes, &convert::ray(ray), false)
    })
}

/// Judges the hit points, normals and surface parameters of the hits.
pub(super) fn records(
    findings: &mut Findings,
    rays: &[Ray],
    expected: &[Expected],
    truths: &[Closest],
    answer: &HitsAnswer,
) {
    let calls = rays.iter().zip(expected).zip(truths).zip(&answer.hits);
    for (number, (((ray, expected), truth), hit)) in calls.enumerate() {
        if expected.decision() == HitOrMiss::Either {
            findings.not_judged(Aspect::HitOrMiss, number, ROUNDING_DECIDES);
        }
        let Some(hit) = hit else { continue };
        let Some(right) = expected.closest_to(hit.prim, hit.t) else {
            continue;
        };
        // Where t is the same exactly, the convention names the primitive for goldens.
        let is_tie = |prim: u32| truth.ties.contains(&PrimId(prim));
        let only_ties = expected.hits.iter().all(|hit| is_tie(hit.prim));
        let first = only_ties.then(|| truth.ties.iter().min()).flatten();
        if first != Some(&PrimId(hit.prim)) {
            findings.not_judged(Aspect::Primitive, number, SEVERAL_FIRST);
        }
        // The hit of another primitive has another point and normal: one mistake.
        if hit.prim != right.prim {
            continue;
        }
        let mut call = Call {
            findings: &mut *findings,
            number,
            function: "intersect_bvh",
            ray,
        };
        call.geometry(right, hit);
        call.barycentrics(right, hit.uv);
        if right.uv.is_none() {
            call.no_parameters(hit.uv);
        }
    }
}

/// Records where rounding decides whether a ray is blocked.
pub(super) fn decisions(findings: &mut Findings, tier: Tier, truths: &[Closest]) {
    let kernel = match tier {
        Tier::Core => KernelClass::Textbook,
        Tier::Robust => KernelClass::Robust,
    };
    for (call, truth) in truths.iter().enumerate() {
        let answers = truth.answers.get(kernel);
        if answers.miss && !answers.hits.is_empty() {
            findings.not_judged(Aspect::HitOrMiss, call, ROUNDING_DECIDES);
        }
    }
}

/// The tests that all rays need, by the exact oracle.
pub(super) fn needed_tests(work: &SceneWork) -> NeededTests {
    let scene = load(&work.scene);
    let shapes = Shapes::new(scene.primitives());
    let of_ray = |wire_ray: &Ray| {
        let ray = convert::ray(wire_ray);
        let span = memoised(|node: usize| {
            let [min, max] = work.tree.nodes[node].bounds.map(Into::into);
            let verdict = oracle::bbox(&Aabb { min, max }, &ray);
            let ends = verdict.ends.filter(|_| verdict.hits())?;
            Some([ends.0.to_f64(), ends.1.to_f64()])
        });
        let hit = memoised(|id: u32| match scene.primitive(PrimId(id)) {
            Primitive::Triangle(shape) => {
                let verdict = oracle::triangle(shape, &ray);
                Some(verdict.crossing.filter(|_| verdict.hits())?.t.to_f64())
            }
            Primitive::Sphere(shape) => Some(oracle::sphere(shape, &ray).t?.to_f64()),
        });
        let traced = TracedRay {
            tree: &work.tree,
            any_hit: work.any_hit,
            range: [ray.min_t, ray.max_t],
            span: &span,
            hit: &hit,
        };
        let mut twice_plain = traced.fixed_order(false);
        twice_plain += traced.fixed_order(true);
        let near = shapes.near(&ray, KernelClass::Robust).into_iter();
        let closest = near.filter_map(|(id, _)| hit(id)).reduce(f64::min);
        NeededTests {
            fewest: traced.fewest(closest),
            twice_plain,
        }
    };
    let mut all = NeededTests::default();
    for of_ray in of_each_ray(&work.rays, of_ray) {
        all.fewest += of_ray.fewest;
        all.twice_plain += of_ray.twice_plain;
    }
    all
}

/// `of`, which computes each result once.
fn memoised<K: Copy + Eq + std::hash::Hash, T: Copy>(of: impl Fn(K) -> T) -> impl Fn(K) -> T {
    let known = RefCell::new(HashMap::new());
    move |key| *known.borrow_mut().entry(key).or_insert_with(|| of(key))
}

/// Judges the number of tests of all rays together.
pub(super) fn tests(findings: &mut Findings, needed: NeededTests, answer: &HitsAnswer) {
    let NeededTests {
        fewest,
        twice_plain,
    } = needed;
    let tests = Tests {
        boxes: answer.box_tests,
        prims: answer.prim_tests,
    };
    if tests.boxes < fewest.boxes || tests.prims < fewest.prims {
        findings.never_judged(Aspect::Work, TOO_FEW_TESTS);
    } else if tests != fewest {
        findings.never_judged(Aspect::Work, MORE_TESTS);
    }
    for (what, tests, twice_plain) in [
        ("box", tests.boxes, twice_plain.boxes),
        ("primitive", tests.prims, twice_plain.prims),
    ] {
        let plain = twice_plain as f64 / 2.0;
        let right = tests as f64 <= WORK_FACTOR * plain;
        findings.judge(Aspect::Work, 0, right, tests as f64 / plain, || {
            format!(
                "your result: {tests} {what} tests in all; visiting children in a fixed order makes {plain:.0} (up to {WORK_FACTOR} times that passes)"
            )
        });
    }
}
