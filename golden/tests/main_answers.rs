//! Every case has a main answer, without which the case gives no points. The reference's main
//! answers are right.

use crate::shared::{AfterTheGoldens, SPECS, record};
use judge::Tier;
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
