//! Reports of the grader in the window.

use super::common::{Window, session};
use std::path::PathBuf;
use viewer::command::Command;
use viewer::report::OpenReport;

/// A report in which the case `back_face` of `part1.task3` failed, and another case without a ray.
fn report(folder: &tempfile::TempDir) -> PathBuf {
    let spec = judge::cases::all(0)
        .into_iter()
        .find(|spec| spec.is("part1.task3", "back_face"))
        .expect("the case exists");
    let wire::Work::Triangles(work) = &spec.work else {
        panic!("rays against triangles")
    };
    let ray = work.probes[3].ray;
    let message = format!(
        "test_triangle: your result: miss; expected: hit. Ray: o = ({:?}, {:?}, {:?})",
        ray.o[0], ray.o[1], ray.o[2]
    );
    let case = |name: &str, worst: serde_json::Value| {
        serde_json::json!({
            "name": name, "tier": "core", "score": 0.5, "max_score": 2.0, "status": "failed",
            "about": "Rays that hit the other side.",
            "findings": [{
                "aspect": "decision", "expected": 320, "judged": 320, "wrong": 320,
                "worst": worst, "spread": null
            }]
        })
    };
    let passed = serde_json::json!({
        "name": "inside", "tier": "core", "score": 2.0, "max_score": 2.0, "status": "passed",
        "about": "", "findings": []
    });
    let report = serde_json::json!({
        "score": 0.0, "max_score": 4.0, "robust_score": 0.0, "robust_max_score": 0.0,
        "tasks": [{
            "key": "part1.task3", "title": "Intersecting triangles", "stage": "intersect",
            "status": "failed",
            "diagnosis": {"mistakes": ["cull"], "says": "your answers equal those of code that culls back faces"},
            "worst_as_test": null,
            "cases": [
                passed,
                case("back_face", serde_json::json!({"call": 3, "badness": 1.0, "message": message})),
                case("no_such_case", serde_json::Value::Null),
            ]
        }]
    });
    let path = folder.path().join("report.json");
    std::fs::write(&path, report.to_string()).expect("a file");
    path
}

#[test]
fn failing_cases_open_with_their_ray_and_both_answers() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut open = OpenReport::load(&report(&folder)).expect("a report");
    let names: Vec<&str> = open.cases.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(
        names,
        ["back_face", "no_such_case"],
        "passed cases are left out"
    );
    open.open(0);
    let view = open.view().expect("a ray");
    assert!(view.is_of_report);
    assert_eq!(view.scene.triangles.len(), 1);
    assert_eq!(view.right.len(), 1, "the exact answer is a hit");
    // Here the stages are the reference: its answer is right.
    assert_eq!(view.failure, None);
    assert_eq!(view.rows[0].student, "hit");
    assert!(view.rows.iter().all(|row| row.is_right), "{:?}", view.rows);
    let case = open.case().expect("a case");
    assert_eq!(
        case.diagnosis.as_deref(),
        Some("your answers equal those of code that culls back faces")
    );
    let test = case.test().expect("a test");
    assert!(
        test.contains("intersect::test_triangle") && test.contains("#[test]"),
        "{test}"
    );
    open.open(1);
    assert!(open.view().is_none());
}

#[test]
fn a_case_is_drawn_and_saved_as_a_test() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut session = session("", "");
    session.set_report(OpenReport::load(&report(&folder)).expect("a report"));
    session.output_folder = folder.path().to_owned();
    let mut window = Window::with(session, [900.0, 700.0]);
    window.session().apply(Command::OpenCase(0));
    window.settle();
    window.session().apply(Command::SaveCaseAsTest);
    let path = folder.path().join("stages/intersect/tests/ray.rs");
    assert!(path.is_file(), "{}", window.session().message());
    window.session().say("");
    let snapshots = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots");
    let options = egui_kittest::SnapshotOptions::new()
        .output_path(snapshots)
        .max_failed_pixels(30);
    window.settle();
    window.harness.snapshot_options("report", &options);
}

#[test]
fn a_file_that_is_no_report_is_a_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    std::fs::write(&path, "[]").expect("a file");
    let why = OpenReport::load(&path).err().expect("an error");
    assert!(why.contains("is not a report of the grader"), "{why}");
    let why = OpenReport::load(&folder.path().join("none.json"))
        .err()
        .expect("an error");
    assert!(why.contains("cannot read the report"), "{why}");
}
