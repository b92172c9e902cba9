//! Outcomes of every kind, of a course with one task.

use formats::annotation;
use formats::classroom50::Assignment;
use formats::settings::Visibility;
use formats::{Graded, Outcome, Settings};
use grader::course::Course;
use grader::course::sources::SourceFile;
use grader::report::{HintLevel, Report, Reveal, TaskReport, json};
use grader::score::regularity::{Regularity, Shared};
use grader::score::{CaseResult, Status, TaskResult};
use grader::workers::crash::Crash;
use judge::findings::{Aspect, Finding, Findings};

const COURSE: &str = r#"
conventions = []
[[part]]
number = 1
title = "Rays"
[[part.task]]
key = "part1.task3"
title = "Triangles"
stage = "intersect"
holes = ["intersect_triangle"]
cases = [
    { name = "inside", tier = "core", points = 7.5 },
    { name = "beside", tier = "core", points = 2.5 },
    { name = "edges", tier = "robust", points = 1 },
    { name = "slivers", tier = "robust", points = 1 },
]
"#;

const SOURCE: &str = "//! Triangles.\n\npub fn intersect_triangle(a: u8) -> u8 {\n    a\n}\n";

pub(crate) fn settings() -> Settings {
    let get = |name: &str| {
        Some(match name {
            "SUBMISSION_TAG" => "submit/2026-06-01T14-32-05Z-a1b2c3d".to_owned(),
            "ASSIGNMENT_TYPE" | "REVIEW_URL" => return None,
            name => format!("https://example.org/{name}"),
        })
    };
    Settings {
        add_extra: false,
        visibility: Visibility::AfterDueDate,
        assignment: Assignment::read(get, 1_780_324_321),
    }
}

/// Ten calls, the first `wrong` of which are wrong; `message` describes them.
fn finding(wrong: u32, message: &str) -> Finding {
    let mut findings = Findings::default();
    for call in 0..10 {
        findings.judge(Aspect::HitOrMiss, call as usize, call >= wrong, 1.0, || {
            message.to_owned()
        });
    }
    let mut finding = findings.into_vec().remove(0);
    finding.main = true;
    finding
}

fn graded(statuses: [Status; 4], wrong: [u32; 4], said: &str) -> Outcome {
    let course = Course::parse(COURSE).expect("it is valid");
    let task = course.tasks().next().expect("it has a task");
    let cases = task
        .cases
        .iter()
        .zip(statuses)
        .zip(wrong)
        .map(|((entry, status), wrong)| {
            let findings = match status {
                Status::Passed => vec![finding(wrong, said)],
                _ => Vec::new(),
            };
            CaseResult::new(entry, "Rays at it. Pitfall: signs.", status, findings, &[])
        });
    let report = TaskReport {
        regularities: vec![Regularity {
            in_core: false,
            shared: Shared::Circumstances(vec!["t is large"]),
        }],
        worst_as_test: (wrong[0] + wrong[1] > 0).then(|| "#[test]\nfn worst() {}\n".to_owned()),
        ..TaskReport::from(TaskResult::new(task, cases.collect()))
    };
    let report = Report::new(vec![report], None);
    let reveal = Reveal {
        hint: HintLevel::Findings,
        extra: false,
    };
    let sources = [SourceFile {
        path: "stages/intersect/src/triangle.rs".into(),
        text: SOURCE.into(),
    }];
    let compiler = match report.tasks[0].result.status {
        Status::DoesNotCompile => {
            format!("error: {said}\n --> stages/intersect/src/triangle.rs:4:5\n")
        }
        _ => String::new(),
    };
    Outcome::Graded(Box::new(Graded {
        what: "part1".into(),
        annotations: annotation::all(&report, &compiler, &sources, reveal),
        json: json(&report).expect("numbers are finite"),
        report,
        reveal,
        notes: format!("{compiler}{said}\n"),
    }))
}

const PASSED: Status = Status::Passed;

/// Every point.
pub(crate) fn full() -> Outcome {
    graded([PASSED; 4], [0; 4], "")
}

/// A core case and one of extra credit are wrong.
pub(crate) fn partly() -> Outcome {
    graded(
        [PASSED; 4],
        [0, 3, 0, 1],
        "your result: hit; expected: miss. Ray: o = 1",
    )
}

/// A case panics, one needs another task, one is not written.
pub(crate) fn broken() -> Outcome {
    let panicked = Crash {
        call: Some(0),
        panicked_at: Some(("stages/intersect/src/triangle.rs".into(), 4)),
        ..Crash::from("panicked at stages/intersect/src/triangle.rs:4:5: overflow")
    };
    let statuses = [
        Status::Crashed(panicked),
        Status::Needs("part1.task2".into()),
        Status::NotAttempted,
        PASSED,
    ];
    graded(statuses, [0; 4], "")
}

pub(crate) fn nothing_compiles() -> Outcome {
    let statuses = [const { Status::DoesNotCompile }; 4];
    graded(statuses, [0; 4], "mismatched types")
}

/// Code that says things which are commands, tags or fences elsewhere.
pub(crate) fn hostile() -> Outcome {
    let said = "x\n::set-output name=a::b\n```\n````\n# Full points\n]]></system-out><evil/>\u{0}\u{1b}[2J\"&<>'";
    graded([PASSED; 4], [1, 1, 1, 1], said)
}

pub(crate) fn failed_grader() -> Outcome {
    Outcome::Infrastructure("the disk is full".into())
}

pub(crate) fn refused() -> Outcome {
    Outcome::Refused {
        why: "the folder contains no stage".into(),
        max_score: 10.0,
    }
}

/// Every kind of outcome, with its name.
pub(crate) fn all() -> [(&'static str, Outcome); 7] {
    [
        ("full", full()),
        ("partly", partly()),
        ("broken", broken()),
        ("nothing_compiles", nothing_compiles()),
        ("hostile", hostile()),
        ("refused", refused()),
        ("failed_grader", failed_grader()),
    ]
}
