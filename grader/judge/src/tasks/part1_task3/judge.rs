//! Judges probes of single triangles.

use crate::tools::aspects::hits::{self, Call, expect, record};
use crate::tools::findings::Aspect::*;
use crate::tools::findings::Findings;
use crate::tools::truth::expected::Expected;
use wire::answer::TriangleAnswer;
use wire::work::TriangleWork;

/// Judges `test_triangle` and the function beside it.
pub(crate) fn triangles(
    findings: &mut Findings,
    work: &TriangleWork,
    expected: &[Expected],
    answers: &[TriangleAnswer],
) {
    let [test, intersect] = ["test_triangle", work.function()];
    let calls = work.probes.iter().zip(expected).zip(answers);
    for (number, ((probe, expected), answer)) in calls.enumerate() {
        expect(findings, expected, true);
        let is_tested = findings.is_written(test, &[HitOrMiss, T, Barycentrics]);
        let is_intersected = findings.is_written(intersect, &hits::OF_A_RECORD);
        let mut call = Call {
            findings: &mut *findings,
            number,
            function: test,
            ray: &probe.ray,
        };
        let tested = answer.test.map(|[t, ..]| t);
        if is_tested {
            call.findings.count_for(test);
            call.decision(expected, tested);
            if let Some([t, b1, b2]) = answer.test
                && let Some(right) = expected.closest_to(probe.shape, t)
            {
                call.t(right, t);
                call.barycentrics(right, [b1, b2]);
            }
        }
        if !is_intersected {
            continue;
        }
        let hit = answer.hit.as_ref();
        call.function = intersect;
        call.findings.count_for(intersect);
        record(&mut call, expected, hit);
        if let Some(hit) = hit
            && let Some(right) = expected.closest_to(probe.shape, hit.t)
        {
            call.barycentrics(right, hit.uv);
        }
        let hit_t = hit.map(|hit| hit.t);
        call.ray_after(hit_t, &answer.ray_after, |max_t| {
            expected.has_right_max_t(hit_t, probe.ray.max_t, max_t)
        });
        if is_tested {
            call.agrees_with(test, tested.is_some(), hit.is_some());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::Tier;
    use crate::tools::findings::Aspect;
    use crate::tools::truth::expected::Expected;
    use crate::tools::{convert, truth};
    use kit::Vec3;
    use wire::answer::Hit;
    use wire::work::{Probe, Ray};

    const TRIANGLE: [[f64; 3]; 6] = [
        [0.0, 0.0, 0.0],
        [3.0, 0.5, 0.0],
        [0.5, 3.0, 1.0],
        [0.6, 0.0, 0.8],
        [0.0, 0.6, 0.8],
        [0.0, 0.0, 1.0],
    ];

    fn ray(x: f64, y: f64) -> Ray {
        Ray {
            o: [x, y, 4.0],
            d: [0.0, 0.0, -2.0],
            min_t: 0.0,
            max_t: 100.0,
        }
    }

    fn expected(ray: &Ray) -> Expected {
        let triangle = convert::triangle(&TRIANGLE);
        truth::triangle(Tier::Robust, 0, &triangle, &convert::ray(ray))
    }

    /// The right answer.
    fn answer(ray: &Ray) -> TriangleAnswer {
        let right = expected(ray);
        let hit = right.hits.first().map(|hit| Hit {
            t: hit.t,
            p: hit.p.into(),
            n: hit.n.unwrap_or(Vec3::Z).into(),
            ng: hit.ng.unwrap_or(Vec3::Z).into(),
            uv: hit.uv.map_or([0.0; 2], |(uv, _)| uv.into()),
            prim: 0,
        });
        TriangleAnswer {
            test: hit.map(|hit| [hit.t, hit.uv[0], hit.uv[1]]),
            hit,
            ray_after: Ray {
                max_t: hit.map_or(ray.max_t, |hit| hit.t),
                ..*ray
            },
        }
    }

    /// The aspects that fail for the right answer to `ray` after `spoil` has changed it.
    fn wrong(ray: Ray, spoil: impl Fn(&mut TriangleAnswer)) -> Vec<Aspect> {
        let mut answer = answer(&ray);
        spoil(&mut answer);
        let mut findings = Findings::default();
        let work = TriangleWork {
            triangles: vec![TRIANGLE],
            probes: vec![Probe { shape: 0, ray }],
            by_record: false,
        };
        triangles(&mut findings, &work, &[expected(&ray)], &[answer]);
        let list = findings.into_vec().into_iter();
        let wrong = list.filter(|finding| finding.wrong > 0);
        wrong.map(|finding| finding.aspect).collect()
    }

    /// Changes the hit record.
    fn hit(spoil: impl Fn(&mut Hit)) -> impl Fn(&mut TriangleAnswer) {
        move |answer| answer.hit.iter_mut().for_each(&spoil)
    }

    #[test]
    fn each_field_of_a_hit_is_judged_separately() {
        let inside = ray(1.0, 1.25);
        assert_eq!(wrong(inside, |_| {}), []);
        assert_eq!(wrong(inside, hit(|h| h.prim = 7)), [Primitive]);
        assert_eq!(wrong(inside, hit(|h| h.p[1] += 1e-9)), [Position]);
        assert_eq!(wrong(inside, hit(|h| h.n = h.n.map(|x| -x))), [Normal]);
        assert_eq!(wrong(inside, hit(|h| h.n = h.n.map(|x| 1.1 * x))), [Normal]);
        assert_eq!(
            wrong(inside, hit(|h| h.ng[0] = f64::NAN)),
            [GeometricNormal]
        );
        assert_eq!(wrong(inside, hit(|h| h.uv.swap(0, 1))), [Barycentrics]);
        assert_eq!(wrong(inside, |a| a.ray_after.max_t = 100.0), [RayAfter]);
        assert_eq!(wrong(inside, |a| a.ray_after.min_t = 1.0), [RayAfter]);
    }

    #[test]
    fn both_functions_are_judged() {
        let inside = ray(1.0, 1.25);
        let shift = |a: &mut TriangleAnswer| a.test.iter_mut().for_each(|[t, ..]| *t += 1e-9);
        assert_eq!(wrong(inside, shift), [T]);
        assert_eq!(wrong(inside, |a| a.test = None), [HitOrMiss]);
        let miss = |a: &mut TriangleAnswer| {
            a.hit = None;
            a.ray_after = ray(1.0, 1.25);
        };
        assert_eq!(wrong(inside, miss), [HitOrMiss]);
    }

    /// A right `max_t` beside a wrong `t` or a wrong miss is no second fault.
    #[test]
    fn a_right_max_t_is_right_whatever_is_returned() {
        let inside = ray(1.0, 1.25);
        assert_eq!(wrong(inside, hit(|h| h.t = 0.0)), [T]);
        assert_eq!(wrong(inside, |a| a.hit = None), [HitOrMiss]);
        // A max_t that fits neither the returned t nor the right one.
        let both = |a: &mut TriangleAnswer| {
            a.ray_after.max_t = 3.0;
            a.hit.iter_mut().for_each(|hit| hit.t = 0.0);
        };
        assert_eq!(wrong(inside, both), [RayAfter, T]);
        // The right t, rounded in another way than the one returned: max_t is not set to t.
        let other_rounding = |a: &mut TriangleAnswer| {
            a.ray_after.max_t = a.ray_after.max_t.next_up();
        };
        assert_eq!(wrong(inside, other_rounding), [RayAfter]);
        let beside = ray(3.0, 3.0);
        let right = answer(&inside).hit;
        assert_eq!(wrong(beside, |a| a.hit = right), [HitOrMiss]);
    }

    #[test]
    fn a_miss_changes_nothing() {
        let beside = ray(3.0, 3.0);
        assert_eq!(wrong(beside, |_| {}), []);
        assert_eq!(wrong(beside, |a| a.ray_after.max_t = 2.0), [RayAfter]);
        assert_eq!(
            wrong(beside, |a| a.test = Some([2.0, 0.5, 0.5])),
            [HitOrMiss]
        );
    }
}
