//! How directions are distributed: counts that tell whether two sets of samples have the same
//! distribution.

use kit::{Vec3, math};
use statistics::chi_square::test_same_distribution;
use std::f64::consts::TAU;
use std::fmt;

/// Cells of equal height and equal angle around the normal: their numbers of rows and columns.
const ROWS: usize = 8;
const COLUMNS: usize = 8;

/// Finer rings of equal height, all around.
const RINGS: usize = 16;

/// The number of counts: those of the cells, those of the rings, and the missing directions.
pub const COUNTS: usize = ROWS * COLUMNS + RINGS + 1;

/// The probability that two sets of samples with the same distribution count as different. Each of
/// the two tests has half of it.
const FALSE_ALARM: f64 = 1e-4;

/// How many directions lie in each cell and each ring around the normal +z. The mean alone, or the
/// mean and the second moments, are the same for very different distributions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DirectionCounts([u16; COUNTS]);

impl DirectionCounts {
    /// Counts directions; `None` is a direction that was not sampled.
    pub fn of(directions: &[Option<Vec3>]) -> DirectionCounts {
        let mut counts = [0_u16; COUNTS];
        let mut count = |place: usize| counts[place] = counts[place].saturating_add(1);
        for direction in directions {
            let Some(d) = direction.and_then(Vec3::try_normalize) else {
                count(COUNTS - 1);
                continue;
            };
            let place = |share: f64, of: usize| ((share * of as f64) as usize).min(of - 1);
            let height = 0.5 * (d.z + 1.0);
            let turns = (math::atan2(d.y, d.x) / TAU).rem_euclid(1.0);
            count(place(height, ROWS) * COLUMNS + place(turns, COLUMNS));
            count(ROWS * COLUMNS + place(height, RINGS));
        }
        DirectionCounts(counts)
    }

    /// The counts, in a fixed order.
    pub fn counts(&self) -> &[u16; COUNTS] {
        &self.0
    }

    /// The distribution with these [counts](DirectionCounts::counts).
    pub fn from_counts(counts: [u16; COUNTS]) -> DirectionCounts {
        DirectionCounts(counts)
    }

    /// Whether two χ² tests, of the cells and of the rings, find no difference between the
    /// distributions of both sets of samples.
    pub fn is_like(&self, other: &DirectionCounts) -> bool {
        let [own, others] = [self, other].map(|counts| counts.0.map(f64::from));
        let cells = ROWS * COLUMNS;
        let is_like = |a: &[f64], b: &[f64]| test_same_distribution(a, b) >= 0.5 * FALSE_ALARM;
        is_like(&own[..cells], &others[..cells]) && is_like(&own[cells..], &others[cells..])
    }
}

impl fmt::Debug for DirectionCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.0).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::PixelSampler;

    /// 4,000 directions: `height` and `turns` of two random numbers.
    fn counts(
        seed: u64,
        height: impl Fn(f64) -> f64,
        turns: impl Fn(f64, f64) -> f64,
    ) -> DirectionCounts {
        let mut sampler = PixelSampler::new(0, 0, seed);
        let directions: Vec<_> = (0..4000)
            .map(|_| {
                let u = sampler.next_2d();
                Some(kit::warp::on_sphere(height(u.x), turns(u.x, u.y)))
            })
            .collect();
        DirectionCounts::of(&directions)
    }

    fn all_round(_: f64, u: f64) -> f64 {
        u
    }

    fn by_cosine(u: f64) -> f64 {
        (1.0 - u).sqrt()
    }

    #[test]
    fn samples_of_the_same_distribution_are_alike_whatever_the_numbers() {
        let first = counts(0, by_cosine, all_round);
        let alike = (1..100).filter(|seed| first.is_like(&counts(*seed, by_cosine, all_round)));
        assert_eq!(alike.count(), 99);
        let mirrored = counts(7, |u| u.sqrt(), |_, u| 1.0 - u);
        assert!(first.is_like(&mirrored));
    }

    #[test]
    fn distributions_with_the_same_mean_are_told_apart() {
        // The mean height is 2/3 in both.
        let first = counts(0, by_cosine, all_round);
        let in_two_rings = counts(1, |u| if u < 0.5 { 0.5 } else { 5.0 / 6.0 }, all_round);
        let narrower = counts(1, |u| 0.5 + u / 3.0, all_round);
        let in_wedges = counts(1, by_cosine, |_, u| 0.25 * ((4.0 * u).floor() + 0.5 * u));
        // The rings and the sectors are right, each by itself.
        let spiral = counts(1, by_cosine, |x, _| x);
        for other in [in_two_rings, narrower, in_wedges, spiral] {
            assert!(!first.is_like(&other), "{other:?}");
        }
    }

    #[test]
    fn missing_directions_count() {
        let all = counts(0, by_cosine, all_round);
        let mut some = counts(1, by_cosine, all_round);
        some.0[COUNTS - 1] = 200;
        assert!(!all.is_like(&some));
        assert_eq!(DirectionCounts::of(&[None]).counts()[COUNTS - 1], 1);
    }
}
