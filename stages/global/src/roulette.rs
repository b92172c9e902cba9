//! Part 4, task 3: Russian roulette, which ends paths without a bias.

use kit::Spectrum;

/// Number of bounces that every path makes before Russian roulette starts.
pub const MIN_BOUNCES: u32 = 3;

/// Russian roulette for a path with `bounces` bounces so far and the given `throughput`. `u` is
/// uniform in [0, 1). Returns the throughput to continue with, or `None` to end the path.
///
/// Chapter: stages/book/src/part4/task3.md
///
/// Up to [`MIN_BOUNCES`] bounces the path continues unchanged. After that it survives with the
/// probability `q`, the largest channel of `throughput` (at most 1): if `u < q` it continues,
/// otherwise `None` ends it. The weight of the survivors compensates for the paths that ended: the
/// mean over all `u` is `throughput`, whatever `q` is.
///
/// So the estimate stays unbiased, and dark paths, which cost as much as bright ones, become rare
/// (Arvo and Kirk, "Particle transport and image synthesis", 1990). A black path always ends, also
/// before the first roulette, because it contributes nothing.
///
/// See it: `cargo grader picture part4.task3`.
pub fn play_roulette(throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
    // BEGIN SOLUTION(part4.task3)
    let q = throughput.max_channel().min(1.0);
    if q <= 0.0 {
        return None;
    }
    if bounces <= MIN_BOUNCES {
        return Some(throughput);
    }
    (u < q).then(|| throughput / q)
    // STUB: kit::hole!("part4.task3", throughput, bounces, u)
    // END SOLUTION(part4.task3)
}

// BEGIN SOLUTION(part4.task3)
#[cfg(test)]
mod tests {
    use super::*;

    const DIM: Spectrum = Spectrum::new(0.25, 0.125, 0.0);

    #[test]
    fn short_paths_continue() {
        for bounces in 0..=MIN_BOUNCES {
            assert_eq!(play_roulette(DIM, bounces, 0.999), Some(DIM));
        }
        assert_eq!(play_roulette(DIM, MIN_BOUNCES + 1, 0.999), None);
    }

    #[test]
    fn survivors_compensate_for_ended_paths() {
        let bounces = MIN_BOUNCES + 1;
        assert_eq!(
            play_roulette(DIM, bounces, 0.249),
            Some(Spectrum::new(1.0, 0.5, 0.0))
        );
        assert_eq!(play_roulette(DIM, bounces, 0.25), None);
        // The mean over a regular grid of `u` is exact.
        let n = 1024;
        let sum: Spectrum = (0..n)
            .filter_map(|i| play_roulette(DIM, bounces, f64::from(i) / f64::from(n)))
            .sum();
        assert_eq!(sum / f64::from(n), DIM);
    }

    #[test]
    fn bright_paths_always_continue_and_black_paths_always_end() {
        let bright = Spectrum::new(0.1, 1.5, 0.2);
        assert_eq!(play_roulette(bright, 99, 0.999_999), Some(bright));
        assert_eq!(play_roulette(Spectrum::BLACK, 0, 0.0), None);
        assert_eq!(play_roulette(Spectrum::BLACK, 99, 0.0), None);
    }
}
// END SOLUTION(part4.task3)
