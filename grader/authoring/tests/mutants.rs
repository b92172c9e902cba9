//! Tests of the stored tables of mutants: every mistake loses points, no correct code loses core
//! points, and the tables match the corpus. `grader mutants` creates the tables, which takes
//! minutes.

use authoring::mutants::corpus::Corpus;
use authoring::mutants::run::{Kind, versions};
use authoring::mutants::table::Table;
use base::Workspace;
use grader::course::{Course, Task};
use grader::diagnosis;
use std::collections::BTreeSet;
use std::path::Path;

/// The numbers of the mistakes that students of such courses were observed to make, for each task.
const OBSERVED: [(&str, &[u32]); 7] = [
    ("P1T1", &[1, 2, 4, 5, 7, 8, 10, 11, 14, 16, 17, 19]),
    ("P1T2", &[1, 3, 4, 6, 7, 9, 10, 12, 13, 15, 16, 18, 19, 22]),
    (
        "P1T3",
        &[
            1, 2, 4, 5, 8, 10, 11, 13, 14, 16, 17, 19, 20, 22, 23, 25, 26, 28, 29, 34, 35, 37, 38,
        ],
    ),
    (
        "P1T4",
        &[
            2, 3, 5, 6, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21, 23, 24, 26, 27,
        ],
    ),
    ("P2T1", &[2, 3, 5, 6, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21]),
    ("P2T2", &[2, 5, 6, 8, 9, 11, 12, 14, 15, 17, 18, 20, 21]),
    ("P2T3", &[2, 3, 5, 6, 8, 9, 11, 14, 15, 17, 18, 20]),
];

/// The observed mistakes that are not possible in this course, and the reason.
const NOT_POSSIBLE: [(&str, &str); 3] = [
    ("P1T2-22", "the camera's axes are given, at right angles"),
    ("P1T4-23", "test_sphere returns one root, not two in order"),
    (
        "P2T1-17",
        "slow by a constant factor: times are shown, never scored",
    ),
];

/// The minimum fraction of held-out mutants whose mistake the diagnosis recognises.
const MIN_RECOGNISED: f64 = 0.9;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in a workspace")
}

/// The tasks that have a corpus.
fn tasks(workspace: &Workspace) -> Vec<Task> {
    let course = Course::read(workspace).expect("the course is valid");
    let tasks = course.tasks().cloned();
    tasks
        .filter(|task| Corpus::file(workspace, task).is_file())
        .collect()
}

#[test]
fn every_task_has_mutants_and_held_out_mutants() {
    let course = Course::read(&workspace()).expect("the course is valid");
    let with_mutants: BTreeSet<String> = tasks(&workspace())
        .into_iter()
        .map(|task| task.key)
        .collect();
    for task in course.tasks().filter(|task| !task.cases.is_empty()) {
        assert!(with_mutants.contains(&task.key), "{}", task.key);
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        assert!(table.recognised.1 > 0, "{}: none is held out", task.key);
    }
}

#[test]
fn every_mutant_loses_points_and_no_variant_a_core_point() {
    let mut mutants = 0;
    let mut correct = BTreeSet::new();
    for task in tasks(&workspace()) {
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        assert_eq!(table.survivors(), Vec::<&str>::new(), "{}", task.key);
        assert_eq!(table.accused, Vec::<String>::new(), "{}", task.key);
        mutants += table.mutants.len();
        let names = table.correct.into_keys();
        correct.extend(names.map(|name| format!("{} {name}", task.stage)));
    }
    assert!(mutants >= 150, "{mutants}");
    assert!(correct.len() >= 40, "{}", correct.len());
}

/// Also tests that every edit finds its text in the code.
#[test]
fn the_tables_match_the_corpus() {
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        let (kinds, _) = versions(&workspace(), &task, corpus.mutants).expect("every edit fits");
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        let stored: BTreeSet<&String> = table.mutants.keys().chain(table.correct.keys()).collect();
        let expected: BTreeSet<&String> = kinds.iter().map(|(name, _)| name).collect();
        let missing: Vec<_> = expected.symmetric_difference(&stored).collect();
        assert!(
            missing.is_empty(),
            "{}: the stored table does not match: {missing:?}. Run `cargo grader mutants {0} --bless`",
            task.key
        );
        assert!(
            table.mutants.keys().eq(table.diagnosed.keys()),
            "{}",
            task.key
        );
    }
}

#[test]
fn every_diagnosed_mistake_is_listed_with_its_description() {
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        let known = diagnosis::known(&workspace(), &task.key).expect("the signatures are stored");
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        for mistake in &corpus.mistakes {
            let made = |mistakes: &[String]| mistakes == [mistake.id.clone()];
            assert!(
                known.iter().any(|known| made(&known.mistakes)),
                "{}: no signature is stored for `{}`",
                task.key,
                mistake.id
            );
        }
        for known in &known {
            for (id, stored) in known.mistakes.iter().zip(&known.descriptions) {
                let listed = corpus.mistake(id).map(|mistake| &mistake.description);
                assert_eq!(listed, Some(stored), "{} {id}", task.key);
            }
        }
        let named = table.diagnosed.values().flatten();
        for id in named {
            assert!(corpus.mistake(id).is_some(), "{} {id}", task.key);
        }
    }
}

#[test]
fn every_observed_mistake_has_a_mutant() {
    let mut covered = BTreeSet::new();
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        for mistake in &corpus.mistakes {
            let is_made = corpus
                .mutants
                .iter()
                .any(|mutant| mutant.mistakes == [mistake.id.clone()]);
            assert!(is_made, "{}: no mutant makes `{}`", task.key, mistake.id);
            covered.extend(mistake.references.iter().cloned());
        }
    }
    let observed: BTreeSet<String> = OBSERVED
        .iter()
        .flat_map(|(task, numbers)| numbers.iter().map(move |n| format!("{task}-{n:02}")))
        .collect();
    assert_eq!(observed.len(), 106);
    let not_possible = NOT_POSSIBLE.map(|(id, _)| id.to_string());
    let uncovered: Vec<&String> = observed
        .difference(&covered)
        .filter(|id| !not_possible.contains(id))
        .collect();
    assert!(uncovered.is_empty(), "{uncovered:?}");
    assert!(covered.is_subset(&observed), "{covered:?}");
    assert!(not_possible.iter().all(|id| !covered.contains(id)));
}

#[test]
fn the_diagnosis_recognises_held_out_mutants() {
    let (mut recognised, mut of) = (0, 0);
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        let (kinds, _) = versions(&workspace(), &task, corpus.mutants).expect("every edit fits");
        let held_out = kinds.iter().filter(|(_, kind)| match kind {
            Kind::Mutant(mutant) => mutant.held_out,
            Kind::Correct => false,
        });
        assert_eq!(held_out.count(), table.recognised.1, "{}", task.key);
        recognised += table.recognised.0;
        of += table.recognised.1;
    }
    assert!(
        f64::from(recognised as u32) >= MIN_RECOGNISED * f64::from(of as u32),
        "{recognised} of {of}"
    );
}
