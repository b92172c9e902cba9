//! Judges probes of single spheres.

use crate::tools::aspects::hits::{self, Call, expect, record};
use crate::tools::tally::Aspect::*;
use crate::tools::tally::Tally;
use crate::tools::truth::expected::{Expected, HitOrMiss as Decision};
use wire::answer::SphereAnswer;
use wire::work::Probe;

/// Judges `test_sphere` and `intersect_sphere`.
pub(crate) fn spheres(
    tally: &mut Tally,
    probes: &[Probe],
    expected: &[Expected],
    answers: &[SphereAnswer],
) {
    let [test, intersect] = ["test_sphere", "intersect_sphere"];
    let calls = probes.iter().zip(expected).zip(answers);
    for (number, ((probe, expected), answer)) in calls.enumerate() {
        expect(tally, expected, false);
        if expected.decision() == Decision::Hit {
            tally.expect(Parameters);
        }
        let is_tested = tally.is_written(test, &[HitOrMiss, T]);
        let is_intersected = tally.is_written(intersect, &hits::OF_A_RECORD)
            && tally.is_written(intersect, &[Parameters]);
        let mut call = Call {
            tally: &mut *tally,
            number,
            function: test,
            ray: &probe.ray,
        };
        if is_tested {
            call.tally.count_for(test);
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
        call.tally.count_for(intersect);
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
