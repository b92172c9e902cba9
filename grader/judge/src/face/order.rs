//! Orders the findings about a case: those that explain the most come first.

use crate::tools::findings::{Class, Finding};
use std::collections::BTreeSet;

/// Orders the findings of a case by how much they explain: each next one is wrong on the most calls
/// on which no finding before it is wrong. Of several such, hit or miss comes first (without it
/// nothing else means much), then a finding whose fault has a name, then the one that was judged
/// first. Findings without a wrong answer come last, in the order in which they were judged.
pub(crate) fn by_explanation(findings: Vec<Finding>) -> Vec<Finding> {
    let (mut wrong, right): (Vec<Finding>, Vec<Finding>) =
        findings.into_iter().partition(|finding| finding.wrong > 0);
    let mut ordered = Vec::with_capacity(wrong.len() + right.len());
    let mut explained: BTreeSet<u32> = BTreeSet::new();
    while !wrong.is_empty() {
        let first = (0..wrong.len())
            .min_by_key(|&at| rank(&wrong[at], &explained))
            .unwrap_or(0);
        let finding = wrong.remove(first);
        explained.extend(finding.faults.iter().map(|fault| fault.call));
        ordered.push(finding);
    }
    ordered.extend(right);
    ordered
}

/// The finding with the lowest rank comes first; of equal ones the first.
fn rank(finding: &Finding, explained: &BTreeSet<u32>) -> impl Ord + use<> {
    let calls: BTreeSet<u32> = finding.faults.iter().map(|fault| fault.call).collect();
    let new = calls.difference(explained).count();
    let is_named = |fault: &crate::tools::findings::Fault| matches!(fault.class, Class::Named(_));
    (
        std::cmp::Reverse(new),
        !finding.aspect.is_decision(),
        !finding.faults.iter().any(is_named),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::findings::Aspect::{self, *};
    use crate::tools::findings::Findings;

    /// The aspects in order, of findings that are wrong in these calls of 10; `named` aspects have
    /// named faults.
    fn order(wrong: &[(Aspect, &[usize])], named: &[Aspect]) -> Vec<Aspect> {
        let mut findings = Findings::default();
        for (aspect, calls) in wrong {
            for call in 0..10 {
                let class = calls
                    .contains(&call)
                    .then_some(match named.contains(aspect) {
                        true => Class::Named("max_t as before"),
                        false => Class::Wrong,
                    });
                findings.judge_class(*aspect, call, class, 1.0, String::new);
            }
        }
        let ordered = by_explanation(findings.into_vec());
        ordered.iter().map(|finding| finding.aspect).collect()
    }

    #[test]
    fn a_finding_about_more_calls_comes_first() {
        let ordered = order(
            &[(HitOrMiss, &[1]), (T, &[2, 3, 4]), (Normal, &[5, 6])],
            &[],
        );
        assert_eq!(ordered, [T, Normal, HitOrMiss]);
    }

    #[test]
    fn calls_that_another_finding_explains_do_not_count() {
        let ordered = order(
            &[
                (Position, &[1, 2, 3]),
                (T, &[1, 2, 3, 4]),
                (Normal, &[8, 9]),
            ],
            &[],
        );
        assert_eq!(ordered, [T, Normal, Position]);
    }

    #[test]
    fn of_equals_hit_or_miss_comes_first_then_a_named_fault() {
        let calls: &[usize] = &[1, 2];
        let all = [(T, calls), (RayAfter, calls), (HitOrMiss, calls)];
        assert_eq!(order(&all, &[RayAfter]), [HitOrMiss, RayAfter, T]);
        assert_eq!(order(&all[..2], &[RayAfter]), [RayAfter, T]);
        assert_eq!(order(&all[..2], &[]), [T, RayAfter]);
    }

    #[test]
    fn findings_without_a_wrong_answer_come_last() {
        let ordered = order(&[(HitOrMiss, &[]), (T, &[]), (Normal, &[7])], &[]);
        assert_eq!(ordered, [Normal, HitOrMiss, T]);
    }
}
