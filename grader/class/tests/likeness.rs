//! Which pairs of a class are asked about.

use class::collect::{Class, Options};
use class::likeness::{self, EXPECTED, Pair};
use class::out::Out;
use serde_json::{Value, json};
use std::path::Path;

const TASKS: [&str; 4] = ["part1.task1", "part1.task2", "part1.task3", "part1.task4"];

/// A class: for each student the name of the wrong answers in each task, empty where all is right.
fn class(folder: &Path, students: &[[&str; 4]], stages: &[&str]) -> Class {
    let out = Out::create(folder).expect("a folder");
    let mut planned = Vec::new();
    for (i, wrong) in students.iter().enumerate() {
        let key = format!("{i:02}");
        let of_task = |i: usize| {
            let count = if wrong[i] == "few" { 2 } else { 40 };
            (
                TASKS[i].to_string(),
                json!({ "hash": wrong[i], "count": count }),
            )
        };
        let wrong_answers: serde_json::Map<String, Value> = (0..4)
            .filter(|i| !wrong[*i].is_empty())
            .map(of_task)
            .collect();
        let tasks = TASKS.map(|task| {
            json!({
                "key": task, "title": "", "score": 0.0, "max_score": 1.0, "robust_score": 0.0, "robust_max_score": 0.0,
                "status": if stages[i] == "handout" { "not_attempted" } else { "failed" }, "stage": "raygen",
                "cases": [], "diagnosis": null, "worst_as_test": null,
            })
        });
        let unit = json!({
            "key": key, "submission": key, "course": "0", "what": "part1", "seed": 7, "outcome": "graded",
            "earned": {}, "wrong_answers": wrong_answers, "endless_cases": {}, "sources": { "raygen": stages[i] },
            "took": { "seconds": 1.0, "cpu_seconds": 1.0 },
            "report": { "score": 0.0, "max_score": 4.0, "robust_score": 0.0, "robust_max_score": 0.0, "tasks": tasks },
        });
        std::fs::write(out.unit(&key), unit.to_string()).expect("a file");
        planned.push(json!({ "name": key, "file": key, "unit": { "submission": key, "key": key, "notes": [] } }));
    }
    let plan = json!({
        "version": 2, "tasks": [], "submissions": planned,
        "settings": { "what": "part1", "seed": 7, "limits": "", "revision": null, "course": {} },
    });
    let plan = serde_json::from_value(plan).expect("a plan");
    Class::read(&out, plan, &Options::default(), |_, _, _, _| Ok(())).expect("a class")
}

/// The pairs of a class of 30, of whom only the first differ from all right.
fn pairs(first: &[[&str; 4]], stages: &[&str]) -> Vec<Pair> {
    let folder = tempfile::tempdir().expect("a folder");
    likeness::pairs(&class_of_30(folder.path(), first, stages))
}

/// A class of 30, of whom only the first differ from all right.
fn class_of_30(folder: &Path, first: &[[&str; 4]], stages: &[&str]) -> Class {
    let mut students = first.to_vec();
    students.resize(30, [""; 4]);
    let own: Vec<String> = (0..30).map(|i| format!("files {i}")).collect();
    let mut all: Vec<&str> = own.iter().map(String::as_str).collect();
    all[..stages.len()].copy_from_slice(stages);
    class(folder, &students, &all)
}

#[test]
fn two_rare_mistakes_in_common_are_asked_about_and_one_is_not() {
    let found = pairs(&[["a", "b", "c", ""], ["a", "b", "d", ""]], &[]);
    let [pair] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(pair.names, ["00", "01"]);
    assert_eq!(
        pair.tasks,
        [
            ("part1.task1".to_string(), 40, 0),
            ("part1.task2".to_string(), 40, 0)
        ]
    );
    // 435 pairs, and in each task half a student of 29.
    let expected = 435.0 * (0.5 / 29.0) * (0.5 / 29.0);
    assert!((pair.expected - expected).abs() < 1e-12 && expected < EXPECTED);
}

#[test]
fn typical_mistakes_and_right_answers_are_no_evidence() {
    // Right answers only, one rare mistake, and mistakes of a third of the class.
    assert_eq!(pairs(&[], &[]), []);
    assert_eq!(pairs(&[["a", "", "", ""], ["a", "", "", ""]], &[]), []);
    assert_eq!(pairs(&[["a", "b", "", ""]; 10], &[]), []);
    // Too few wrong answers to compare.
    assert_eq!(pairs(&[["few", "few", "few", "few"]; 2], &[]), []);
}

#[test]
fn equal_files_are_asked_about_unless_the_course_gave_them() {
    let none = [[""; 4]; 2];
    let found = pairs(&none, &["the same", "the same"]);
    let [pair] = &found[..] else {
        panic!("{found:?}")
    };
    assert_eq!(
        (pair.stages.as_slice(), pair.tasks.len()),
        (["raygen".to_string()].as_slice(), 0)
    );
    assert_eq!(pairs(&none, &["handout", "handout"]), []);
    assert_eq!(pairs(&none, &["an example"; 6]), []);
}

#[test]
fn files_of_many_students_are_named_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let shared = |stages: &[&str]| {
        let class = class_of_30(folder.path(), &[], stages);
        likeness::shared_by_many(&class)
    };
    let [files] = &shared(&["the same"; 5])[..] else {
        panic!("one group")
    };
    assert_eq!(files.stage, "raygen");
    assert_eq!(files.names, ["00", "01", "02", "03", "04"]);
    assert_eq!(shared(&["the same"; 4]), []);
    assert_eq!(shared(&["handout"; 5]), []);
}
