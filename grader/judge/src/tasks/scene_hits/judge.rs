//! Judges rays through a whole scene.

use crate::tools::Tier;
use crate::tools::aspects::hits;
use crate::tools::findings::{Aspect, Findings, Message};
use kit::PrimId;
use oracle::closest::{Closest, ClosestJudgement};
use oracle::verdict::{Judgement, KernelClass};
use wire::answer::{Hit, HitsAnswer};
use wire::work::{Ray, SceneWork};

/// Judges closest hits, or, if `any_hit`, whether there is a hit.
pub(crate) fn hits(
    findings: &mut Findings,
    tier: Tier,
    truths: &[Closest],
    rays: &[Ray],
    any_hit: bool,
    answer: &HitsAnswer,
) {
    findings.count_for(match any_hit {
        true => "occludes_bvh",
        false => "intersect_bvh",
    });
    let kernel = match tier {
        Tier::Core => KernelClass::Textbook,
        Tier::Robust => KernelClass::Robust,
    };
    let answers = answer.hits.iter().zip(&answer.max_t);
    for (call, ((ray, truth), (hit, &max_t))) in rays.iter().zip(truths).zip(answers).enumerate() {
        if any_hit {
            blocked(findings, call, kernel, truth, hit.is_some(), ray);
        } else {
            one(findings, call, kernel, truth, hit.as_ref(), ray);
            let after = Ray { max_t, ..*ray };
            let hit_t = hit.map(|hit| hit.t);
            let mut call = hits::Call {
                findings,
                number: call,
                function: "intersect_bvh",
                ray,
            };
            call.ray_after(hit_t, &after, |max_t| {
                let is_right_t = |t: f64| is_nearest(truth, kernel, t);
                match truth.nearest {
                    Some(_) => !hit_t.is_some_and(is_right_t) && is_right_t(max_t),
                    None => hit_t.is_some() && max_t == ray.max_t,
                }
            });
        }
    }
}

/// What a tree saves in scenes of fewer primitives is not judged.
const MIN_PRIMITIVES: u64 = 1000;

/// A traversal of a tree makes at most one in this many of the tests without a tree. The reference
/// makes one in 20 in the cases' scenes, a test of the box of each leaf one in 3.
const MIN_SAVINGS: u64 = 6;

/// Judges whether the traversal saves tests.
pub(crate) fn savings(findings: &mut Findings, work: &SceneWork, answer: &HitsAnswer) {
    let primitives = work.tree.order.len() as u64;
    if primitives < MIN_PRIMITIVES {
        return;
    }
    let made = answer.box_tests.saturating_add(answer.prim_tests);
    let all = primitives * work.rays.len() as u64;
    findings.expect(Aspect::Savings);
    let saves = made <= all / MIN_SAVINGS;
    findings.judge(Aspect::Savings, 0, saves, made as f64, || {
        format!(
            "your result: {} box tests and {} primitive tests; without a tree: {all} primitive tests. A traversal saves most of them",
            answer.box_tests, answer.prim_tests
        )
    });
}

/// Whether the nearest primitive is hit at `t`.
fn is_nearest(truth: &Closest, kernel: KernelClass, t: f64) -> bool {
    let judgement = |(id, _)| truth.judge(kernel, Some((id, t)));
    match truth.nearest.map(judgement) {
        Some(ClosestJudgement::Primitive(judgement)) => judgement.scores(),
        _ => false,
    }
}

fn one(
    findings: &mut Findings,
    call: usize,
    kernel: KernelClass,
    truth: &Closest,
    hit: Option<&Hit>,
    ray: &Ray,
) {
    let answers = truth.answers.get(kernel);
    findings.expect(Aspect::HitOrMiss);
    findings.expect(Aspect::RayAfter);
    if !answers.miss {
        findings.expect(Aspect::Primitive);
        findings.expect(Aspect::T);
    }
    let given = hit.map(|hit| (PrimId(hit.prim), hit.t));
    let judgement = truth.judge(kernel, given);
    let decided = !matches!(
        judgement,
        ClosestJudgement::FalseHit | ClosestJudgement::FalseMiss
    );
    let right = || match truth.nearest {
        Some((id, t)) => format!("primitive {} at t = {}", id.0, t.to_f64()),
        None => "miss".to_string(),
    };
    let class = hits::decision_class(decided, given.is_some());
    findings.judge_class(Aspect::HitOrMiss, call, class, 1.0, || {
        let result = match given {
            Some((id, t)) => format!("primitive {} at t = {t}", id.0),
            None => "miss".into(),
        };
        Message::new(format!("your result: {result}; expected: {}", right()))
            .asked(hits::show_ray(ray))
    });
    let (true, Some((id, t))) = (decided, given) else {
        return;
    };
    let is_first = judgement != ClosestJudgement::WrongPrimitive;
    findings.judge(Aspect::Primitive, call, is_first, 1.0, || {
        Message::new(format!(
            "your result: primitive {} at t = {t}; expected: {}",
            id.0,
            right()
        ))
        .asked(hits::show_ray(ray))
    });
    if let ClosestJudgement::Primitive(judgement) = judgement {
        let off = match judgement {
            Judgement::WrongT { ulps, .. } => ulps,
            _ => 0.0,
        };
        findings.judge(Aspect::T, call, judgement.scores(), off, || {
            Message::new(format!("your result: t = {t}; expected: {}", right()))
                .compares([t], truth.nearest.as_ref().map(|(_, t)| t.to_f64()))
                .asked(hits::show_ray(ray))
        });
    }
}

fn blocked(
    findings: &mut Findings,
    call: usize,
    kernel: KernelClass,
    truth: &Closest,
    answer: bool,
    ray: &Ray,
) {
    findings.expect(Aspect::HitOrMiss);
    let right = truth.judge_any(kernel, answer);
    let class = hits::decision_class(right, answer);
    findings.judge_class(Aspect::HitOrMiss, call, class, 1.0, || {
        let (result, right) = match truth.nearest {
            Some((id, t)) => (
                "not occluded",
                format!("occluded by primitive {} at t = {}", id.0, t.to_f64()),
            ),
            None => ("occluded", "not occluded".to_string()),
        };
        Message::new(format!("your result: {result}; expected: {right}")).asked(hits::show_ray(ray))
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::truth::scene::closest_hits;
    use wire::work::{SceneSource, Tree};

    /// Two walls perpendicular to x, at 1 and at 2.
    fn walls() -> SceneSource {
        let wall = |x: f64| {
            let [a, b, c] = [[x, -4.0, -4.0], [x, 4.0, -4.0], [x, 0.0, 4.0]];
            [a, b, c, [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
        };
        SceneSource::Triangles(vec![wall(2.0), wall(1.0)])
    }

    const RAY: Ray = Ray {
        o: [0.0, 0.1, 0.1],
        d: [1.0, 0.0, 0.0],
        min_t: 0.0,
        max_t: f64::INFINITY,
    };

    fn failed(hit: Option<(u32, f64)>, any_hit: bool) -> Vec<Aspect> {
        let hit = hit.map(|(prim, t)| Hit {
            t,
            p: [t, 0.1, 0.1],
            n: [1.0, 0.0, 0.0],
            ng: [1.0, 0.0, 0.0],
            uv: [0.0; 2],
            prim,
        });
        let answer = HitsAnswer {
            hits: vec![hit],
            max_t: vec![hit.map_or(RAY.max_t, |hit| hit.t)],
            box_tests: 1,
            prim_tests: 1,
        };
        let mut findings = Findings::default();
        let truths = closest_hits(&walls(), &[RAY]);
        hits(&mut findings, Tier::Core, &truths, &[RAY], any_hit, &answer);
        findings.wrong_aspects()
    }

    #[test]
    fn only_the_closest_wall_passes() {
        assert_eq!(failed(Some((1, 1.0)), false), []);
        assert_eq!(failed(Some((1, 1.0 + 1e-9)), false), [Aspect::T]);
        assert!(failed(Some((0, 2.0)), false).contains(&Aspect::Primitive));
        assert!(failed(None, false).contains(&Aspect::HitOrMiss));
    }

    #[test]
    fn any_hit_must_find_a_hit() {
        assert_eq!(failed(Some((0, 0.0)), true), []);
        assert_eq!(failed(None, true), [Aspect::HitOrMiss]);
    }

    /// A record may state any numbers.
    #[test]
    fn more_tests_than_can_be_added_save_nothing() {
        let work = SceneWork {
            scene: walls(),
            tree: Tree {
                nodes: Vec::new(),
                order: (0..1000).collect(),
            },
            rays: vec![RAY],
            any_hit: false,
        };
        let wrong = |box_tests| {
            let answer = HitsAnswer {
                hits: vec![None],
                max_t: vec![RAY.max_t],
                box_tests,
                prim_tests: 1,
            };
            let mut findings = Findings::default();
            savings(&mut findings, &work, &answer);
            findings.wrong_aspects()
        };
        assert_eq!(wrong(1), []);
        assert_eq!(wrong(u64::MAX), [Aspect::Savings]);
    }
}
