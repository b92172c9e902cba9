//! Every case has a main answer, without which the case gives no points. The reference's main
//! answers are right.

use crate::shared::{AfterTheGoldens, SPECS, record, reference};
use judge::Tier;
use std::collections::BTreeSet;
use wire::Outcome;

#[test]
fn every_case_has_a_main_answer() {
    let _begin = AfterTheGoldens;
    let mut judged = 0;
    for spec in SPECS.iter() {
        let record = record(spec);
        // A handout has holes.
        let (Outcome::Answered(answer), true, true) = (
            &record.outcome,
            record.untouched.is_empty(),
            record.holes.is_empty(),
        ) else {
            continue;
        };
        judged += 1;
        let findings = judge::judge(spec, Tier::Core, answer);
        let main: Vec<_> = findings.iter().filter(|finding| finding.main).collect();
        let name = format!("{} {}", spec.task, spec.name);
        assert!(!main.is_empty(), "{name}: no aspect is main");
        assert!(
            main.iter().any(|finding| finding.judged > 0),
            "{name}: no main answer is judged"
        );
    }
    println!("{judged} cases");
}

/// Otherwise a `todo!()` in one function would give its share of the points to the others.
#[test]
fn a_function_that_is_not_written_keeps_its_share_of_a_case() {
    let _begin = AfterTheGoldens;
    let mut written = 0;
    for spec in SPECS.iter() {
        let Some(answer) = reference(spec) else {
            continue;
        };
        let that_share = |not_written: &[String]| -> BTreeSet<&str> {
            let findings = judge::judge_written(spec, Tier::Core, answer, not_written).into_iter();
            let counts = findings.filter(|finding| finding.main);
            counts
                .flat_map(|finding| finding.functions)
                .map(|count| count.function)
                .collect()
        };
        let all = that_share(&[]);
        if all.len() < 2 {
            continue;
        }
        for function in &all {
            written += 1;
            let without = that_share(&[function.to_string()]);
            assert_eq!(
                without, all,
                "{} {}: without {function}",
                spec.task, spec.name
            );
        }
    }
    println!("{written} functions of cases");
}
