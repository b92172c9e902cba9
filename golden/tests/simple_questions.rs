//! The reference answers every simple question rightly, so no simple question marks right code
//! down. `grader mutants` asks the correct variants the same questions.

use crate::shared::AfterTheGoldens;
use judge::cases::{self, Spec};
use judge::{Tier, plural};
use std::collections::BTreeMap;
use wire::{Outcome, Work};

/// A case of each kind of work of each task, and its simple questions: cases of a kind share them.
fn kinds() -> Vec<(Spec, Vec<Spec>)> {
    let mut kinds: BTreeMap<String, Spec> = BTreeMap::new();
    for spec in cases::all(0) {
        let variant = match &spec.work {
            Work::Direct(work) => format!("{:?}", work.strategy),
            // Some of its cases count the tests.
            Work::Traverse(world) => format!("{} {}", world.any_hit, spec.name),
            // The work of a tree is recorded for some of its cases.
            Work::Build(_) => format!("build {}", spec.name),
            work => work.kind().into(),
        };
        kinds
            .entry(format!("{} {variant}", spec.task))
            .or_insert(spec);
    }
    let kinds = kinds.into_values();
    kinds
        .map(|spec| {
            let simple = spec.simple();
            (spec, simple)
        })
        .collect()
}

#[test]
fn the_reference_answers_every_simple_question_rightly() {
    let _begin = AfterTheGoldens;
    let mut wrong = Vec::new();
    let mut asked = 0;
    for (spec, simple) in kinds() {
        for mut simple in simple {
            // All aspects, whatever the case is about.
            simple.about_aspects = &[];
            let answer = match worker::run(0, &simple.case()).outcome {
                Outcome::Answered(answer) => answer,
                Outcome::NotAttempted { .. } => continue,
                outcome => panic!("{} {}: {outcome:?}", spec.task, spec.name),
            };
            asked += judge::calls(&simple.work);
            let findings = judge::judge(&simple, Tier::Core, &answer).into_iter();
            let failed = findings.filter(|finding| !finding.passed());
            wrong.extend(failed.map(|finding| {
                let first = finding.faults.first().map_or(0, |fault| fault.call);
                let input = simple.input(first as usize);
                let worst = finding.worst.map(|worst| worst.message.to_string());
                format!(
                    "{} {} {:?}: {} of {} wrong; {input:?}: {worst:?}",
                    spec.task, spec.name, finding.aspect, finding.wrong, finding.judged
                )
            }));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // In a handout some stages are not written yet.
    println!("{} asked", plural(asked, "question", "questions"));
}

#[test]
fn every_kind_of_work_with_single_answers_has_simple_questions() {
    for (spec, simple) in kinds() {
        let without = matches!(spec.work, Work::BuildGrowth(_) | Work::SceneHits(_));
        assert_eq!(simple.is_empty(), without, "{} {}", spec.task, spec.name);
    }
}
