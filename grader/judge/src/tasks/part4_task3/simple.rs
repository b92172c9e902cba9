//! Simple throughputs for Russian roulette.

use wire::global::RouletteWork;
use wire::work::Xyz;

/// Numbers of bounces: the last one without roulette and the first with it, few and many.
const BOUNCES: [u32; 5] = [4, 3, 1, 5, 10];

/// The simple questions about roulette: whole throughputs and halves, then quarters. Where the
/// number is the probability itself nothing rounds.
pub(crate) fn questions() -> Vec<RouletteWork> {
    let grey = |of: &[f64]| of.iter().map(|&x| [x; 3]).collect::<Vec<Xyz>>();
    let coloured = [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]];
    let mixed = [[0.5, 1.0, 2.0], [2.0, 0.5, 0.0], [0.5, 0.5, 0.0]];
    let halves = [grey(&[1.0, 0.5, 2.0, 0.0]), coloured.into(), mixed.into()];
    let quarters = [grey(&[0.25, 0.5]), vec![[0.5, 0.25, 0.0]]];
    vec![
        question(&halves.concat(), [0.0, 0.5]),
        question(&quarters.concat(), [0.75, 0.25]),
    ]
}

/// Each throughput after each number of bounces.
fn question(throughputs: &[Xyz], numbers: [f64; 2]) -> RouletteWork {
    let paths = throughputs
        .iter()
        .flat_map(|&throughput| BOUNCES.map(|bounces| (throughput, bounces)));
    RouletteWork {
        paths: paths.collect(),
        numbers: numbers.to_vec(),
    }
}
