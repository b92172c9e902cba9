//! Compares a library's answers with the truth.

use crate::case::Answers;
use crate::columns::Measure;

/// An answer whose t differs by more than this fraction is wrong, not rounded.
const FAR: f64 = 1e-3;

/// The precision in which a library computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precision {
    /// `f32`.
    Single,
    /// `f64`.
    Double,
}

/// What came of a column.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outcome {
    /// The number of rays that the library answered.
    pub(crate) rays: usize,
    /// Lost, invented and far off answers.
    pub(crate) lost: usize,
    pub(crate) invented: usize,
    pub(crate) far_off: usize,
    /// Counts of hits that differ from the truth; `None` if none are reported.
    pub(crate) wrong_counts: Option<usize>,
    /// The median and the largest error of t in units in the last place.
    pub(crate) ulps: Option<(f64, f64)>,
}

/// Judges the answers to the first rays of a case.
pub(crate) fn judge(truth: &Answers, answers: &Answers, precision: Precision) -> Outcome {
    let pairs = || truth.hits.iter().zip(&answers.hits);
    let count = |is: fn(f64, f64) -> bool| pairs().filter(|(t, a)| is(t[0], a[0])).count();
    let counted = pairs().filter(|(_, answer)| !answer[2].is_nan());
    let wrong = counted
        .clone()
        .filter(|(truth, answer)| truth[2] != answer[2]);
    let mut ulps: Vec<f64> = pairs()
        .filter(|(truth, answer)| truth[0].is_finite() && answer[0].is_finite())
        .map(|(truth, answer)| (answer[0] - truth[0]).abs() / unit(truth[0], precision))
        .collect();
    ulps.sort_by(f64::total_cmp);
    Outcome {
        rays: answers.hits.len(),
        lost: count(|truth, answer| truth.is_finite() && !answer.is_finite()),
        invented: count(|truth, answer| !truth.is_finite() && answer.is_finite()),
        far_off: count(|truth, answer| {
            truth.is_finite() && answer.is_finite() && (answer - truth).abs() > FAR * truth
        }),
        wrong_counts: counted.clone().next().map(|_| wrong.count()),
        ulps: ulps.last().map(|last| (ulps[ulps.len() / 2], *last)),
    }
}

impl Outcome {
    /// The number in the table: parts in a million, per cent, or units in the last place. `None` if
    /// the library does not report what the column needs.
    pub(crate) fn value(&self, measure: Measure) -> Option<f64> {
        let share = |count: usize| count as f64 / self.rays.max(1) as f64;
        match measure {
            Measure::Wrong => Some(1e6 * share(self.lost + self.invented + self.far_off)),
            Measure::Found => Some(100.0 * share(self.rays - self.lost)),
            Measure::Count => self.wrong_counts.map(|wrong| 100.0 * share(wrong)),
            Measure::Ulps => self.ulps.map(|(_, largest)| largest),
        }
    }
}

/// The distance between the numbers of `precision` next to `t`.
fn unit(t: f64, precision: Precision) -> f64 {
    match precision {
        Precision::Single => {
            let t = t as f32;
            f64::from(t.next_up() - t)
        }
        Precision::Double => t.next_up() - t,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answers(hits: &[[f64; 3]]) -> Answers {
        Answers {
            seconds: 0.0,
            hits: hits.to_vec(),
        }
    }

    #[test]
    fn lost_invented_and_far_off_answers_are_counted() {
        let miss = [f64::INFINITY, -1.0, 0.0];
        let truth = answers(&[[1.0, 0.0, 2.0], miss, [2.0, 1.0, 2.0], [4.0, 1.0, 1.0]]);
        let found = answers(&[miss, [3.0, 7.0, f64::NAN], [2.1, 1.0, 2.0]]);
        let outcome = judge(&truth, &found, Precision::Double);
        assert_eq!((outcome.lost, outcome.invented, outcome.far_off), (1, 1, 1));
        // The fourth ray was not asked, the second has no count.
        assert_eq!((outcome.rays, outcome.wrong_counts), (3, Some(1)));
        assert_eq!(outcome.value(Measure::Wrong), Some(1e6));
        let ulps = outcome.value(Measure::Ulps).unwrap_or_default();
        assert!((ulps * 2_f64.powi(-51) - 0.1).abs() < 1e-12, "{ulps}");
    }

    #[test]
    fn an_error_is_measured_in_the_precision_of_the_library() {
        let truth = answers(&[[1.0, 0.0, 1.0]]);
        let off = answers(&[[1.0 + 2_f64.powi(-22), 0.0, 1.0]]);
        let largest = |precision| judge(&truth, &off, precision).value(Measure::Ulps);
        assert_eq!(largest(Precision::Single), Some(2.0));
        assert_eq!(largest(Precision::Double), Some(2_f64.powi(30)));
    }
}
