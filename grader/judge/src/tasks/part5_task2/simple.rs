//! Simple samples for the stopping rule that waits.

use wire::adaptive::StopCall;

/// The simple questions: below and above 256 samples, black and not, for both results of the plain
/// rule.
pub(crate) fn questions() -> Vec<Vec<StopCall>> {
    let runs: [&[(u32, f64)]; 12] = [
        &[(1, 1.0)],
        &[(2, 1.0)],
        &[(32, 1.0)],
        &[(256, 1.0)],
        &[(255, 1.0)],
        &[(257, 1.0)],
        &[(256, 0.0)],
        &[(1, 0.0)],
        &[(255, 0.0), (1, 1.0)],
        &[(255, 0.0), (1, 0.5)],
        &[(255, 0.0), (1, 99.0)],
        &[(100, 1.0)],
    ];
    let tolerances = [0.5, 1.0];
    let calls = runs.iter().flat_map(|runs| {
        tolerances.iter().flat_map(|&tolerance| {
            [true, false].map(|rule| StopCall {
                runs: runs.to_vec(),
                tolerance,
                rule,
            })
        })
    });
    vec![calls.collect()]
}
