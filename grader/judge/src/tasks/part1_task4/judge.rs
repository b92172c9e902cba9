//! Judges probes of single spheres.

use crate::tools::aspects::hits::{self, Call, expect, record};
use crate::tools::findings::Aspect::*;
use crate::tools::findings::Findings;
use crate::tools::truth::expected::{Expected, HitOrMiss as Decision};
use wire::answer::SphereAnswer;
use wire::work::Probe;

/// Judges `test_sphere` and `intersect_sphere`.
pub(crate) fn spheres(
    findings: &mut Findings,
    probes: &[Probe],
    expected: &[Expected],
    answers: &[SphereAnswer],
) {
    let [test, intersect] = ["test_sphere", "intersect_sphere"];
    let calls = probes.iter().zip(expected).zip(answers);
    for (number, ((probe, expected), answer)) in calls.enumerate() {
        expect(findings, expected, false);
        if expected.decision() == Decision::Hit {
            findings.expect(Parameters);
        }
        let is_tested = findings.is_written(test, &[HitOrMiss, T]);
        let is_intersected = findings.is_written(intersect, &hits::OF_A_RECORD)
            && findings.is_written(intersect, &[Parameters]);
        let mut call = Call {
            findings: &mut *findings,
            number,
            function: test,
            ray: &probe.ray,
        };
        if is_tested {
            call.findings.count_for(test);
            call.decision(expected, answer.test);
            if let Some(t) = answer.test
                && let Some(right) = expected.closest_to(probe.shape, t)
            {
                call.t(right, t);
            }
        }
        if !is_intersected {
            continue;
        }
        let hit = answer.hit.as_ref();
        call.function = intersect;
        call.findings.count_for(intersect);
        record(&mut call, expected, hit);
        if let Some(hit) = hit {
            call.no_parameters(hit.uv);
        }
        let hit_t = hit.map(|hit| hit.t);
        call.ray_after(hit_t, &answer.ray_after, |max_t| {
            expected.has_right_max_t(hit_t, probe.ray.max_t, max_t)
        });
        if is_tested {
            call.agrees_with(test, answer.test.is_some(), hit.is_some());
        }
    }
}
