//! CONTRIBUTING's "I want to add a stage" is true: a copy of the project, changed in the places
//! that it names and no others, grades a new stage.

use base::Workspace;
use files::file_tree;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The new stage. It doubles numbers.
const MANIFEST: &str = r#"[package]
name = "doubling"
version.workspace = true
edition.workspace = true
rust-version.workspace = true
license.workspace = true
publish.workspace = true

[dependencies]
kit.workspace = true
"#;

const STAGE: &str = r#"//! Part 7: doubling.

/// Returns 2x.
pub fn twice(x: f64) -> f64 {
    // BEGIN SOLUTION(part7.task1)
    2.0 * x
    // STUB: kit::hole!("part7.task1", x)
    // END SOLUTION(part7.task1)
}
"#;

/// The task's folder in the judge.
const CHECK: &str = r#"//! `part7.task1`: doubling.

use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::shown::{ShownCall, ShownRay};
use crate::tools::snapshot::lines::each;
use crate::tools::snapshot::{Content, Fields, forms, number};
use crate::tools::spec::Spec;
use crate::tools::findings::{Aspect, Findings};
use crate::tools::{Tier, plural};
use kit::{Aabb, Ray, Vec3};
use wire::kind;

/// The cases of the task.
pub(crate) fn cases() -> Vec<Spec> {
    vec![Spec::new::<kind::Doubling>(
        "part7.task1",
        "three_numbers",
        "Three numbers are doubled.",
        vec![0.5, 1.0, -3.0],
    )]
}

impl Check for kind::Doubling {
    fn calls(numbers: &Vec<f64>) -> usize {
        numbers.len()
    }

    fn only_call(numbers: &Vec<f64>, call: usize) -> Option<Vec<f64>> {
        Some(vec![*numbers.get(call)?])
    }

    fn fits(numbers: &Vec<f64>, answers: &Vec<f64>) -> Result<(), String> {
        one_each(numbers.len(), answers)
    }

    fn judge(findings: &mut Findings, _: &CaseContext<'_>, _: Tier, numbers: &Vec<f64>, answers: &Vec<f64>) {
        for (call, (x, answer)) in numbers.iter().zip(answers).enumerate() {
            findings.expect(Aspect::T);
            let right = 2.0 * x;
            let off = (answer - right).abs();
            findings.judge(Aspect::T, call, off == 0.0, off, || {
                format!("your result: {answer}; expected: {right}")
            });
        }
    }

    fn lines(numbers: &Vec<f64>, answers: &Vec<f64>) -> Option<Content> {
        let lines = each(numbers, answers, |x, answer| {
            let answer = vec![number("twice", *answer)];
            forms(vec![number("x", *x)], answer.clone(), answer)
        });
        Some((Vec::new(), lines))
    }

    fn input(numbers: &Vec<f64>, call: usize) -> Option<String> {
        numbers.get(call).map(|x| format!("x = {x:?}"))
    }

    fn circumstances(numbers: &Vec<f64>, call: usize) -> Option<Vec<&'static str>> {
        let is_negative = *numbers.get(call)? < 0.0;
        Some(is_negative.then_some("x is negative").into_iter().collect())
    }

    fn exact(_: &Vec<f64>, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    /// As a ray along x that should end at the doubled number.
    fn shown(
        numbers: &Vec<f64>,
        _: Tier,
        _: bool,
        call: usize,
        answers: Option<&Vec<f64>>,
    ) -> Option<ShownCall> {
        let x = *numbers.get(call)?;
        let b = Aabb { min: Vec3::splat(-8.0), max: Vec3::splat(8.0) };
        let yours = answers.and_then(|answers| answers.get(call));
        Some(ShownCall::Ray(ShownRay {
            boxes: vec![b],
            expected: vec![2.0 * x],
            yours: yours.copied().into_iter().collect(),
            ..ShownRay::new(Ray::new(Vec3::ZERO, Vec3::X))
        }))
    }

    fn overview(numbers: &Vec<f64>) -> String {
        plural(numbers.len(), "number", "numbers")
    }
}
"#;

const PART: &str = r#"
[[part]]
number = 7
title = "Doubling"

[[part.task]]
key = "part7.task1"
title = "Doubling numbers"
stage = "doubling"
holes = ["twice"]
cases = [{ name = "three_numbers", tier = "core", points = 1 }]
"#;

/// A line to insert into a file after another line.
struct Insertion {
    file: &'static str,
    after: &'static str,
    lines: &'static str,
}

/// What CONTRIBUTING says to change in files that exist.
const INSERTIONS: &[Insertion] = &[
    // The stage.
    Insertion {
        file: "Cargo.toml",
        after: "[workspace.dependencies]",
        lines: "doubling = { path = \"stages/doubling\" }",
    },
    Insertion {
        file: "grader/worker/Cargo.toml",
        after: "[features]",
        lines: "doubling = [\"dep:doubling\"]",
    },
    Insertion {
        file: "grader/worker/Cargo.toml",
        after: "[dependencies]",
        lines: "doubling = { workspace = true, optional = true }",
    },
    Insertion {
        file: "grader/driver/src/stages.rs",
        after: "pub struct Stages {",
        lines: "    pub doubling: Option<fn(f64) -> f64>,",
    },
    Insertion {
        file: "grader/worker/src/lib.rs",
        after: "const STAGES: Stages = Stages {",
        lines: "    #[cfg(feature = \"doubling\")]\n    doubling: Some(doubling::twice),\n    #[cfg(not(feature = \"doubling\"))]\n    doubling: None,",
    },
    // The task.
    Insertion {
        file: "grader/wire/src/kinds.rs",
        after: "kinds! {",
        lines: "    /// Call `twice` for every number.\n    Doubling(Vec<f64>) -> Vec<f64>;",
    },
    Insertion {
        file: "grader/judge/src/tasks/mod.rs",
        after: "pub(crate) mod part5_task2;",
        lines: "pub(crate) mod part7_task1;",
    },
    Insertion {
        file: "grader/judge/src/tasks/mod.rs",
        after: "    (\"part5.task2\", part5_task2::cases::cases),",
        lines: "    (\"part7.task1\", |_| part7_task1::cases()),",
    },
    Insertion {
        file: "grader/driver/src/run.rs",
        after: "    Ok(match work {",
        lines: "        Work::Doubling(numbers) => { let twice = linked(&stages.doubling, \"doubling\")?; Answer::Doubling(harness::each_call(numbers, |_, x| twice(*x))) }",
    },
];

/// The copy of the project, below `target`.
struct Copy {
    root: PathBuf,
}

impl Copy {
    fn write(&self, path: &str, text: &str) {
        file_tree::write(&self.root.join(path), text.as_bytes()).expect("a new file");
    }

    fn insert(&self, insertion: &Insertion) {
        let path = self.root.join(insertion.file);
        let text = std::fs::read_to_string(&path).expect("the file exists");
        let is_place = |line: &str| line.trim_start() == insertion.after.trim_start();
        let places = text.lines().filter(|line| is_place(line)).count();
        assert_eq!(
            places, 1,
            "{} has the line `{}` once",
            insertion.file, insertion.after
        );
        let with: String = text
            .lines()
            .map(|line| match is_place(line) {
                true => format!("{line}\n{}\n", insertion.lines),
                false => format!("{line}\n"),
            })
            .collect();
        file_tree::write(&path, with.as_bytes()).expect("written");
    }

    /// What `grader` prints: on stdout, and on stderr.
    fn run(&self, args: &[&str]) -> [String; 2] {
        let output = Command::new(base::child_processes::cargo())
            .current_dir(&self.root)
            .args(["run", "--release", "--offline", "--package", "grader", "--"])
            .args(args)
            .env("CARGO_TARGET_DIR", self.root.join("target"))
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0")
            .output()
            .expect("cargo runs");
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned())
    }

    /// The report of the new part.
    fn grade(&self) -> Value {
        let [report, errors] = self.run(&["part7", "--format", "json"]);
        serde_json::from_str(&report).unwrap_or_else(|e| panic!("no report ({e}):\n{errors}"))
    }
}

#[test]
#[ignore = "builds a copy of the project, which takes a minute: .ci/nightly authoring"]
fn a_new_stage_is_graded_after_the_changes_that_contributing_lists() {
    let workspace = Workspace::above(Path::new(".")).expect("the course");
    let copy = Copy {
        root: workspace.root().join("target/new_stage"),
    };
    let mut files = file_tree::Files::new();
    for path in file_tree::workspace_paths(workspace.root()).expect("the files of the course") {
        let contents = file_tree::read(workspace.root(), &path).expect("a file");
        files.insert(path, contents);
    }
    file_tree::sync_folder(&copy.root, &files).expect("a copy");
    for insertion in INSERTIONS {
        copy.insert(insertion);
    }
    copy.write("stages/doubling/Cargo.toml", MANIFEST);
    copy.write("stages/doubling/src/lib.rs", STAGE);
    copy.write("grader/judge/src/tasks/part7_task1/mod.rs", CHECK);
    let course = std::fs::read_to_string(copy.root.join("stages/course.toml")).expect("it exists");
    copy.write("stages/course.toml", &(course + PART));

    let solved = copy.grade();
    assert_eq!(solved["score"], 1.0, "{solved:#}");
    copy.write(
        "stages/doubling/src/lib.rs",
        &STAGE.replace("2.0 * x", "x + 1.0"),
    );
    let wrong = copy.grade();
    let task = &wrong["tasks"][0];
    assert_eq!(task["status"], "failed", "{wrong:#}");
    let message = task["cases"][0]["findings"][0]["worst"]["message"].as_str();
    assert!(
        message.is_some_and(|m| m.contains("your result: -2; expected: -6")),
        "{wrong:#}"
    );
    copy.write(
        "stages/doubling/src/lib.rs",
        &STAGE.replace("2.0 * x", "if x < 0.0 { panic!(\"no\") } else { 2.0 * x }"),
    );
    let crashed = copy.grade().to_string();
    assert!(
        crashed.contains("x = -3.0"),
        "the input of the crash: {crashed}"
    );
    let [explained, _] = copy.run(&["explain", "part7.task1/three_numbers"]);
    assert!(explained.contains("3 numbers"), "{explained}");
    let stub = r#"kit::hole!("part7.task1", x)"#;
    copy.write(
        "stages/doubling/src/lib.rs",
        &STAGE.replace("2.0 * x", stub),
    );
    assert_eq!(copy.grade()["tasks"][0]["status"], "not_attempted");
}
