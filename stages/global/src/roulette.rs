//! Part 4, task 3: Russian roulette, which ends paths without darkening the picture.

use kit::Spectrum;

/// Bounces that every path makes before it has to play.
pub const FIRST_GAME: u32 = 3;

/// Plays for the life of a path that has made `bounces` bounces and whose light counts by the factor `throughput`. `u` is
/// uniform in [0, 1).
///
/// Up to [`FIRST_GAME`] bounces the path goes on as it is. Then it survives with the probability `q`, the largest channel
/// of `throughput` (at most 1): if `u < q` it goes on with `throughput / q`, else `None` ends it. Whoever survives counts
/// for those who did not: the mean over all `u` is `throughput` whatever `q` is, so the picture stays right, and dim paths,
/// which cost as much as bright ones, become rare (Arvo and Kirk, "Particle transport and image synthesis", 1990). A
/// black path always ends, even before the first game: nothing it finds can be seen.
pub fn play_roulette(throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
    // BEGIN SOLUTION(part4.task3)
    let q = throughput.max_channel().min(1.0);
    if q <= 0.0 {
        return None;
    }
    if bounces <= FIRST_GAME {
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
    fn young_paths_live_on() {
        for bounces in 0..=FIRST_GAME {
            assert_eq!(play_roulette(DIM, bounces, 0.999), Some(DIM));
        }
        assert_eq!(play_roulette(DIM, FIRST_GAME + 1, 0.999), None);
    }

    #[test]
    fn survivors_count_for_those_who_are_gone() {
        let old = FIRST_GAME + 1;
        assert_eq!(
            play_roulette(DIM, old, 0.249),
            Some(Spectrum::new(1.0, 0.5, 0.0))
        );
        assert_eq!(play_roulette(DIM, old, 0.25), None);
        // A grid of u gives the mean exactly.
        let n = 1024;
        let sum: Spectrum = (0..n)
            .filter_map(|i| play_roulette(DIM, old, f64::from(i) / f64::from(n)))
            .sum();
        assert_eq!(sum / f64::from(n), DIM);
    }

    #[test]
    fn bright_paths_are_safe_and_black_ones_are_not() {
        let bright = Spectrum::new(0.1, 1.5, 0.2);
        assert_eq!(play_roulette(bright, 99, 0.999_999), Some(bright));
        assert_eq!(play_roulette(Spectrum::BLACK, 0, 0.0), None);
        assert_eq!(play_roulette(Spectrum::BLACK, 99, 0.0), None);
    }
}
// END SOLUTION(part4.task3)
