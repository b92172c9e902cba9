//! Judges rays traced through a list of shapes.

use crate::tools::aspects::hits::{Call, expect, record};
use crate::tools::findings::Findings;
use crate::tools::truth::expected::Expected;
use wire::answer::HitsAnswer;
use wire::work::Ray;

/// What is called, for messages.
const FUNCTION: &str = "intersect_* on all shapes in order";

/// Judges the closest hits of rays that were tested against all shapes of a list, in order. If the
/// shapes enclose the origins, every ray hits within its range: a hit elsewhere is a false hit,
/// since it would hide a gap between the shapes.
pub(crate) fn brute_force(
    findings: &mut Findings,
    rays: &[Ray],
    expected: &[Expected],
    answer: &HitsAnswer,
    enclosed: bool,
) {
    let answers = answer.hits.iter().zip(&answer.max_t);
    let calls = rays.iter().zip(expected).zip(answers);
    for (number, ((ray, expected), (hit, max_t))) in calls.enumerate() {
        let with_uv = expected.hits.iter().all(|hit| hit.uv.is_some());
        expect(findings, expected, with_uv);
        let mut call = Call {
            findings: &mut *findings,
            number,
            function: FUNCTION,
            ray,
        };
        record(&mut call, expected, hit.as_ref());
        if enclosed && let Some(hit) = hit {
            call.is_in_range(expected, hit.t);
        }
        if let Some(hit) = hit
            && let Some(right) = expected.closest_to(hit.prim, hit.t)
        {
            call.barycentrics(right, hit.uv);
        }
        let hit_t = hit.map(|hit| hit.t);
        call.max_t_after(hit_t, *max_t, |max_t| {
            expected.has_right_max_t(hit_t, ray.max_t, max_t)
        });
    }
}

/// Judges the surface parameters of the spheres that are hit.
pub(crate) fn parameters(
    findings: &mut Findings,
    rays: &[Ray],
    expected: &[Expected],
    answer: &HitsAnswer,
) {
    let calls = rays.iter().zip(expected).zip(&answer.hits);
    for (number, ((ray, expected), hit)) in calls.enumerate() {
        if let Some(hit) = hit
            && let Some(right) = expected.closest_to(hit.prim, hit.t)
            && right.uv.is_none()
        {
            let mut call = Call {
                findings: &mut *findings,
                number,
                function: FUNCTION,
                ray,
            };
            call.no_parameters(hit.uv);
        }
    }
}
