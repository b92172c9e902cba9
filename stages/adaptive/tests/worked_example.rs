//! The worked examples of the chapters of Part 5: the first tests to make green.

use adaptive::{has_converged, has_surely_converged};
use kit::Tally;

#[test]
fn part5_task1_four_samples() {
    let samples: Tally = [1.0, 2.0, 1.0, 2.0].into_iter().collect();
    // Half of the interval is 0.3772 of the mean.
    assert!(has_converged(&samples, 0.38));
    assert!(!has_converged(&samples, 0.05));
    // What 256 such samples have.
    let many: Tally = [1.0, 2.0].into_iter().cycle().take(256).collect();
    assert!(has_converged(&many, 0.05));
}

#[test]
fn part5_task2_a_black_batch_does_not_stop() {
    let mut rule = |samples: &Tally, tolerance: f64| {
        1.96 * samples.standard_error() <= tolerance * samples.mean()
    };
    let black: Tally = std::iter::repeat_n(0.0, 32).collect();
    assert!(rule(&black, 0.05), "the plain rule stops");
    assert!(!has_surely_converged(&black, 0.05, &mut rule));
    let long_black: Tally = std::iter::repeat_n(0.0, 2048).collect();
    assert!(!has_surely_converged(&long_black, 0.05, &mut rule));
    let bright: Tally = [1.0, 2.0].into_iter().cycle().take(256).collect();
    assert!(has_surely_converged(&bright, 0.05, &mut rule));
}
