//! Simple samples for the stopping rule that waits.

use wire::adaptive::StopCall;

/// The simple questions: below and above 256 samples, black and not, for both results of the plain
/// rule.
pub(crate) fn questions() -> Vec<Vec<StopCall>> {
    let runs: [&[(u32, f64)]; 8] = [
        &[(1, 1.0)],
        &[(2, 1.0)],
        &[(100, 1.0)],
        &[(256, 1.0)],
        &[(255, 1.0)],
        &[(300, 1.0)],
        &[(300, 0.0)],
        &[(299, 0.0), (1, 1.0)],
    ];
    let calls = runs.iter().flat_map(|runs| {
        [true, false].map(|rule| StopCall {
            runs: runs.to_vec(),
            tolerance: 0.5,
            rule,
        })
    });
    vec![calls.collect()]
}
