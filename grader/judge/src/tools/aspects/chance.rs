//! Statistical tests of random answers: how often would right code give such an answer?
//!
//! All tests of a run together have a false alarm with a probability of at most one in a million
//! (Šidák's correction over the largest number of tests in a run). Their power is the deviation
//! that they always detect: each finding has it, each case states it for students ("A bias of 6 %
//! is always detected"), and a test of the goldens checks that the two agree.

use crate::plural;
use crate::tools::findings::{Aspect, Class, DirectionCounts, Findings, told_apart};
use kit::{Tally, Vec3};
use statistics::chi_square;
use statistics::{detectable_bias, sidak, two_sided};
use std::collections::HashSet;
use std::f64::consts::{PI, TAU};

/// Probability that a whole run reports a false alarm on right code.
const RUN_FALSE_ALARM: f64 = 1e-6;

/// The largest number of statistical tests in a run.
pub(crate) const MAX_TESTS: usize = 100;

/// The smallest number of estimates that is tested: a mean of fewer is not normally distributed.
pub(crate) const MIN_ESTIMATES: usize = 500;

/// Why the distribution of a few random results is not judged.
pub(crate) const TOO_FEW: &str =
    "any random numbers are right, and they are too few to test their distribution";

/// Probability of a false alarm of each test.
pub(crate) fn test_false_alarm() -> f64 {
    sidak(RUN_FALSE_ALARM, MAX_TESTS)
}

/// Tests whether the mean of `numbers` is `truth`, by its standard error (a z-test).
pub(crate) fn mean(findings: &mut Findings, what: &str, numbers: &Tally, truth: f64) {
    let z = numbers.z_against(truth);
    let wrong = two_sided(z).is_nan() || two_sided(z) < test_false_alarm();
    let all_equal = numbers.count() > 1 && numbers.variance() == 0.0;
    // Where all are 0 the size says more.
    let class = wrong.then(|| match all_equal && numbers.mean() != 0.0 {
        true => ALWAYS_THE_SAME,
        false => Class::of_number(numbers.mean(), truth),
    });
    let sure = detectable_bias(numbers.standard_error(), test_false_alarm()) / truth.abs();
    findings.expect(Aspect::Mean);
    findings.set_detectable(Aspect::Mean, sure);
    findings.judge_class(Aspect::Mean, 0, class, z.abs(), || {
        let [mean, truth] = told_apart(numbers.mean(), truth, 5);
        if all_equal {
            let random = match numbers.mean() {
                0.0 => format!("the mean {truth}"),
                _ => format!("random ones with the mean {truth}. {FROM_THE_SAMPLER}"),
            };
            return format!(
                "your result: {} {what} that are all {mean}; expected: {random}",
                numbers.count()
            );
        }
        format!(
            "your result: the mean of {} {what} is {mean} ± {:.5}; expected: {truth} (off by {:.1} standard errors, allowed {:.1}; a bias of {:.1} % is always detected)",
            numbers.count(),
            numbers.standard_error(),
            z.abs(),
            statistics::critical_z(test_false_alarm()),
            100.0 * sure
        )
    });
}

/// The probability that a count is at least as far from `expected` as `counted`, on either side, if
/// it counts rare events (Poisson).
pub(crate) fn poisson_two_sided(counted: usize, expected: f64) -> f64 {
    let mut term = kit::math::exp(-expected);
    let mut below = 0.0;
    for i in 0..counted {
        below += term;
        term *= expected / (i + 1) as f64;
    }
    (2.0 * f64::min(below + term, 1.0 - below)).min(1.0)
}

/// Tests whether `directions` are distributed with the density `pdf` (a χ² test).
pub(crate) fn spread(
    findings: &mut Findings,
    directions: &[Option<Vec3>],
    pdf: impl Fn(Vec3) -> f64,
    right: &str,
) {
    findings.expect(Aspect::Spread);
    // Fewer directions cannot be tested, and count as wrong.
    if directions.len() < MIN_ESTIMATES {
        findings.judge(Aspect::Spread, 0, false, f64::INFINITY, || {
            format!(
                "only {} directions were sampled; too few to test their distribution",
                directions.len()
            )
        });
        return;
    }
    let fit = chi_square::fit(directions.iter().copied(), &pdf);
    let sure = fit.detectable_deviation(test_false_alarm());
    findings.set_detectable(Aspect::Spread, sure);
    let badness = -fit.p.max(1e-300).log10();
    let different = different(directions);
    let repeated = 2 * different < directions.len();
    let class = (fit.p < test_false_alarm()).then(|| match repeated {
        true => ALWAYS_THE_SAME,
        false => distribution_class(directions),
    });
    findings.judge_class(Aspect::Spread, 0, class, badness, || {
        if repeated {
            return format!(
                "your {} directions have only {}. {FROM_THE_SAMPLER}",
                directions.len(),
                plural(different, "value", "different values")
            );
        }
        format!(
            "your {} directions are not distributed {right}{}: right directions deviate this much with a probability {}, allowed is {:.0e} (a deviation of {:.0} % is always detected)",
            directions.len(),
            means(directions, &pdf),
            match fit.p {
                0.0 => "below 1e-300".into(),
                p => format!("of {p:.0e}"),
            },
            test_false_alarm(),
            100.0 * sure
        )
    });
}

/// Which way the mean of `directions` differs from that of the density `pdf`; empty if two decimals
/// of both are the same.
fn means(directions: &[Option<Vec3>], pdf: impl Fn(Vec3) -> f64) -> String {
    const STEPS: u32 = 200;
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let mut right = Vec3::ZERO;
    for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
        let z = 2.0 * middle(i) - 1.0;
        let (sin, cos) = kit::math::sin_cos(TAU * middle(j));
        let across = (1.0 - z * z).sqrt();
        let d = Vec3::new(across * cos, across * sin, z);
        right += pdf(d) * d;
    }
    let right = right * (4.0 * PI / f64::from(STEPS * STEPS));
    let yours = directions.iter().flatten().sum::<Vec3>() / directions.len() as f64;
    let [yours, right] = [yours, right].map(|mean| {
        // Adding 0 turns -0 into 0.
        let [x, y, z] = mean.to_array().map(|x| (100.0 * x).round() / 100.0 + 0.0);
        format!("({x}, {y}, {z})")
    });
    match yours == right {
        true => String::new(),
        false => format!(" (their mean is {yours}, that of right ones {right})"),
    }
}

/// The class of random results that are the same in each call.
const ALWAYS_THE_SAME: Class = Class::Named("the same in each call");

/// The question about random results that are the same in each call.
const FROM_THE_SAMPLER: &str =
    "Do they come from the random numbers that the function is given, or from its sampler?";

/// The number of different directions, bit for bit.
fn different(directions: &[Option<Vec3>]) -> usize {
    let bits = directions
        .iter()
        .flatten()
        .map(|d| d.to_array().map(f64::to_bits));
    bits.collect::<HashSet<_>>().len()
}

/// The class of wrongly distributed directions.
fn distribution_class(directions: &[Option<Vec3>]) -> Class {
    let is_nan = directions.iter().flatten().any(|d| d.is_nan());
    match is_nan {
        true => Class::NotANumber,
        false => Class::Distribution(DirectionCounts::of(directions)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_that_are_always_the_same_have_a_class_of_their_own() {
        let class = |judge: &dyn Fn(&mut Findings)| {
            let mut findings = Findings::default();
            judge(&mut findings);
            let list = findings.into_vec();
            list[0].faults.first().map(|fault| fault.class)
        };
        let of_mean = |numbers: &[f64]| {
            let numbers: Tally = numbers.iter().cycle().take(1000).copied().collect();
            class(&|findings| mean(findings, "estimates", &numbers, 0.5))
        };
        assert_eq!(of_mean(&[0.25]), Some(ALWAYS_THE_SAME));
        assert_eq!(of_mean(&[0.5]), None);
        assert!(matches!(of_mean(&[0.2, 0.3]), Some(Class::Ratio(_))));
        let of_directions = |z: &[f64]| {
            let of = |z: &f64| Some(Vec3::new((1.0 - z * z).sqrt(), 0.0, *z));
            // Enough for every cell of the test.
            let directions: Vec<_> = z.iter().cycle().take(8000).map(of).collect();
            let pdf = |d: Vec3| {
                if d.z > 0.0 {
                    0.5 / std::f64::consts::PI
                } else {
                    0.0
                }
            };
            class(&|findings| spread(findings, &directions, pdf, "uniformly"))
        };
        assert_eq!(of_directions(&[0.3, 0.6]), Some(ALWAYS_THE_SAME));
        let all: Vec<f64> = (0..8000).map(|i| f64::from(i) / 8000.0).collect();
        assert!(matches!(of_directions(&all), Some(Class::Distribution(_))));
    }

    #[test]
    fn directions_in_half_of_the_turn_have_another_mean_than_right_ones() {
        let by_cosine = |d: Vec3| d.z.max(0.0) / PI;
        let directions = |turn: f64| {
            let of = move |i: u32| {
                let (height, angle) = (f64::from(i % 100) + 0.5, f64::from(i / 100) + 0.5);
                let (sin, cos) = (turn * angle / 100.0).sin_cos();
                let z = (height / 100.0).sqrt();
                let across = (1.0 - z * z).sqrt();
                Some(Vec3::new(across * cos, across * sin, z))
            };
            (0..10_000).map(of).collect::<Vec<_>>()
        };
        assert_eq!(means(&directions(TAU), by_cosine), "");
        let half = means(&directions(PI), by_cosine);
        // The mean distance from the axis, 2/3, times that of a sine over half a turn, 2/pi.
        let expected = " (their mean is (0, 0.42, 0.67), that of right ones (0, 0, 0.67))";
        assert_eq!(half, expected);
    }

    #[test]
    fn rare_events_are_counted_on_both_sides() {
        let p = poisson_two_sided;
        // None of two that are expected: e⁻², on either side.
        assert!((p(0, 2.0) - 2.0 * (-2.0_f64).exp()).abs() < 1e-15);
        assert!((p(1, 2.0) - 6.0 * (-2.0_f64).exp()).abs() < 1e-12);
        assert_eq!(p(2, 2.0), 1.0);
        assert!(p(20, 2.0) < 1e-10 && p(0, 32.0) < 1e-13 && p(32, 32.0) > 0.9);
    }

    #[test]
    fn a_detectable_bias_is_detected() {
        let numbers: Tally = (0..10_000).map(|i| f64::from(i % 2)).collect();
        let sure = detectable_bias(numbers.standard_error(), test_false_alarm());
        let wrong = |truth: f64| {
            let mut findings = Findings::default();
            mean(&mut findings, "numbers", &numbers, truth);
            !findings.into_vec()[0].passed()
        };
        assert!(!wrong(0.5));
        assert!(wrong(0.5 + sure) && wrong(0.5 - sure) && wrong(f64::NAN));
        assert!(!wrong(0.5 + 0.4 * sure));
    }
}
