//! Tests of blessing in a workspace of its own.

use super::*;
use tempfile::TempDir;

const COURSE: &str = r#"
conventions = []
[[part]]
number = 1
title = "One"
[[part.task]]
key = "part1.task1"
title = "Mine"
stage = "bbox"
holes = []
cases = [{ name = "a", tier = "core", points = 1 }, { name = "b", tier = "core", points = 1 }]
[[part.task]]
key = "part1.task2"
title = "Another"
stage = "bbox"
holes = []
cases = [{ name = "a", tier = "core", points = 1 }]
"#;

/// A workspace with this course and these files.
fn workspace(files: &[(&str, &str)]) -> (TempDir, Workspace) {
    let folder = tempfile::tempdir().expect("a folder");
    let needed = [
        ("stages/course.toml", COURSE),
        ("stages/bbox/src/lib.rs", ""),
        ("scenes/dae/box.dae", "<COLLADA/>"),
    ];
    for (path, text) in needed.iter().chain(files) {
        files::file_tree::write(&folder.path().join(path), text.as_bytes())
            .expect("the file is written");
    }
    let workspace = Workspace::above(folder.path()).expect("it has a course.toml");
    (folder, workspace)
}

#[test]
fn keys_select_parts_tasks_cases_and_pictures() {
    let (_folder, workspace) = workspace(&[]);
    let course = Course::read(&workspace).expect("the course is sound");
    let selected = |keys: &[&str]| -> Vec<(String, [bool; 2], bool)> {
        let selected = select(&course, keys).expect("the keys select something");
        let each = selected.iter();
        each.map(|s| {
            let cases = ["a", "b"].map(|case| s.has_case(case));
            (s.task.key.clone(), cases, s.picture)
        })
        .collect()
    };
    let (first, second) = ("part1.task1".to_string(), "part1.task2".to_string());
    let all = [
        (first.clone(), [true; 2], true),
        (second.clone(), [true; 2], true),
    ];
    assert_eq!(selected(&["all"]), all);
    assert_eq!(selected(&["part1.task2", "part1.task1/b", "part1"]), all);
    let cases = selected(&["part1.task2", "part1.task1/b"]);
    assert_eq!(
        cases,
        [(first.clone(), [false, true], false), all[1].clone()]
    );
    let picture = selected(&["part1.task1/task"]);
    assert_eq!(picture, [(first, [false; 2], true)]);
    let error = select(&course, &["part1.task1/c"]).expect_err("there is no such case");
    let text = "part1.task1 has no case `c`. Its goldens are a, b, task";
    assert_eq!(error.to_string(), text);
}

#[test]
fn accepting_writes_the_new_content_and_removes_what_waited_beside_it() {
    let golden = "golden/part1.task1/a.snap";
    let (folder, workspace) = workspace(&[
        (golden, "old"),
        ("golden/part1.task1/a.snap.new", "new"),
        ("golden/part1.task1/b.snap.new", "another"),
    ]);
    let change = Change {
        task: "part1.task1".into(),
        golden: folder.path().join(golden),
        content: b"new".to_vec(),
        meaning: String::new(),
        not_judged: Vec::new(),
        kind: ChangeKind::Answers,
    };
    accept(&workspace, &[change]).expect("the golden is written");
    let exists = |name: &str| folder.path().join("golden").join(name).is_file();
    let text = std::fs::read_to_string(folder.path().join(golden));
    assert_eq!(text.expect("the golden exists"), "new");
    assert!(!exists("part1.task1/a.snap.new"));
    assert!(exists("part1.task1/b.snap.new"), "it is another golden's");
    assert!(exists("provenance.toml"));
}

#[test]
fn blessing_in_a_handout_is_an_error() {
    let (_folder, workspace) = workspace(&[]);
    let error = propose(&workspace, &["all"]).expect_err("it is a handout");
    assert!(error.to_string().contains("is a handout"), "{error}");
}
