//! Pearson's χ² test: do directions fall where their density says?
//!
//! The sphere of directions is cut into cells, samples are counted in each, the density is integrated over each, and
//! `χ² = Σ (counted - expected)² / expected` is compared with its distribution. A cosine forgotten or a pdf off by a
//! factor is caught, which the eye does not see in a noisy picture.

use kit::math;
use kit::{Vec2, Vec3};
use std::f64::consts::TAU;

/// Rows of cells, equal in z.
const ROWS: usize = 16;
/// Columns of cells, equal in angle around z.
const COLUMNS: usize = 32;
/// Steps of the midpoint rule along each side of a cell.
const STEPS: usize = 48;
/// Cells with fewer expected samples are taken together: χ² is only then distributed as it should (Cochran 1952).
const FEWEST_EXPECTED: f64 = 8.0;

/// How well `samples` directions of `sample` fit the density `pdf`.
///
/// `sample` maps points of the unit square to unit directions, or to `None` where it draws none; those count as
/// lost, so a pdf that integrates to less than 1 must lose the rest. `pdf` is the density with respect to solid angle.
/// The points are a fixed sequence: the same fit on every platform.
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

/// How well directions fit a density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// How often directions that do follow the density would look at least as far off: the p-value.
    pub p: f64,
    /// How many directions there were.
    pub samples: f64,
    /// Degrees of freedom: one less than there are cells to compare.
    pub degrees: f64,
}

impl Fit {
    /// The smallest deviation that a test with this chance of a false alarm is sure to see: the root mean square, over
    /// directions that follow the density, of the share by which the true density differs from it. Directions that
    /// deviate by as much stay unseen no more often than right ones are accused.
    ///
    /// With a deviation ε of n samples χ² follows the noncentral distribution with the noncentrality `n·ε²`. What evens
    /// out within a cell (1/16 of the height, 1/32 of a turn) is not seen.
    pub fn smallest_sure_deviation(&self, alarm: f64) -> f64 {
        (smallest_sure_noncentrality(self.degrees, alarm) / self.samples).sqrt()
    }
}

/// How well `directions`, drawn from points that do not depend on them, fit the density `pdf`.
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

/// The p-value of `counted` against `expected`, taking small expectations together.
pub fn test_counts(counted: &[f64], expected: &[f64]) -> f64 {
    compare(counted, expected).0
}

/// The p-value, and its degrees of freedom.
fn compare(counted: &[f64], expected: &[f64]) -> (f64, f64) {
    let (mut chi2, mut cells) = (0.0, 0_u32);
    let (mut rest_counted, mut rest_expected) = (0.0, 0.0);
    for (&c, &e) in counted.iter().zip(expected) {
        if e < FEWEST_EXPECTED {
            rest_counted += c;
            rest_expected += e;
        } else {
            chi2 += (c - e) * (c - e) / e;
            cells += 1;
        }
    }
    let mut nowhere_to_be = false;
    if rest_expected >= FEWEST_EXPECTED {
        let d = rest_counted - rest_expected;
        chi2 += d * d / rest_expected;
        cells += 1;
    } else {
        // Samples where there should be next to none.
        let most = rest_expected + 8.0 * (rest_expected + FEWEST_EXPECTED).sqrt();
        nowhere_to_be = rest_counted > most;
    }
    let degrees = f64::from(cells.max(1) - 1);
    let p = if nowhere_to_be {
        0.0
    } else if cells < 2 {
        1.0
    } else {
        chi_square_tail(chi2, degrees)
    };
    (p, degrees)
}

/// The noncentrality from which on a χ² test with this chance of a false alarm misses no more often than that.
fn smallest_sure_noncentrality(degrees: f64, alarm: f64) -> f64 {
    // Both are wanted to a few digits; what they are looked for in holds them for any alarm above 1e-300.
    let most = 1e5 + 10.0 * degrees;
    let limit = bisect(most, |x| chi_square_tail(x, degrees) > alarm);
    bisect(most, |lambda| {
        noncentral_at_most(limit, degrees, lambda) > alarm
    })
}

/// Where `is_below`, true at 0, stops to be true.
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

/// The chance that a noncentral χ² variable is at most `x`: with the chance of a Poisson variable of the mean λ/2 it has two
/// more degrees of freedom for each of its counts (Johnson, Kotz, Balakrishnan: "Continuous univariate distributions",
/// volume 2, 1995, equation 29.2).
fn noncentral_at_most(x: f64, degrees: f64, lambda: f64) -> f64 {
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

/// Integral of `pdf` over a cell: z and angle are equal in area, so each step counts the same.
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

/// The chance that a χ² variable with `degrees` degrees of freedom is at least `x`: the regularised incomplete gamma
/// function `Q(degrees/2, x/2)`, by its series below the mean and its continued fraction above (Numerical Recipes, 6.2).
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

    /// Chance of a false alarm of one test here. The points are fixed, so it either always passes or never.
    const ALARM: f64 = 1e-6;

    #[test]
    fn tails_of_the_chi_square_distribution() {
        // With two degrees of freedom it is exp(-x/2).
        for x in [0.1, 1.0, 5.0, 40.0] {
            assert!((chi_square_tail(x, 2.0) / math::exp(-0.5 * x) - 1.0).abs() < 1e-12);
        }
        // Quantile tables.
        assert!((chi_square_tail(124.342, 100.0) - 0.05).abs() < 1e-5);
        assert!((chi_square_tail(77.929, 100.0) - 0.95).abs() < 1e-5);
    }

    #[test]
    fn uniform_directions_are_uniform() {
        let sphere = |u, _| Some(warp::uniform_sphere(u));
        let fit = fit_samples(100_000, 1, sphere, |_| 0.5 / TAU);
        assert!(fit.p > ALARM, "{fit:?}");
        let upper = |w: Vec3| if w.z > 0.0 { 1.0 / TAU } else { 0.0 };
        let hemisphere = |u, _| Some(warp::uniform_hemisphere(u));
        let fit = fit_samples(100_000, 2, hemisphere, upper);
        assert!(fit.p > ALARM, "{fit:?}");
    }

    /// The test can fail: uniform directions are not distributed by the cosine, nor twice as dense.
    #[test]
    fn a_wrong_density_is_caught() {
        let cosine = |w: Vec3| w.z.max(0.0) / std::f64::consts::PI;
        let hemisphere = |u, _| Some(warp::uniform_hemisphere(u));
        let fit = fit_samples(20_000, 3, hemisphere, cosine);
        assert!(fit.p < ALARM, "{fit:?}");
        let double = |w: Vec3| if w.z > 0.0 { 2.0 / TAU } else { 0.0 };
        let fit = fit_samples(20_000, 4, hemisphere, double);
        assert!(fit.p < ALARM, "{fit:?}");
    }

    /// Of two cells a share of 1/2 ± ε/2 each: χ² is the square of a normal variable that is off by √n·ε, so the test is
    /// a two-sided z-test, whose power is known. And it is 1/2 where the deviation is at the limit itself.
    #[test]
    fn the_sure_deviation_of_two_cells_is_that_of_a_z_test() {
        for (alarm, n) in [(1e-3, 100.0), (1e-6, 1e4), (1e-8, 1e6)] {
            let fit = Fit {
                p: 1.0,
                samples: n,
                degrees: 1.0,
            };
            let z = crate::z_of_alarm(alarm);
            // What is missed lies on one side only.
            let missed = crate::z_of_alarm(2.0 * alarm);
            let sure = fit.smallest_sure_deviation(alarm) * n.sqrt();
            assert!((sure / (z + missed) - 1.0).abs() < 1e-6, "{sure} {z}");
        }
        let limit = 4.0_f64;
        assert!((noncentral_at_most(limit * limit, 1.0, limit * limit) - 0.5).abs() < 1e-6);
    }

    /// Directions whose density differs from uniform by the share √2·ε·cos(2φ) have the deviation ε.
    #[test]
    fn a_deviation_that_is_sure_to_be_seen_is_seen() {
        let upper = |w: Vec3| if w.z > 0.0 { 1.0 / TAU } else { 0.0 };
        let uneven = |seed: u64, deviation: f64| {
            let sample = |u: Vec2, _| {
                let even = warp::uniform_hemisphere(u);
                let squeezed = squeeze(TAU * u.y, std::f64::consts::SQRT_2 * deviation);
                Some(warp::on_sphere(even.z, squeezed / TAU))
            };
            fit_samples(8000, seed, sample, upper)
        };
        let sure = uneven(0, 0.0).smallest_sure_deviation(ALARM);
        assert!((0.1..0.25).contains(&sure), "{sure}");
        for seed in 0..20 {
            assert!(uneven(seed, 0.0).p > ALARM);
            // Within a cell the cosine evens out a little.
            let p = uneven(seed, 1.01 * sure).p;
            assert!(p < ALARM, "seed {seed}: p = {p:e}");
        }
        assert!(uneven(0, 0.3 * sure).p > ALARM);
    }

    /// The angle below which a density of `1 + a·cos(2φ)` over a turn has as much as an even one below `even`.
    fn squeeze(even: f64, a: f64) -> f64 {
        bisect(TAU, |phi| phi + 0.5 * a * math::sin_cos(2.0 * phi).0 < even)
    }
}
