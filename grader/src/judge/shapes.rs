//! Judging probes against single triangles and spheres.

use super::expected::Expected;
use super::hits;
use super::tally::{Aspect, Tally};
use wire::answer::{Hit, SphereAnswer, TriangleAnswer};
use wire::work::{Probe, Ray};

/// Judges `test_triangle` and `intersect_triangle`.
pub(super) fn triangles(
    tally: &mut Tally,
    probes: &[Probe],
    truth: impl Fn(&Probe) -> Expected,
    answers: &[TriangleAnswer],
) {
    for (call, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        let expected = truth(probe);
        hits::expect_hit(tally, &expected, true);
        hits::decision(
            tally,
            call,
            "test_triangle",
            &expected,
            answer.test.map(|[t, ..]| t),
            &probe.ray,
        );
        if let (Some(hit), Some([t, b1, b2])) = (&expected.hit, answer.test) {
            hits::t(tally, call, "test_triangle", hit, t, &probe.ray);
            hits::barycentrics(tally, call, "test_triangle", hit, [b1, b2], &probe.ray);
        }
        let hit = answer.hit.as_ref();
        intersect(
            tally,
            call,
            "intersect_triangle",
            probe,
            &expected,
            hit,
            &answer.ray_after,
        );
        if let (Some(expected), Some(hit)) = (&expected.hit, hit) {
            hits::barycentrics(
                tally,
                call,
                "intersect_triangle",
                expected,
                hit.uv,
                &probe.ray,
            );
        }
        agree(
            tally,
            call,
            ["test_triangle", "intersect_triangle"],
            answer.test.is_some(),
            hit.is_some(),
            &probe.ray,
        );
    }
}

/// Judges `test_sphere` and `intersect_sphere`.
pub(super) fn spheres(
    tally: &mut Tally,
    probes: &[Probe],
    truth: impl Fn(&Probe) -> Expected,
    answers: &[SphereAnswer],
) {
    for (call, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        let expected = truth(probe);
        hits::expect_hit(tally, &expected, false);
        hits::decision(
            tally,
            call,
            "test_sphere",
            &expected,
            answer.test,
            &probe.ray,
        );
        if let (Some(hit), Some(t)) = (&expected.hit, answer.test) {
            hits::t(tally, call, "test_sphere", hit, t, &probe.ray);
        }
        let hit = answer.hit.as_ref();
        intersect(
            tally,
            call,
            "intersect_sphere",
            probe,
            &expected,
            hit,
            &answer.ray_after,
        );
        agree(
            tally,
            call,
            ["test_sphere", "intersect_sphere"],
            answer.test.is_some(),
            hit.is_some(),
            &probe.ray,
        );
    }
}

fn intersect(
    tally: &mut Tally,
    call: usize,
    function: &str,
    probe: &Probe,
    expected: &Expected,
    hit: Option<&Hit>,
    after: &Ray,
) {
    hits::decision(
        tally,
        call,
        function,
        expected,
        hit.map(|hit| hit.t),
        &probe.ray,
    );
    if let (Some(expected), Some(hit)) = (&expected.hit, hit) {
        hits::t(tally, call, function, expected, hit.t, &probe.ray);
        hits::record(
            tally,
            call,
            function,
            expected,
            probe.shape,
            hit,
            &probe.ray,
        );
    }
    hits::ray_after(
        tally,
        call,
        function,
        &probe.ray,
        hit.map(|hit| hit.t),
        after,
    );
}

/// Where either answer scores, the two functions must still give the same one.
fn agree(
    tally: &mut Tally,
    call: usize,
    functions: [&str; 2],
    test: bool,
    intersect: bool,
    ray: &Ray,
) {
    let says = |hit: bool| if hit { "hit" } else { "miss" };
    tally.judge(Aspect::Decision, call, test == intersect, 0.5, || {
        let [a, b] = functions;
        format!(
            "{a} says {} and {b} says {}. {}",
            says(test),
            says(intersect),
            hits::show_ray(ray)
        )
    });
}
