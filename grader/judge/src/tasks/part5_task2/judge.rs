//! Judges the stopping rule that waits until the plain rule is reliable.

use super::truth::plain_decides;
use crate::tools::call_text::all_or_none;
use crate::tools::findings::{Aspect, Class, Findings, Message};
use crate::tools::kinds::stopping::{samples, verdict};
use wire::adaptive::{StopAnswer, StopCall};

/// Judges the waiting rule.
pub(crate) fn sure_stop(findings: &mut Findings, calls: &[StopCall], answers: &[StopAnswer]) {
    for (i, (call, answer)) in calls.iter().zip(answers).enumerate() {
        let (samples, plain_decides) = (samples(call), plain_decides(call));
        let plain = format!("; the plain rule returns {}", call.rule);
        let right = plain_decides && call.rule;
        verdict(findings, i, call, answer, right, &plain);
        findings.expect(Aspect::Questions);
        let right = (samples.count(), samples.mean(), call.tolerance);
        let known = answer
            .rule_calls
            .iter()
            .all(|rule_call| *rule_call == right);
        let class = if !known {
            let samples_are =
                |rule_call: &(u64, f64, f64)| (rule_call.0, rule_call.1) == (right.0, right.1);
            Some(match answer.rule_calls.iter().all(samples_are) {
                true => Class::Named("another tolerance"),
                false => Class::Named("other samples"),
            })
        } else {
            (plain_decides && answer.rule_calls.is_empty()).then_some(Class::Named("not asked"))
        };
        findings.judge_class(Aspect::Questions, i, class, 1.0, || {
            let numbers = |call: &(u64, f64, f64)| [call.0 as f64, call.1, call.2];
            let wanted = answer.rule_calls.iter().map(|_| right);
            Message::new(format!(
                "your calls of the plain rule: (count, mean, tolerance) = {}; expected: only {right:?}",
                all_or_none(answer.rule_calls.iter().map(|call| format!("{call:?}")))
            ))
            .compares(
                answer.rule_calls.iter().flat_map(numbers),
                wanted.flat_map(|call| numbers(&call)),
            )
        });
    }
}

/// Why the number of calls of the plain rule is not judged.
const REPEATED: &str = "the plain rule may be called again, or where it does not decide";

/// Records the calls of the plain rule that are allowed and not needed.
pub(crate) fn untested(findings: &mut Findings, calls: &[StopCall], answers: &[StopAnswer]) {
    for (i, (call, answer)) in calls.iter().zip(answers).enumerate() {
        if answer.rule_calls.len() != usize::from(plain_decides(call)) {
            findings.not_judged(Aspect::Questions, i, REPEATED);
        }
    }
}
