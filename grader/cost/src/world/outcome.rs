//! Compares answers with the truth.

use super::case::{Answers, RayAnswer};
use super::column::Measure;
use crate::precision::Precision;

/// An answer whose `t` differs by more than this fraction is wrong, not rounded.
const FAR: f64 = 1e-3;

/// The number of the table for the answers to the first rays of a case; `None` if they do not have
/// what the column measures.
pub(super) fn value(
    truth: &Answers,
    answers: &Answers,
    measure: Measure,
    precision: Precision,
) -> Option<f64> {
    let pairs: Vec<_> = truth.rays.iter().zip(&answers.rays).collect();
    let per = |whole: f64, is: fn(&RayAnswer, &RayAnswer) -> bool| {
        let count = pairs
            .iter()
            .filter(|(truth, answer)| is(truth, answer))
            .count();
        whole * count as f64 / pairs.len().max(1) as f64
    };
    match measure {
        Measure::Wrong => Some(per(1e6, is_wrong)),
        Measure::Found => Some(per(100.0, |_, answer| answer.t.is_finite())),
        Measure::Count => {
            let is_counted = pairs.iter().any(|(_, answer)| !answer.count.is_nan());
            is_counted.then(|| per(100.0, |truth, answer| truth.count != answer.count))
        }
        Measure::Ulps => {
            let found = pairs
                .iter()
                .filter(|(truth, answer)| !is_wrong(truth, answer));
            let ulps =
                found.map(|(truth, answer)| (answer.t - truth.t).abs() / ulp(truth.t, precision));
            ulps.reduce(f64::max)
        }
    }
}

/// Whether the answer loses the hit, invents one, or has another hit's `t`.
fn is_wrong(truth: &RayAnswer, answer: &RayAnswer) -> bool {
    match (truth.t.is_finite(), answer.t.is_finite()) {
        (true, true) => (answer.t - truth.t).abs() > FAR * truth.t,
        (is_hit, finds_hit) => is_hit != finds_hit,
    }
}

/// The distance from `t` to the next number of `precision`.
fn ulp(t: f64, precision: Precision) -> f64 {
    match precision {
        Precision::F64 => t.next_up() - t,
        Precision::F32 | Precision::F32InF64 => {
            let t = t as f32;
            f64::from(t.next_up() - t)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MISS: [f64; 2] = [f64::INFINITY, 0.0];

    /// Answers of these `t` and counts.
    fn answers(rays: &[[f64; 2]]) -> Answers {
        let answer = |[t, count]: &[f64; 2]| RayAnswer {
            t: *t,
            triangle: f64::NAN,
            count: *count,
        };
        Answers {
            seconds: 0.0,
            rays: rays.iter().map(answer).collect(),
        }
    }

    #[test]
    fn lost_invented_and_far_off_answers_are_wrong() {
        let truth = answers(&[[1.0, 2.0], MISS, [2.0, 2.0], [3.0, 1.0], [4.0, 1.0]]);
        // The last ray was not asked.
        let found = answers(&[MISS, [3.0, 1.0], [2.1, 2.0], [3.0001, 3.0]]);
        let value = |measure| value(&truth, &found, measure, Precision::F64);
        assert_eq!(value(Measure::Wrong), Some(750_000.0));
        assert_eq!(value(Measure::Found), Some(75.0));
        assert_eq!(value(Measure::Count), Some(75.0));
    }

    #[test]
    fn counts_that_are_not_reported_are_not_judged() {
        let truth = answers(&[[1.0, 2.0]]);
        let found = answers(&[[1.0, f64::NAN]]);
        assert_eq!(value(&truth, &found, Measure::Count, Precision::F64), None);
    }

    #[test]
    fn an_error_is_measured_in_the_precision_of_the_library() {
        let truth = answers(&[[1.0, 1.0], [1.0, 1.0]]);
        let found = answers(&[[1.0 + 2_f64.powi(-22), 1.0], MISS]);
        let largest = |precision| value(&truth, &found, Measure::Ulps, precision);
        assert_eq!(largest(Precision::F32), Some(2.0));
        assert_eq!(largest(Precision::F64), Some(2_f64.powi(30)));
    }
}
