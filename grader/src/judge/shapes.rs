//! Judging probes against single triangles and spheres, and rays through a list of both.

use super::expected::Expected;
use super::hits::{Call, expect};
use super::tally::Tally;
use wire::answer::{Hit, HitsAnswer, SphereAnswer, TriangleAnswer};
use wire::work::{Probe, Ray};

/// Judges `test_triangle` and `intersect_triangle`.
pub(super) fn triangles(
    tally: &mut Tally,
    probes: &[Probe],
    truth: impl Fn(&Probe) -> Expected,
    answers: &[TriangleAnswer],
) {
    let [test, intersect] = ["test_triangle", "intersect_triangle"];
    for (number, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        let expected = truth(probe);
        expect(tally, &expected, true);
        let mut call = Call {
            tally: &mut *tally,
            number,
            function: test,
            ray: &probe.ray,
        };
        let tested = answer.test.map(|[t, ..]| t);
        call.decision(&expected, tested);
        if let Some([t, b1, b2]) = answer.test
            && let Some(right) = expected.closest_to(probe.shape, t)
        {
            call.t(right, t);
            call.barycentrics(right, [b1, b2]);
        }
        let hit = answer.hit.as_ref();
        call.function = intersect;
        record(&mut call, &expected, hit);
        if let Some(hit) = hit
            && let Some(right) = expected.closest_to(probe.shape, hit.t)
        {
            call.barycentrics(right, hit.uv);
        }
        call.ray_after(hit.map(|hit| hit.t), &answer.ray_after);
        call.agrees_with(test, tested.is_some(), hit.is_some());
    }
}

/// Judges `test_sphere` and `intersect_sphere`.
pub(super) fn spheres(
    tally: &mut Tally,
    probes: &[Probe],
    truth: impl Fn(&Probe) -> Expected,
    answers: &[SphereAnswer],
) {
    let [test, intersect] = ["test_sphere", "intersect_sphere"];
    for (number, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        let expected = truth(probe);
        expect(tally, &expected, false);
        let mut call = Call {
            tally: &mut *tally,
            number,
            function: test,
            ray: &probe.ray,
        };
        call.decision(&expected, answer.test);
        if let Some(t) = answer.test
            && let Some(right) = expected.closest_to(probe.shape, t)
        {
            call.t(right, t);
        }
        let hit = answer.hit.as_ref();
        call.function = intersect;
        record(&mut call, &expected, hit);
        call.ray_after(hit.map(|hit| hit.t), &answer.ray_after);
        call.agrees_with(test, answer.test.is_some(), hit.is_some());
    }
}

/// Judges rays that went through a list of shapes, one `intersect_*` after the other.
pub(super) fn brute_force(
    tally: &mut Tally,
    rays: &[Ray],
    truth: impl Fn(&Ray) -> Expected,
    answer: &HitsAnswer,
) {
    let answers = answer.hits.iter().zip(&answer.max_t);
    for (number, (ray, (hit, max_t))) in rays.iter().zip(answers).enumerate() {
        let expected = truth(ray);
        let with_uv = expected.hits.iter().all(|hit| hit.uv.is_some());
        expect(tally, &expected, with_uv);
        let mut call = Call {
            tally: &mut *tally,
            number,
            function: "going through all shapes in order",
            ray,
        };
        record(&mut call, &expected, hit.as_ref());
        if let Some(hit) = hit
            && let Some(right) = expected.closest_to(hit.prim, hit.t)
        {
            call.barycentrics(right, hit.uv);
        }
        call.max_t_after(hit.map(|hit| hit.t), *max_t);
    }
}

/// Judges a hit record but for its barycentric weights.
fn record(call: &mut Call<'_>, expected: &Expected, hit: Option<&Hit>) {
    call.decision(expected, hit.map(|hit| hit.t));
    if let Some(hit) = hit
        && let Some(right) = expected.closest_to(hit.prim, hit.t)
    {
        call.primitive(expected, hit.prim);
        call.t(right, hit.t);
        call.geometry(right, hit);
    }
}
