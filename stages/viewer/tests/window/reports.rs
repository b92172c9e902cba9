//! Reports of the grader in the window.

use super::common::{Window, session};
use egui::Key;
use egui_kittest::kittest::Queryable;
use std::path::{Path, PathBuf};
use viewer::command::Command;
use viewer::picture_pair::PairView;
use viewer::report::case_pictures::{golden_folder, of_case};
use viewer::report::stage_answer::answer_of;
use viewer::report::{
    CaseContent, CasePart, CasePictures, CaseView, FailedCase, OpenCase, OpenReport,
};
use viewer::session::Mode;

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

/// What is computed about a case of a report.
fn content(open: &OpenReport, index: usize) -> CaseContent {
    CaseContent::of(&open.cases[index])
}

#[test]
fn failing_cases_open_with_their_ray_and_both_answers() {
    let folder = tempfile::tempdir().expect("a folder");
    let open = OpenReport::load(&report(&folder)).expect("a report");
    let names: Vec<&str> = open.cases.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(
        names,
        ["back_face", "no_such_case"],
        "passed cases are left out"
    );
    let content_of_ray = content(&open, 0);
    let Some(CaseView::Ray(view)) = &content_of_ray.view else {
        panic!("a ray: {content_of_ray:?}")
    };
    assert!(view.is_of_report);
    assert_eq!(view.shown.scene.triangles.len(), 1);
    assert_eq!(view.shown.expected.len(), 1, "the exact answer is a hit");
    // Here the stages are the reference: its answer is right.
    assert_eq!(view.failure, None);
    assert_eq!(view.shown.rows[0].yours.as_deref(), Some("hit"));
    assert!(
        view.shown.rows.iter().all(|row| row.is_right),
        "{:?}",
        view.shown.rows
    );
    assert_eq!(content_of_ray.wrong_now, Some(Vec::new()));
    let case = &open.cases[0];
    assert_eq!(
        case.diagnosis.as_deref(),
        Some("your answers equal those of code that culls back faces")
    );
    let test = case.test().expect("a test");
    assert!(
        test.contains("intersect::test_triangle") && test.contains("#[test]"),
        "{test}"
    );
    assert!(content(&open, 1).view.is_none());
}

/// A case that failed at its first call, as the report would have it.
pub(crate) fn failed(task: &str, name: &str) -> FailedCase {
    let spec = judge::cases::of(task, 0)
        .into_iter()
        .find(|spec| spec.name == name)
        .expect("the case exists");
    FailedCase {
        task: task.to_owned(),
        title: String::new(),
        stage: String::new(),
        name: name.to_owned(),
        tier: judge::Tier::Core,
        about: String::new(),
        points: (0.0, 1.0),
        status: "failed".to_owned(),
        findings: vec![viewer::report::file::WrongAspect {
            aspect: "t".to_owned(),
            wrong: 1,
            judged: 1,
            worst: Some((0, String::new())),
        }],
        diagnosis: None,
        spec: Some(Box::new(spec)),
    }
}

/// Trees, traversals, direct light and paths have a view in 3D; with the reference nothing is wrong in
/// it, and every picture equals its golden one.
#[test]
fn cases_of_every_part_are_shown_in_3d_and_as_pictures() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (task, name, kind, has_picture) in [
        ("part1.task3", "picture_of_a_ring", "Ray", true),
        ("part2.task1", "centroids_on_the_split", "Tree", false),
        ("part2.task3", "both_children", "Visits", false),
        ("part2.task3", "shadow_rays_in_cornell_box", "Visits", false),
        ("part3.task2", "", "Light", false),
        ("part3.task3", "", "Light", false),
        ("part4.task2", "", "Light", false),
        ("part1.task1", "", "Pixel", false),
        ("part3.task1", "", "Scatter", false),
        ("part4.task1", "mirror", "Scatter", false),
        ("part4.task3", "", "Plot", false),
        ("part5.task1", "", "Plot", false),
        ("part5.task1", "batches", "Pixel", false),
        ("part5.task2", "", "Plot", false),
    ] {
        let name = match name {
            "" => judge::cases::of(task, 0)[0].name,
            name => name,
        };
        let case = failed(task, name);
        let content = CaseContent::of(&case);
        let wrong = match &content.view {
            Some(CaseView::Ray(case)) => ("Ray", case.shown.rows.iter().any(|row| !row.is_right)),
            Some(CaseView::Tree(case)) => ("Tree", !case.wrong.is_empty()),
            Some(CaseView::Visits(case)) => ("Visits", case.parting.is_some()),
            Some(CaseView::Light(case)) => ("Light", case.points.is_empty()),
            Some(CaseView::Pixel(case)) => ("Pixel", case.inside() != case.samples.len()),
            Some(CaseView::Scatter(case)) => ("Scatter", case.yours.is_none()),
            Some(CaseView::Plot(case)) => ("Plot", case.levels.is_empty()),
            None => ("nothing", true),
        };
        assert_eq!(wrong, (kind, false), "{task} {name}");
        assert_eq!(content.wrong_now, Some(Vec::new()), "{task} {name}");
        let pictures = [
            (CasePart::CasePicture, has_picture),
            (CasePart::TaskPicture, true),
        ];
        let of_case = CasePictures::of(&case, content.answer.as_deref(), here);
        for (part, is_there) in pictures {
            let legend = of_case
                .pair(part)
                .map(|pair| pair.map(|pair| pair.legend.len()));
            let expected = is_there.then_some(Ok(0));
            assert_eq!(legend, expected, "{task} {name} {part:?}");
        }
    }
}

#[test]
fn differing_pixels_of_a_case_have_their_cause() {
    let case = failed("part1.task3", "picture_of_a_ring");
    let spec = case.spec.expect("it was found");
    let mut answer = answer_of(&spec).expect("the reference answers").answer;
    let wire::Answer::BruteForce(hits) = &mut answer else {
        panic!("hits: {answer:?}")
    };
    let mut lost = 0;
    for hit in hits.hits.iter_mut().step_by(5) {
        lost += usize::from(hit.take().is_some());
    }
    let goldens = golden_folder(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("the project's");
    let pair = of_case(&goldens, &spec, judge::Tier::Core, &answer)
        .expect("a picture")
        .expect("a golden one");
    let [cause] = pair.legend.as_slice() else {
        panic!("one cause: {:?}", pair.legend)
    };
    assert_eq!((cause.label, cause.pixels), ("false miss", lost));
    assert!(lost > 100);
}

#[test]
fn pictures_of_a_case_are_wiped_flickered_and_told_apart() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut session = session("", "");
    session.set_report(OpenReport::load(&report(&folder)).expect("a report"));
    let mut window = Window::with(session, [900.0, 700.0]);
    window.press(Key::Y);
    assert_eq!(window.session().mode(), Mode::Report);
    let part = |window: &mut Window| window.session().opened_case().and_then(OpenCase::part);
    assert_eq!(part(&mut window), Some(CasePart::View));
    let before = *window.session().view_orbit().expect("a camera");
    window.press_with(egui::Modifiers::SHIFT, Key::ArrowLeft);
    assert_ne!(*window.session().view_orbit().expect("a camera"), before);
    window.press(Key::Y);
    assert_eq!(part(&mut window), Some(CasePart::TaskPicture));
    let display = |window: &mut Window| window.session().opened_case().expect("a case").display;
    window.drag(
        egui::PointerButton::Primary,
        egui::pos2(200.0, 300.0),
        egui::pos2(300.0, 300.0),
    );
    let wipe = display(&mut window).wipe;
    assert!(wipe != 0.5 && wipe > 0.0 && wipe < 1.0, "{wipe}");
    window.press(Key::F);
    assert_eq!(display(&mut window).view, PairView::Flicker);
    window.press(Key::J);
    assert_eq!(display(&mut window).view, PairView::First);
    window.press(Key::Enter);
    assert_eq!(
        window.session().opened_case().map(|case| case.index),
        Some(1)
    );
    window.press(Key::Backspace);
    assert_eq!(
        window.session().opened_case().map(|case| case.index),
        Some(0)
    );
    window.press(Key::E);
    assert_eq!(window.session().mode(), Mode::Edit);
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
    let shown = "hit or miss: wrong on 320 of 320";
    assert!(window.harness.query_by_label(shown).is_some());
}

/// A window with the first case of a report, about which `content` is known.
fn window_with(case: FailedCase, content: CaseContent) -> Window {
    sized_window_with([1000.0, 700.0], case, content)
}

/// The same in a window of another size.
pub(crate) fn sized_window_with(size: [f32; 2], case: FailedCase, content: CaseContent) -> Window {
    let case = std::sync::Arc::new(case);
    let path = PathBuf::from("report.json");
    let opened = OpenCase::with_content(0, &case, &path, content);
    let mut session = session("", "");
    session.set_report(OpenReport {
        path,
        cases: vec![case],
        opened: Some(opened),
    });
    let mut window = Window::with(session, size);
    window.press(Key::Y);
    window.harness.remove_cursor();
    window.session().say("");
    window.settle();
    window
}

fn check(window: &mut Window, name: &str) {
    let snapshots = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/snapshots");
    let options = egui_kittest::SnapshotOptions::new()
        .output_path(snapshots)
        .max_failed_pixels(30);
    window.harness.snapshot_options(name, &options);
}

#[test]
fn a_turned_normal_and_a_ray_that_was_not_shortened_are_drawn() {
    let mut case = failed("part1.task3", "back_face");
    case.findings[0].worst = Some((3, String::new()));
    let mut content = CaseContent::of(&case);
    let Some(CaseView::Ray(view)) = &mut content.view else {
        panic!("a ray")
    };
    let max_t = view.max_t.expect("the call shortens the ray");
    assert!(max_t.is_right());
    assert_eq!(max_t.right, view.shown.yours[0]);
    let [right, yours] = view.shown.normals.as_mut().expect("there are normals");
    *yours = -*right;
    view.max_t = Some(viewer::report::ray_case::MaxT {
        yours: 1.4 * max_t.right,
        right: max_t.right,
    });
    let row = view.shown.rows.iter_mut().find(|row| row.name == "max_t");
    row.expect("it is compared").is_right = false;
    content.wrong_now = Some(vec!["max_t: wrong on 1 of 1".to_owned()]);
    check(&mut window_with(case, content), "report_difference");
}

#[test]
fn orders_of_children_are_side_by_side_with_a_way_to_the_first_difference() {
    let case = failed("part2.task3", "both_children");
    let mut content = CaseContent::of(&case);
    let Some(CaseView::Visits(view)) = &mut content.view else {
        panic!("a traversal")
    };
    assert_eq!(
        view.wrong_order(),
        None,
        "the reference visits the nearer child first"
    );
    let order = view
        .orders
        .last_mut()
        .expect("a node with two entered children");
    order.visited.swap(0, 1);
    order.visited[0].first_test = order.visited[1].first_test;
    let test = view.first_difference().expect("it differs");
    content.wrong_now = Some(vec!["work: too many box tests".to_owned()]);
    let mut window = window_with(case, content);
    let step = |window: &mut Window| window.session().opened_case().expect("a case").step;
    assert_eq!(
        step(&mut window),
        test + 1,
        "the walk starts at the difference"
    );
    window.session().apply(Command::GoToEvent(0));
    window.settle();
    window
        .harness
        .get_by_label("Go to the first difference")
        .click();
    window.settle();
    assert_eq!(step(&mut window), test + 1);
    window.harness.remove_cursor();
    window.settle();
    check(&mut window, "report_order");
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
