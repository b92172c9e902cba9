//! The stored tables of mutants: no mistake gets away, no correct code is accused, and they are
//! about the corpus as it stands. `grader mutants` makes them; that takes minutes, this takes none.

use authoring::mutants::corpus::Corpus;
use authoring::mutants::run::{Kind, versions};
use authoring::mutants::table::Table;
use grader::course::{Course, Task};
use grader::diagnosis;
use grader::workspace::Workspace;
use std::collections::BTreeSet;
use std::path::Path;

/// The mistakes that students of such courses were seen to make, task by task.
const SEEN: [(&str, &[u32]); 7] = [
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

/// Those of them that no code can make here, and why.
const CANNOT_BE_MADE: [(&str, &str); 3] = [
    ("P1T2-22", "the camera's axes are given, at right angles"),
    (
        "P1T4-23",
        "test_sphere gives one crossing, not two in order",
    ),
    (
        "P2T1-17",
        "slow by a constant factor: times are shown, never scored",
    ),
];

/// Of the mistakes in other clothes, at least this share is recognised.
const RECOGNISED: f64 = 0.9;

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the grader is in a workspace")
}

/// The tasks that have a corpus.
fn tasks(workspace: &Workspace) -> Vec<Task> {
    let course = Course::read(workspace).expect("the course is sound");
    let tasks = course.tasks().cloned();
    tasks
        .filter(|task| Corpus::file(workspace, task).is_file())
        .collect()
}

#[test]
fn every_task_has_mutants_some_of_them_in_other_words() {
    let course = Course::read(&workspace()).expect("the course is sound");
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

/// Also says that every edit still fits the code that it is for.
#[test]
fn the_tables_are_about_the_corpus_as_it_stands() {
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        let (kinds, _) = versions(&workspace(), &task, corpus.mutants).expect("every edit fits");
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        let stored: BTreeSet<&String> = table.mutants.keys().chain(table.correct.keys()).collect();
        let there: BTreeSet<&String> = kinds.iter().map(|(name, _)| name).collect();
        let missing: Vec<_> = there.symmetric_difference(&stored).collect();
        assert!(
            missing.is_empty(),
            "{}: {missing:?}. Run `cargo grader mutants {0} --bless`",
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
fn what_is_diagnosed_is_listed() {
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        let known = diagnosis::known(&workspace(), &task.key).expect("the signatures are stored");
        let table = Table::read(&workspace(), &task.key).expect("the table is stored");
        for mistake in &corpus.mistakes {
            let made = |mistakes: &[String]| mistakes == [mistake.id.clone()];
            assert!(
                known.iter().any(|known| made(&known.mistakes)),
                "{}: nothing is known of `{}`",
                task.key,
                mistake.id
            );
        }
        for known in &known {
            for (id, description) in known.mistakes.iter().zip(&known.descriptions) {
                let listed = corpus.mistake(id).map(|mistake| &mistake.says);
                assert_eq!(listed, Some(description), "{} {id}", task.key);
            }
        }
        let named = table.diagnosed.values().flatten();
        for id in named {
            assert!(corpus.mistake(id).is_some(), "{} {id}", task.key);
        }
    }
}

#[test]
fn what_students_were_seen_to_do_is_covered() {
    let mut covered = BTreeSet::new();
    for task in tasks(&workspace()) {
        let corpus = Corpus::read(&workspace(), &task).expect("the corpus can be read");
        for mistake in &corpus.mistakes {
            let is_made = corpus
                .mutants
                .iter()
                .any(|mutant| mutant.mistakes == [mistake.id.clone()]);
            assert!(is_made, "{}: nothing makes `{}`", task.key, mistake.id);
            covered.extend(mistake.seen.iter().cloned());
        }
    }
    let seen: BTreeSet<String> = SEEN
        .iter()
        .flat_map(|(task, numbers)| numbers.iter().map(move |n| format!("{task}-{n:02}")))
        .collect();
    assert_eq!(seen.len(), 106);
    let not_made = CANNOT_BE_MADE.map(|(id, _)| id.to_string());
    let open: Vec<&String> = seen
        .difference(&covered)
        .filter(|id| !not_made.contains(id))
        .collect();
    assert!(open.is_empty(), "{open:?}");
    assert!(covered.is_subset(&seen), "{covered:?}");
    assert!(not_made.iter().all(|id| !covered.contains(id)));
}

#[test]
fn mistakes_are_recognised_in_other_clothes() {
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
        f64::from(recognised as u32) >= RECOGNISED * f64::from(of as u32),
        "{recognised} of {of}"
    );
}
