//! Judging random answers: how often a right one would look this wrong.
//!
//! All tests of a run together accuse right code with a chance of at most one in a million (Šidák's
//! correction over the most tests that a run makes). The other side is what they are sure to see:
//! each finding carries it, each case says it to students ("A bias of 6 % is sure to be seen"), and
//! a test of the goldens holds the two together.

use super::tally::{Aspect, Class, Tally};
use kit::{Tally as SampleTally, Vec3};
use statistics::chi_square;
use statistics::{detectable_bias, sidak, two_sided};

/// Chance that a whole run accuses right code because of its luck.
const RUN_FALSE_ALARM: f64 = 1e-6;

/// A run makes no more tests by chance than this.
pub(crate) const MAX_TESTS: usize = 100;

/// Estimates below this number are not tested: a mean of few is not normally distributed.
pub(crate) const MIN_ESTIMATES: usize = 500;

/// Chance of a false alarm of each test.
fn test_false_alarm() -> f64 {
    sidak(RUN_FALSE_ALARM, MAX_TESTS)
}

/// Whether the mean of `numbers` is `truth`, as far as their spread lets one tell.
pub(crate) fn mean(tally: &mut Tally, what: &str, numbers: &SampleTally, truth: f64) {
    let z = numbers.z_against(truth);
    let wrong = two_sided(z).is_nan() || two_sided(z) < test_false_alarm();
    let class = wrong.then(|| Class::of_number(numbers.mean(), truth));
    let sure = detectable_bias(numbers.standard_error(), test_false_alarm()) / truth.abs();
    tally.expect(Aspect::Mean);
    tally.set_detectable(Aspect::Mean, sure);
    tally.judge_class(Aspect::Mean, 0, class, z.abs(), || {
        format!(
            "the mean of {} {what} is {:.5} ± {:.5}, right is {truth:.5}: {:.1} standard errors off, where {:.1} are allowed (a bias of {:.1} % is sure to be seen)",
            numbers.count(),
            numbers.mean(),
            numbers.standard_error(),
            z.abs(),
            statistics::critical_z(test_false_alarm()),
            100.0 * sure
        )
    });
}

/// Whether `directions` fall where the density `pdf` says.
pub(crate) fn spread(
    tally: &mut Tally,
    directions: &[Option<Vec3>],
    pdf: impl Fn(Vec3) -> f64,
    right: &str,
) {
    tally.expect(Aspect::Spread);
    // Too few are none: whoever asks for next to nothing is not even.
    if directions.len() < MIN_ESTIMATES {
        tally.judge(Aspect::Spread, 0, false, f64::INFINITY, || {
            format!("there are {} directions only", directions.len())
        });
        return;
    }
    let fit = chi_square::fit(directions.iter().copied(), pdf);
    let sure = fit.detectable_deviation(test_false_alarm());
    tally.set_detectable(Aspect::Spread, sure);
    let badness = -fit.p.max(1e-300).log10();
    let class = (fit.p < test_false_alarm()).then(|| mean_direction_class(directions));
    tally.judge_class(Aspect::Spread, 0, class, badness, || {
        format!(
            "{} directions are not distributed {right}: a right sample looks so uneven with a chance of {:.0e}, where {:.0e} is allowed (a deviation of {:.0} % is sure to be seen)",
            directions.len(),
            fit.p,
            test_false_alarm(),
            100.0 * sure
        )
    });
}

/// How finely the middle of directions tells mistakes apart, across the normal and along it: so
/// coarse that chance does not round it up and down by turns. Along it the middles of a uniform
/// hemisphere and of one drawn by the cosine, 1/2 and 2/3, are whole.
const MEAN_DIRECTION_STEPS: Vec3 = Vec3::new(8.0, 8.0, 24.0);

/// The class of directions that are not distributed rightly: where their middle lies.
fn mean_direction_class(directions: &[Option<Vec3>]) -> Class {
    let sum: Vec3 = directions.iter().flatten().sum();
    let middle = MEAN_DIRECTION_STEPS * sum / directions.len() as f64;
    if middle.is_nan() {
        return Class::NotANumber;
    }
    Class::Towards(middle.to_array().map(|along| along.round() as i8))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use wire::Work;

    #[test]
    fn a_family_has_room_for_all_tests_of_a_run() {
        let by_chance = |spec: &cases::Spec| match &spec.work {
            Work::Lambert(probes) => probes.len() >= MIN_ESTIMATES,
            Work::Direct(work) => work.points.len() >= MIN_ESTIMATES,
            Work::Specular(calls) => calls.len() >= MIN_ESTIMATES,
            Work::Roulette(work) => work.numbers.len() >= MIN_ESTIMATES,
            _ => false,
        };
        let cases = cases::all(0);
        // No case makes more than two of them.
        let tests = 2 * cases.iter().filter(|spec| by_chance(spec)).count();
        assert!((20..=MAX_TESTS).contains(&tests), "{tests}");
    }

    #[test]
    fn a_bias_that_is_sure_to_be_seen_is_seen() {
        let numbers: SampleTally = (0..10_000).map(|i| f64::from(i % 2)).collect();
        let sure = detectable_bias(numbers.standard_error(), test_false_alarm());
        let wrong = |truth: f64| {
            let mut tally = Tally::default();
            mean(&mut tally, "numbers", &numbers, truth);
            !tally.into_findings()[0].passed()
        };
        assert!(!wrong(0.5));
        assert!(wrong(0.5 + sure) && wrong(0.5 - sure) && wrong(f64::NAN));
        assert!(!wrong(0.5 + 0.4 * sure));
    }
}
