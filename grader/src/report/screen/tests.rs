use super::*;
use crate::diagnosis::{Certainty, Diagnosis};
use crate::report::HintLevel;
use crate::report::wrap::columns;
use crate::score::CaseResult;
use crate::score::functions::FunctionShare;
use crate::score::regularity::{Regularity, Shared};
use crate::workers::crash::Crash;
use crate::workers::printed::Printed;
use judge::findings::{Aspect, Class, Findings, Message};
use std::path::PathBuf;

/// Text of words of every length, such as nobody would write.
fn nasty(length: usize) -> String {
    let words = [
        "a",
        "supercalifragilistic",
        "123456.789012345678901",
        "π≈3",
        "(0.1, -2e300)",
    ];
    let text: Vec<&str> = words.iter().copied().cycle().take(length).collect();
    text.join(" ")
}

/// What wrong answers have in common.
fn common(place: &str) -> Regularity {
    Regularity {
        in_core: false,
        shared: Shared::Circumstances(vec![String::leak(place.to_owned())]),
    }
}

/// A failed case with a wrong answer whose message is `message`.
fn case(name: &str, tier: Tier, message: impl Into<Message>) -> CaseResult {
    let mut findings = Findings::default();
    let class = Some(Class::FalseMiss);
    findings.judge_class(Aspect::HitOrMiss, 3, class, 1.0, || message);
    CaseResult {
        tier,
        max_score: 2.0,
        about: format!("Rays beside it. {} Pitfall: an epsilon.", nasty(30)),
        ..CaseResult::failed(name, findings.into_vec())
    }
}

fn task(key: &str, title: &str, score: f64, cases: Vec<CaseResult>) -> TaskReport {
    TaskReport::from(TaskResult {
        key: key.into(),
        title: title.into(),
        score,
        max_score: 30.0,
        robust_score: 3.0,
        robust_max_score: 15.0,
        status: match cases.is_empty() {
            true => Status::Passed,
            false => Status::Failed,
        },
        stage: "intersect".into(),
        functions: Vec::new(),
        cases,
    })
}

/// A task that says all that a task can say, at great length.
fn talkative(key: &str) -> TaskReport {
    let names = (0..40).map(|i| format!("a_case_with_a_rather_long_name_{i}"));
    let message = Message::new(format!("test_triangle: your result: {}", nasty(40)))
        .asked(format!("Ray: o = {}", nasty(40)));
    let cases = names.map(|name| case(&name, Tier::Core, message.clone()));
    TaskReport {
        diagnosis: Some(Diagnosis {
            mistakes: vec!["culled".into()],
            says: nasty(60),
            description: nasty(60),
            hint: nasty(60),
            equal: 1,
            of: 2,
            certainty: Certainty::Perhaps,
            ..Diagnosis::default()
        }),
        regularities: vec![common(&nasty(30)), common(&nasty(30)), common(&nasty(30))],
        test_file: Some(PathBuf::from("target/first-light/part1_task3.rs")),
        picture: Some(PathBuf::from("target/first-light/part1_task3.png")),
        ..task(key, &nasty(20), 1.0, cases.collect())
    }
}

fn reveal(hint: HintLevel) -> Reveal {
    Reveal { hint, extra: false }
}

fn screen(tasks: Vec<TaskReport>, context: &Context, reveal: Reveal) -> String {
    let report = Report::new(tasks, None);
    format_screen(&report, context, reveal, Page::default())
}

fn context(what: &str) -> Context {
    Context {
        what: what.into(),
        ..Context::default()
    }
}

#[test]
fn any_report_is_one_screen_or_two_with_a_hint() {
    let keys = |tasks: u32| (0..tasks).map(|i| format!("part{}.task{}", i / 4 + 1, i % 4 + 1));
    for tasks in [1, 4, 8, 16, 40] {
        for hint in HintLevel::ALL {
            let talk: Vec<TaskReport> = keys(tasks).map(|key| talkative(&key)).collect();
            let context = Context {
                printed: vec![Printed {
                    task: "part1.task1".into(),
                    case: nasty(60),
                    first: vec!["x".into(); 1000],
                    ..Printed::default()
                }],
                changed_given: vec![nasty(5); 9],
                compiler: Some(format!("error: {}\n", nasty(300))),
                ..context("part1")
            };
            for width in [40, 80, 100] {
                let page = Page {
                    width,
                    ..Page::default()
                };
                let report = Report::new(talk.clone(), None);
                let text = format_screen(&report, &context, reveal(hint), page);
                assert!(
                    text.lines().count() <= 23 * pages(hint),
                    "{tasks} tasks, {hint:?}:\n{text}"
                );
                let longest = text.lines().map(columns).max();
                assert!(longest <= Some(width), "{longest:?} of {width}:\n{text}");
            }
        }
    }
}

/// The last words name the mistake, or the place: descriptions of cases are left out before.
#[test]
fn the_name_of_a_mistake_is_never_cut() {
    let mistake =
        "code that passes a copy of the ray to the primitives; another guess, as likely: ";
    let says = mistake.repeat(6) + "code that ends the loop at its name";
    let place = "the ray's direction does not have length 1";
    let common = (0..4).map(|_| common(&format!("{place} and {place}")));
    let report = TaskReport {
        regularities: common.collect(),
        diagnosis: Some(Diagnosis {
            hint: says.clone(),
            says: says.clone(),
            ..Diagnosis::default()
        }),
        simplest: None,
        ..talkative("part1.task1")
    };
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = words(&screen(
        vec![report],
        &context("part1"),
        reveal(HintLevel::Remedy),
    ));
    assert_eq!(text.matches(&words(&says)).count(), 2, "{text}");
    assert_eq!(text.matches(place).count(), 8, "{text}");
}

/// Points with all their digits cannot be read: they are shortened before text is cut.
#[test]
fn a_long_question_has_few_digits() {
    let point = "(0.5963388366707779, 0.7104063649371519, -0.5066769289071882)";
    let question = format!("Point {point} with the normal {point}, seen along wo = {point}");
    let message = Message::new("your result: miss".into()).asked(question);
    let report = task(
        "part1.task1",
        "",
        1.0,
        vec![case("one", Tier::Core, message)],
    );
    let text = screen(vec![report], &context("part1"), reveal(HintLevel::Findings));
    assert!(text.contains("wo =\n") || text.contains("wo = ("), "{text}");
    assert!(
        text.contains("0.5963") && !text.contains("0.59633"),
        "{text}"
    );
}

/// Compares screens with a snapshot. `look_for` says what its reader looks for.
fn shows(name: &str, look_for: &str, screens: &[String]) {
    let mut settings = insta::Settings::clone_current();
    settings.set_description(look_for);
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("../../../tests/screens");
    let rule = format!("\n{}\n", "=".repeat(80));
    settings.bind(|| insta::assert_snapshot!(name, screens.join(&rule)));
}

/// The screen of a report on one task.
fn screen_of(report: TaskReport, hint: HintLevel) -> String {
    let context = context(&report.result.key);
    screen(vec![report], &context, reveal(hint))
}

fn triangles(score: f64, cases: Vec<CaseResult>) -> TaskReport {
    task("part1.task3", "Intersecting triangles", score, cases)
}

#[test]
fn a_gap_that_no_case_calls_is_told_once_all_is_complete() {
    let with_gap = |has_hole: bool| Context {
        places: vec![Place {
            key: "part1.task3".into(),
            title: "Intersecting triangles".into(),
            file: None,
            open: vec!["record_triangle".into()],
            has_hole,
        }],
        ..context("part1.task3")
    };
    let told = |score: f64, has_hole: bool| {
        let tasks = vec![triangles(score, Vec::new())];
        screen(tasks, &with_gap(has_hole), reveal(HintLevel::Cases))
            .contains("Still a gap: record_triangle.")
    };
    assert!(told(30.0, true));
    assert!(!told(29.0, true) && !told(30.0, false));
}

#[test]
fn what_no_case_judges_stands_beside_the_points() {
    let mut free = case("growth", Tier::Robust, "");
    free.status = Status::Passed;
    free.findings[0].undecided = Some("the machine is busy");
    let lost = case("a_case", Tier::Core, "your result: miss");
    let not_judged = TaskReport {
        not_judged: vec!["estimate_direct_lighting_mis".into()],
        ..triangles(1.0, Vec::new())
    };
    let changed = Context {
        changed_given: vec!["stages/kit/src/ray.rs".into()],
        ..context("part1.task3")
    };
    let complete = vec![triangles(30.0, Vec::new())];
    shows(
        "beside_the_points",
        "the function that no case judges; twice a case that costs nothing; a changed file, though all is complete",
        &[
            screen_of(not_judged, HintLevel::Cases),
            screen_of(triangles(30.0, vec![free.clone()]), HintLevel::Cases),
            screen_of(triangles(28.0, vec![lost, free]), HintLevel::Cases),
            screen(complete, &changed, reveal(HintLevel::Cases)),
        ],
    );
}

#[test]
fn the_screen_has_what_helps_most() {
    let ray = "o = (1.25, 0.123456789012345678, 2.0), d = (0.333333333333333333, 0.6666666666666666, 0.6666666666666666), t in [0.0, inf]";
    let result = "test_triangle: your result: miss; expected: hit at t = 11.6";
    let message = Message::new(result.into()).asked(format!("Ray: {ray}"));
    let wrong = TaskReport {
        regularities: vec![common("nothing is hit")],
        test_file: Some(PathBuf::from("target/first-light/part1_task3.rs")),
        ..triangles(28.0, vec![case("back_face", Tier::Core, message)])
    };
    let whole = task("part1.task1", "The sample loop", 30.0, Vec::new());
    let context = context("part1");
    shows(
        "what_helps_most",
        "one line a task, then of the failed one: what is common, the worst call with four digits, the test to copy, the next level",
        &[screen(
            vec![whole, wrong],
            &context,
            reveal(HintLevel::Findings),
        )],
    );
}

#[test]
fn half_written_code_is_right_so_far() {
    let right = CaseResult {
        status: Status::Passed,
        ..case("front_face", Tier::Core, "")
    };
    let open = CaseResult {
        status: Status::NotAttempted,
        ..case("interpolated_normals", Tier::Core, "")
    };
    let mut findings = Findings::default();
    findings.judge(Aspect::HitOrMiss, 0, true, 0.0, String::new);
    let share = FunctionShare {
        function: "record_triangle".into(),
        fraction: 0.0,
        hole: Some("record_triangle".into()),
    };
    let half = CaseResult {
        status: Status::Failed,
        reductions: share.reduction().into_iter().collect(),
        shares: vec![share],
        ..CaseResult::failed("edge", findings.into_vec())
    };
    let wrong = case("middle", Tier::Core, "your result: miss");
    shows(
        "half_written",
        "no hint is offered without wrong answers, and no case that waits for a function lacks the idea of the task",
        &[
            screen_of(triangles(12.0, vec![right, open]), HintLevel::Findings),
            screen_of(triangles(1.0, vec![wrong, half]), HintLevel::Findings),
        ],
    );
}

#[test]
fn where_only_whole_scenes_fail_the_other_tasks_come_first() {
    let scene = CaseResult {
        with_neighbours: true,
        ..case("whole_scene", Tier::Core, "your result: miss")
    };
    let extra = case("rounded_boxes", Tier::Robust, "your result: miss");
    let own = case("back_face", Tier::Core, "your result: miss");
    let failing = [
        vec![scene.clone(), extra.clone()],
        vec![scene, own],
        vec![extra],
    ];
    let screens = failing.map(|cases| screen_of(triangles(1.0, cases), HintLevel::Findings));
    shows(
        "whole_scenes",
        "only the first screen sends to the other tasks: its own core cases are right",
        &screens,
    );
}

#[test]
fn each_level_reveals_more() {
    let found = Diagnosis {
        mistakes: vec!["culled".into()],
        says: "your answers equal those of code that culls".into(),
        description: "culls".into(),
        hint: "look at the sign".into(),
        equal: 1,
        of: 1,
        certainty: Certainty::Likely,
        ..Diagnosis::default()
    };
    let wrong = TaskReport {
        diagnosis: Some(found),
        regularities: vec![common("nothing is hit")],
        ..triangles(
            1.0,
            vec![case("back_face", Tier::Core, "your result: miss")],
        )
    };
    shows(
        "levels",
        "what the case tests; what is wrong, and in common; the likely mistake; where to look, and no further level. Never the pitfall",
        &HintLevel::ALL.map(|hint| screen_of(wrong.clone(), hint)),
    );
}

#[test]
fn without_a_known_mistake_the_book_is_opened_where_it_helps() {
    let lost = |tier| case("back_face", tier, "your result: miss");
    let extra = Reveal {
        hint: HintLevel::Remedy,
        extra: true,
    };
    let robust = vec![triangles(30.0, vec![lost(Tier::Robust)])];
    shows(
        "in_the_book",
        "the contract for core points, the limits of the formulas for extra credit",
        &[
            screen_of(triangles(1.0, vec![lost(Tier::Core)]), HintLevel::Remedy),
            screen(robust, &context("part1.task3"), extra),
        ],
    );
}

#[test]
fn full_marks_are_a_success() {
    let full = TaskReport {
        picture: Some(PathBuf::from("target/first-light/ring.png")),
        ..triangles(
            30.0,
            vec![case("by_a_hair", Tier::Robust, "your result: miss")],
        )
    };
    let next = Place {
        key: "part2.task1".into(),
        title: "Constructing the BVH".into(),
        file: Some("stages/bvh/src/construct.rs".into()),
        open: vec!["construct_bvh".into()],
        has_hole: true,
    };
    let context = Context {
        next: Some(next),
        ..context("part1")
    };
    // The simplest call that extra credit asks for is there to think about.
    let inviting = TaskReport {
        simplest: Some(crate::diagnosis::simplest::SimplestCall {
            case: "by_a_hair".into(),
            aspect: Some(Aspect::HitOrMiss),
            function: None,
            input: "a triangle".into(),
            result: "your result: miss; expected: hit at t = 1.0".into(),
            test: None,
            only: None,
            wrong_where: Vec::new(),
            shown: None,
        }),
        ..full.clone()
    };
    let remedy = reveal(HintLevel::Remedy);
    let extra = Reveal {
        extra: true,
        ..remedy
    };
    shows(
        "full_marks",
        "complete, the picture, the next task and its chapter, and what extra credit asks for: what the case checks, the simplest call, or what fails with --extra. Nothing of mistakes",
        &[
            screen(vec![full.clone()], &context, remedy),
            screen(vec![inviting], &context, remedy),
            screen(vec![full], &context, extra),
        ],
    );
}

#[test]
fn an_attempted_task_comes_before_one_that_is_not() {
    let mut open = task("part1.task1", "The sample loop", 0.0, Vec::new());
    open.result.status = Status::NotAttempted;
    let pinhole = case("pinhole", Tier::Core, "your result: 1");
    let wrong = task("part1.task2", "", 3.0, vec![pinhole]);
    let place = Place {
        key: "part1.task1".into(),
        title: String::new(),
        file: Some("stages/raygen/src/pixel.rs".into()),
        open: vec!["raytrace_pixel".into()],
        has_hole: true,
    };
    let with_place = Context {
        places: vec![place],
        ..context("part1")
    };
    let findings = reveal(HintLevel::Findings);
    shows(
        "not_attempted",
        "first the failed case of the task that was begun; alone, the open one names its file and its function",
        &[
            screen(vec![open.clone(), wrong], &context("part1"), findings),
            screen(vec![open], &with_place, findings),
        ],
    );
}

#[test]
fn a_crash_says_how_and_a_stage_that_does_not_compile_shows_the_first_error() {
    let mut crashed = case("back_face", Tier::Core, "");
    crashed.status = Status::Crashed(Crash {
        call: Some(7),
        ..Crash::from("panicked at lib.rs:3: too small")
    });
    crashed.findings.clear();
    let mut broken = triangles(0.0, Vec::new());
    broken.result.status = Status::DoesNotCompile;
    let with_messages = Context {
        compiler: Some("warning: x\n\nerror: expected `;`\n --> a.rs:1\n\nerror: more\n".into()),
        ..context("part1.task3")
    };
    let of_another_task = Context {
        broken_file: Some("src/sphere.rs".into()),
        places: vec![Place {
            key: "part1.task4".into(),
            file: Some("src/sphere.rs".into()),
            ..Place::default()
        }],
        ..context("part1.task3")
    };
    // Of messages longer than a page the first is repeated below them.
    let long = Context {
        first_error: Some("a.rs:1:5: error: expected `;`".into()),
        ..context("part1.task3")
    };
    let findings = reveal(HintLevel::Findings);
    shows(
        "crashes_and_errors",
        "the panic and its call; of the stage: where the messages are, the file of another task, the first of many, and the first error itself with the number of the others",
        &[
            screen_of(triangles(3.0, vec![crashed]), HintLevel::Findings),
            screen_of(broken.clone(), HintLevel::Findings),
            screen(vec![broken.clone()], &of_another_task, findings),
            screen(vec![broken.clone()], &long, findings),
            screen(vec![broken], &with_messages, findings),
        ],
    );
}

#[test]
fn parts_whose_tasks_are_alike_have_one_line_among_many() {
    let tasks = (1..=10).map(|i| {
        let part = (i - 1) / 5 + 1;
        let score = if part == 1 || i == 7 { 30.0 } else { 0.0 };
        task(&format!("part{part}.task{i}"), "", score, Vec::new())
    });
    let text = screen(tasks.collect(), &context("all"), reveal(HintLevel::Cases));
    shows(
        "many_tasks",
        "one line for Part 1, five for the tasks of Part 2",
        &[text],
    );
}

#[test]
fn only_the_status_is_coloured() {
    let report = Report::new(vec![task("part1.task1", "Loop", 30.0, Vec::new())], None);
    let page = Page {
        colours: true,
        ..Page::default()
    };
    let text = format_screen(
        &report,
        &context("part1.task1"),
        reveal(HintLevel::Cases),
        page,
    );
    assert!(text.contains("\x1b[32mcomplete\x1b[0m\n"), "{text:?}");
    let plain = crate::build::compile_errors::plain(&text);
    assert_eq!(
        plain,
        screen(
            report.tasks,
            &context("part1.task1"),
            reveal(HintLevel::Cases)
        )
    );
}

/// The status is cut where it does not fit, and the cause of the few points has a line of its own.
#[test]
fn missing_ideas_are_told_at_any_width() {
    let mut findings = Findings::default();
    findings.judge(Aspect::Placement, 0, true, 0.0, String::new);
    let why = "counts a quarter until the case middle is right, too (sample positions)";
    let right = |name: &str| CaseResult {
        tier: Tier::Core,
        status: Status::Failed,
        reductions: vec![why.into()],
        ..CaseResult::failed(name, findings.clone().into_vec())
    };
    let wrong = case("middle", Tier::Core, "your result: miss");
    let cases = vec![wrong, right("edge"), right("corner")];
    let report = Report::new(vec![task("part1.task1", "The loop", 2.75, cases)], None);
    let screens = [120, 80].map(|width| {
        let page = Page {
            width,
            ..Page::default()
        };
        format_screen(
            &report,
            &context("part1"),
            reveal(HintLevel::Findings),
            page,
        )
    });
    shows(
        "missing_ideas",
        "two more count a quarter: in the first line where it fits, and in a sentence",
        &screens,
    );
}

#[test]
fn a_cause_that_is_told_is_not_called_unknown() {
    let told = |class| TaskReport {
        regularities: vec![Regularity {
            in_core: false,
            shared: Shared::Manner {
                aspect: Aspect::T,
                class,
                has_exceptions: false,
                is_robust: false,
            },
        }],
        ..triangles(
            1.0,
            vec![case("front_face", Tier::Core, "your result: t = 2.32")],
        )
    };
    shows(
        "told_causes",
        "that no single known mistake explains the answers stands in the first screen alone",
        &[Class::Zero, Class::Rounded].map(|class| screen_of(told(class), HintLevel::Mistake)),
    );
}
