//! Judging the stopping rule that waits until the plain one can be trusted.

use crate::tally::{Aspect, Class, Tally};
use crate::tasks::part5_task1::judge::{samples, verdict};
use wire::adaptive::{StopAnswer, StopCall};

/// Samples that the mended rule waits for.
const PATIENCE: u64 = 256;

/// Whether the mended rule may ask the plain one, which then has the last word.
pub(crate) fn may_ask(call: &StopCall) -> bool {
    let samples = samples(call);
    samples.count() >= PATIENCE && samples.mean() > 0.0
}

/// Judges the mended rule.
pub(crate) fn sure_stop(tally: &mut Tally, calls: &[StopCall], answers: &[StopAnswer]) {
    for (i, (call, answer)) in calls.iter().zip(answers).enumerate() {
        let (samples, may_ask) = (samples(call), may_ask(call));
        verdict(tally, i, call, answer, may_ask && call.rule);
        tally.expect(Aspect::Questions);
        let right = (samples.count(), samples.mean(), call.tolerance);
        let known = answer.rule_calls.iter().all(|asked| *asked == right);
        let class = if !known {
            let samples_are = |asked: &(u64, f64, f64)| (asked.0, asked.1) == (right.0, right.1);
            Some(match answer.rule_calls.iter().all(samples_are) {
                true => Class::Named("another tolerance"),
                false => Class::Named("other samples"),
            })
        } else {
            (may_ask && answer.rule_calls.is_empty()).then_some(Class::Named("not asked"))
        };
        tally.judge_class(Aspect::Questions, i, class, 1.0, || {
            format!(
                "the plain rule was asked {:?} (count, mean, tolerance); it has the last word on {right:?}",
                answer.rule_calls
            )
        });
    }
}
