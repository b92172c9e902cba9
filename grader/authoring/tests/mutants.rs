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

/// The observed mistakes that are not possible in this course, and the reason.
const NOT_POSSIBLE: [(&str, &str); 3] = [
    ("P1T2-22", "the camera's axes are given, at right angles"),
    ("P1T4-23", "test_sphere returns one root, not two in order"),
    (
        "P2T1-17",
        "slow by a constant factor: times are shown, never scored",
    ),
];

/// The largest number of lines of a task's list of mistakes, and of all lists together. A list that
/// grows beyond it has mistakes that can be merged, or forms that `--families` makes, too.
const LONGEST_LIST: usize = 1_150;
const LONGEST_LISTS: usize = 12_700;

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

/// The numbers of the mistakes that students of such courses were observed to make, such as
/// `P1T3-01`: the first column of `grader/mutants/observed.tsv`.
fn observed() -> BTreeSet<String> {
    let path = workspace().root().join("grader/mutants/observed.tsv");
    let table = std::fs::read_to_string(path).expect("the table of observed mistakes");
    let numbers = table.lines().skip(1).map(|line| line.split('\t').next());
    numbers.flatten().map(str::to_string).collect()
}

#[test]
fn the_lists_of_mistakes_do_not_grow_without_bound() {
    let lists = workspace().root().join("grader/mutants");
    let mut all = 0;
    for task in tasks(&workspace()) {
        for folder in ["", "empty", "half"] {
            let list = lists.join(folder).join(format!("{}.txt", task.key));
            let lines = std::fs::read_to_string(&list).map_or(0, |text| text.lines().count());
            assert!(lines <= LONGEST_LIST, "{}: {lines} lines", list.display());
            all += lines;
        }
    }
    assert!(all <= LONGEST_LISTS, "{all} lines");
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
    let observed = observed();
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
