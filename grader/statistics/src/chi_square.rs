//! Pearson's χ² test: compares sampled directions with their density.
//!
//! The sphere of directions is divided into cells. The samples in each cell are counted, the
//! density is integrated over each cell, and `χ² = Σ (counted - expected)² / expected` is compared
//! with its distribution. The test detects a missing cosine or a pdf that is wrong by a factor,
//! which are hard to see in a noisy image.

use kit::math;
use kit::{Vec2, Vec3};
use std::f64::consts::TAU;

/// Rows of cells, equally spaced in z.
const ROWS: usize = 16;
/// Columns of cells, equally spaced in the angle around z.
const COLUMNS: usize = 32;
/// Steps of the midpoint rule along each side of a cell.
const STEPS: usize = 48;
/// Cells with fewer expected samples are pooled: χ² follows its distribution only if each cell
/// expects enough samples (Cochran 1952).
const FEWEST_EXPECTED: f64 = 8.0;

/// Tests whether `samples` directions from `sample` follow the density `pdf`.
///
/// `sample` maps a point of the unit square and a number in [0, 1) to a unit direction, or to
/// `None` if it produces no sample; these are counted in a cell of their own, which expects the
/// part by which the integral of `pdf` is less than 1. `pdf` is a density with respect to solid
/// angle. The points are a fixed sequence, so the result is the same on every platform.
pub fn fit_samples(
    samples: u32,
    seed: u64,
    mut sample: impl FnMut(Vec2, f64) -> Option<Vec3>,
    pdf: impl Fn(Vec3) -> f64,
) -> Fit {
    let mut numbers = kit::PixelSampler::new(0, 0, seed);
    let directions = (0..samples).map(|_| {
        let u = numbers.get_sample();
        let choice = numbers.next_1d();
        sample(u, choice)
    });
    fit(directions, pdf)
}

/// The result of a χ² test of directions.
///
/// ```
/// use statistics::chi_square::fit_samples;
/// use std::f64::consts::PI;
/// let uniform = |_: kit::Vec3| 1.0 / (4.0 * PI);
/// let right = fit_samples(10_000, 1, |u, _| Some(kit::warp::uniform_sphere(u)), uniform);
/// assert!(right.p > 0.01);
/// let wrong = fit_samples(10_000, 1, |u, _| Some(kit::warp::uniform_hemisphere(u)), uniform);
/// assert!(wrong.p < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The p-value: the probability that directions that follow the density have at least this χ².
    pub p: f64,
    /// Number of directions.
    pub samples: f64,
    /// Degrees of freedom: the number of compared cells minus 1.
    pub degrees: f64,
}

impl Fit {
    /// Returns the smallest deviation that the test reliably detects. `alarm` is the probability of
    /// a false alarm; directions with this deviation pass the test no more often than correct ones
    /// fail it. The deviation is the root mean square, over directions that follow the density, of
    /// the relative difference between the true density and `pdf`.
    ///
    /// For n samples with the deviation ε, χ² follows the noncentral distribution with
    /// noncentrality `n·ε²`. Differences that average out within a cell (1/16 of the height, 1/32
    /// of a turn) are not detected.
    pub fn detectable_deviation(&self, alarm: f64) -> f64 {
        (detectable_noncentrality(self.degrees, alarm) / self.samples).sqrt()
    }
}

/// Tests whether `directions` follow the density `pdf`. The points that they were sampled from must
/// not depend on them. `None` counts as in [`fit_samples`].
pub fn fit(directions: impl IntoIterator<Item = Option<Vec3>>, pdf: impl Fn(Vec3) -> f64) -> Fit {
    let mut counted = vec![0.0; ROWS * COLUMNS + 1];
    let mut samples = 0.0;
    for direction in directions {
        counted[direction.map_or(ROWS * COLUMNS, cell_of)] += 1.0;
        samples += 1.0;
    }
    let mut expected: Vec<f64> = (0..ROWS * COLUMNS)
        .map(|cell| integrate(cell, &pdf) * samples)
        .collect();
    let lost = samples - expected.iter().sum::<f64>();
    expected.push(lost.max(0.0));
    let (p, degrees) = compare(&counted, &expected);
    Fit {
        p,
        samples,
        degrees,
    }
}

/// Returns the p-value of `counted` against `expected`. Cells with small expected counts are
/// pooled.
pub fn test_counts(counted: &[f64], expected: &[f64]) -> f64 {
    compare(counted, expected).0
}

/// Returns the p-value of two lists of counts against the same distribution (Numerical Recipes,
/// 14.3). Cells with few samples are pooled.
pub fn test_same_distribution(counted: &[f64], others: &[f64]) -> f64 {
    let [samples, other_samples] = [counted, others].map(|counts| counts.iter().sum::<f64>());
    if samples == 0.0 || other_samples == 0.0 {
        return if samples == other_samples { 1.0 } else { 0.0 };
    }
    let scale = (other_samples / samples).sqrt();
    let (mut chi2, mut cells) = (0.0, 0_u32);
    let mut add = |a: f64, b: f64| {
        let d = a * scale - b / scale;
        chi2 += d * d / (a + b);
        cells += 1;
    };
    let mut pooled = (0.0, 0.0);
    for (&a, &b) in counted.iter().zip(others) {
        if a + b < 2.0 * FEWEST_EXPECTED {
            pooled = (pooled.0 + a, pooled.1 + b);
        } else {
            add(a, b);
        }
    }
    if pooled.0 + pooled.1 > 0.0 {
        add(pooled.0, pooled.1);
    }
    match cells {
        0 | 1 => 1.0,
        cells => chi_square_tail(chi2, f64::from(cells - 1)),
    }
}

/// Returns the p-value and the degrees of freedom.
fn compare(counted: &[f64], expected: &[f64]) -> (f64, f64) {
    let (mut chi2, mut cells) = (0.0, 0_u32);
    let (mut pooled_counted, mut pooled_expected) = (0.0, 0.0);
    for (&c, &e) in counted.iter().zip(expected) {
        if e < FEWEST_EXPECTED {
            pooled_counted += c;
            pooled_expected += e;
        } else {
            chi2 += (c - e) * (c - e) / e;
            cells += 1;
        }
    }
    let mut has_impossible_samples = false;
    if pooled_expected >= FEWEST_EXPECTED {
        let d = pooled_counted - pooled_expected;
        chi2 += d * d / pooled_expected;
        cells += 1;
    } else {
        // The pool expects hardly any samples: reject if it has many.
        let most = pooled_expected + 8.0 * (pooled_expected + FEWEST_EXPECTED).sqrt();
        has_impossible_samples = pooled_counted > most;
    }
    let degrees = f64::from(cells.max(1) - 1);
    let p = if has_impossible_samples {
        0.0
    } else if cells < 2 {
        1.0
    } else {
        chi_square_tail(chi2, degrees)
    };
    (p, degrees)
}

/// Returns the noncentrality at which a χ² test with this probability of a false alarm fails to
/// reject with the same probability.
fn detectable_noncentrality(degrees: f64, alarm: f64) -> f64 {
    // Both results need only a few digits. The brackets contain them for any alarm above 1e-300.
    let most = 1e5 + 10.0 * degrees;
    let limit = bisect(most, |x| chi_square_tail(x, degrees) > alarm);
    bisect(most, |lambda| {
        noncentral_cdf(limit, degrees, lambda) > alarm
    })
}

/// Returns the point in `0..most` at which `is_below`, which is true at 0, becomes false.
fn bisect(most: f64, is_below: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, most);
    for _ in 0..48 {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Returns the probability that a noncentral χ² variable is at most `x`. The variable is a mixture
/// of central ones: with the probability that a Poisson variable of mean λ/2 is j it has 2j more
/// degrees of freedom (Johnson, Kotz, Balakrishnan: "Continuous univariate distributions", volume
/// 2, 1995, equation 29.2).
fn noncentral_cdf(x: f64, degrees: f64, lambda: f64) -> f64 {
    let mean = 0.5 * lambda;
    let spread = 12.0 * (mean + 16.0).sqrt();
    let (from, to) = ((mean - spread).max(0.0) as u32, (mean + spread) as u32);
    (from..=to)
        .map(|j| {
            let j = f64::from(j);
            let log_chance = if mean > 0.0 {
                j * math::ln(mean) - mean - libm::lgamma(j + 1.0)
            } else if j > 0.0 {
                f64::NEG_INFINITY
            } else {
                0.0
            };
            math::exp(log_chance) * (1.0 - chi_square_tail(x, degrees + 2.0 * j))
        })
        .sum()
}

fn cell_of(w: Vec3) -> usize {
    let row = (0.5 * (w.z + 1.0) * ROWS as f64) as usize;
    let turns = (math::atan2(w.y, w.x) / TAU).rem_euclid(1.0);
    let column = (turns * COLUMNS as f64) as usize;
    row.min(ROWS - 1) * COLUMNS + column.min(COLUMNS - 1)
}

/// Integrates `pdf` over a cell. Equal steps in z and angle have equal areas, so all steps have the
/// same weight.
fn integrate(cell: usize, pdf: &impl Fn(Vec3) -> f64) -> f64 {
    let (row, column) = (cell / COLUMNS, cell % COLUMNS);
    let mut sum = 0.0;
    for i in 0..STEPS {
        let z = -1.0 + 2.0 * (row as f64 + (i as f64 + 0.5) / STEPS as f64) / ROWS as f64;
        for j in 0..STEPS {
            let turns = (column as f64 + (j as f64 + 0.5) / STEPS as f64) / COLUMNS as f64;
            sum += pdf(kit::warp::on_sphere(z, turns));
        }
    }
    let cell_area = 2.0 * TAU / (ROWS * COLUMNS) as f64;
    sum * cell_area / (STEPS * STEPS) as f64
}

/// Returns the probability that a χ² variable with `degrees` degrees of freedom is at least `x`:
/// the regularised incomplete gamma function `Q(degrees/2, x/2)`, by its series below the mean and
/// by its continued fraction above (Numerical Recipes, 6.2).
pub fn chi_square_tail(x: f64, degrees: f64) -> f64 {
    let (a, x) = (0.5 * degrees, 0.5 * x);
    if x <= 0.0 {
        return 1.0;
    }
    if !x.is_finite() {
        return 0.0;
    }
    let front = math::exp(a * math::ln(x) - x - libm::lgamma(a));
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * f64::EPSILON {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return 1.0 - front * sum;
    }
    // Lentz's method; the fraction has no zero here.
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (f64::MAX, 1.0 / b);
    let mut h = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        let an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (d * c - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    front * h
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::warp;

    /// Probability of a false alarm of one test here. The points are fixed, so each test either
    /// always passes or always fails.
    const ALARM: f64 = 1e-6;

    #[test]
    fn two_lists_of_counts_are_compared_with_each_other() {
        let p = test_same_distribution;
        assert_eq!(p(&[50.0, 50.0], &[50.0, 50.0]), 1.0);
        // (60 - 40)²/100 twice: χ² = 8 with one degree of freedom.
        assert!((p(&[60.0, 40.0], &[40.0, 60.0]) - chi_square_tail(8.0, 1.0)).abs() < 1e-12);
        // Twice as many samples of the same distribution.
        assert!((p(&[60.0, 40.0], &[120.0, 80.0]) - 1.0).abs() < 1e-12);
        assert_eq!(p(&[9.0, 1.0], &[0.0, 0.0]), 0.0);
        assert_eq!(p(&[], &[]), 1.0);
    }

    #[test]
    fn chi_square_tails_match_known_values() {
        // With two degrees of freedom the tail is exp(-x/2).
        for x in [0.1, 1.0, 5.0, 40.0] {
            assert!((chi_square_tail(x, 2.0) / math::exp(-0.5 * x) - 1.0).abs() < 1e-12);
        }
        // Quantile tables.
        assert!((chi_square_tail(124.342, 100.0) - 0.05).abs() < 1e-5);
        assert!((chi_square_tail(77.929, 100.0) - 0.95).abs() < 1e-5);
    }

    #[test]
    fn uniform_directions_fit_the_uniform_density() {
        let sphere = |u, _| Some(warp::uniform_sphere(u));
        let fit = fit_samples(100_000, 1, sphere, |_| 0.5 / TAU);
        assert!(fit.p > ALARM, "{fit:?}");
        let upper = |w: Vec3| if w.z > 0.0 { 1.0 / TAU } else { 0.0 };
        let hemisphere = |u, _| Some(warp::uniform_hemisphere(u));
        let fit = fit_samples(100_000, 2, hemisphere, upper);
        assert!(fit.p > ALARM, "{fit:?}");
    }

    /// The test can fail: uniform directions follow neither the cosine nor twice the uniform
    /// density.
    #[test]
    fn a_wrong_density_is_rejected() {
        let cosine = |w: Vec3| w.z.max(0.0) / std::f64::consts::PI;
        let hemisphere = |u, _| Some(warp::uniform_hemisphere(u));
        let fit = fit_samples(20_000, 3, hemisphere, cosine);
        assert!(fit.p < ALARM, "{fit:?}");
        let double = |w: Vec3| if w.z > 0.0 { 2.0 / TAU } else { 0.0 };
        let fit = fit_samples(20_000, 4, hemisphere, double);
        assert!(fit.p < ALARM, "{fit:?}");
    }

    /// Two cells that have the shares 1/2 ± ε/2: χ² is the square of a normal variable whose mean
    /// is √n·ε, so the test is a two-sided z-test, whose power is known. The power is 1/2 if the
    /// mean is at the limit.
    #[test]
    fn the_detectable_deviation_of_two_cells_is_that_of_a_z_test() {
        for (alarm, n) in [(1e-3, 100.0), (1e-6, 1e4), (1e-8, 1e6)] {
            let fit = Fit {
                p: 1.0,
                samples: n,
                degrees: 1.0,
            };
            let z = crate::critical_z(alarm);
            // Only one tail contributes to the false negatives.
            let missed = crate::critical_z(2.0 * alarm);
            let sure = fit.detectable_deviation(alarm) * n.sqrt();
            assert!((sure / (z + missed) - 1.0).abs() < 1e-6, "{sure} {z}");
        }
        let limit = 4.0_f64;
        assert!((noncentral_cdf(limit * limit, 1.0, limit * limit) - 0.5).abs() < 1e-6);
    }

    /// Directions whose density differs from the uniform one by the factor 1 + √2·ε·cos(2φ) have
    /// the deviation ε.
    #[test]
    fn a_detectable_deviation_is_detected() {
        let upper = |w: Vec3| if w.z > 0.0 { 1.0 / TAU } else { 0.0 };
        let uneven = |seed: u64, deviation: f64| {
            let sample = |u: Vec2, _| {
                let even = warp::uniform_hemisphere(u);
                let warped = warped_angle(TAU * u.y, std::f64::consts::SQRT_2 * deviation);
                Some(warp::on_sphere(even.z, warped / TAU))
            };
            fit_samples(8000, seed, sample, upper)
        };
        let sure = uneven(0, 0.0).detectable_deviation(ALARM);
        assert!((0.1..0.25).contains(&sure), "{sure}");
        for seed in 0..20 {
            assert!(uneven(seed, 0.0).p > ALARM);
            // The cosine partly averages out within a cell.
            let p = uneven(seed, 1.01 * sure).p;
            assert!(p < ALARM, "seed {seed}: p = {p:e}");
        }
        assert!(uneven(0, 0.3 * sure).p > ALARM);
    }

    /// Returns the angle below which the density `1 + a·cos(2φ)` has the integral that the density
    /// 1 has below `even`.
    fn warped_angle(even: f64, a: f64) -> f64 {
        bisect(TAU, |phi| phi + 0.5 * a * math::sin_cos(2.0 * phi).0 < even)
    }
}
