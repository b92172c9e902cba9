//! Simple throughputs for Russian roulette.

use wire::global::RouletteWork;

/// The simple questions about roulette: no number is at the probability itself.
pub(crate) fn questions() -> Vec<RouletteWork> {
    let grey = [1.0, 0.5, 2.0, 0.0].map(|x| [x; 3]);
    let coloured = [[0.5, 0.0, 0.0], [0.0, 0.0, 0.5], [0.5, 1.0, 2.0]];
    let throughputs = grey.into_iter().chain(coloured);
    let paths =
        throughputs.flat_map(|throughput| [1, 3, 4, 5, 10].map(|bounces| (throughput, bounces)));
    vec![RouletteWork {
        paths: paths.collect(),
        numbers: vec![0.25, 0.75, 0.0],
    }]
}
