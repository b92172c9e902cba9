//! When the waiting rule leaves the decision to the plain rule.

use crate::tools::packed_truth;
// BEGIN SOLUTION(part5.task2)
use crate::tools::kinds::stopping::samples;
// END SOLUTION(part5.task2)
use wire::adaptive::StopCall;

// BEGIN SOLUTION(part5.task2)
/// The number of samples before the plain rule decides.
const MIN_SAMPLES: u64 = 256;
// END SOLUTION(part5.task2)

/// Whether the plain rule decides.
pub(super) fn plain_decides(call: &StopCall) -> bool {
    // BEGIN SOLUTION(part5.task2)
    let samples = samples(call);
    let right = samples.count() >= MIN_SAMPLES && samples.mean() > 0.0;
    packed_truth::record("part5.task2", "plain decides", &call.runs, right)
    // STUB: packed_truth::find("part5.task2", "plain decides", &call.runs)
    // END SOLUTION(part5.task2)
}
