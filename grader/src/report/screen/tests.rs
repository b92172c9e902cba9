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

#[test]
fn functions_that_no_case_judges_are_named_beside_the_points() {
    let full = TaskReport {
        not_judged: vec!["estimate_direct_lighting_mis".into()],
        ..task("part3.task3", "Lights", 1.0, Vec::new())
    };
    let text = screen(
        vec![full],
        &context("part3.task3"),
        reveal(HintLevel::Cases),
    );
    let says = "not judged: estimate_direct_lighting_mis of part3.task3";
    assert!(text.contains(says), "{text}");
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

#[test]
fn the_screen_has_what_helps_most() {
    let ray = "o = (1.25, 0.123456789012345678, 2.0), d = (0.333333333333333333, 0.6666666666666666, 0.6666666666666666), t in [0.0, inf]";
    let result = "test_triangle: your result: miss; expected: hit at t = 11.6";
    let message = Message::new(result.into()).asked(format!("Ray: {ray}"));
    let wrong = TaskReport {
        regularities: vec![common("nothing is hit")],
        test_file: Some(PathBuf::from("target/first-light/part1_task3.rs")),
        ..task(
            "part1.task3",
            "Intersecting triangles",
            28.0,
            vec![case("back_face", Tier::Core, message)],
        )
    };
    let whole = task(
        "part1.task1",
        "Filling in the sample loop",
        30.0,
        Vec::new(),
    );
    let text = screen(
        vec![whole, wrong],
        &context("part1"),
        reveal(HintLevel::Findings),
    );
    for line in [
        "part1.task1  Filling in the sample loop",
        "complete\n",
        "1 case fails\n",
        "part1.task3: 1 case fails: back_face\n",
        "  In common: wrong only where nothing is hit.\n",
        "  back_face: hit or miss wrong on 1 of 1 calls\n",
        "    test_triangle: your result: miss; expected: hit at t = 11.6\n",
        "    Ray: o = (1.25, 0.1235, 2.0), d = (0.3333, 0.6667, 0.6667), t in [0.0, inf]\n",
        "  As a test: cp target/first-light/part1_task3.rs stages/intersect/tests &&\n    cargo test -p intersect --test part1_task3\n",
        "score 58 of 60; extra credit 6 of 30\n",
        "`--hint 3` for more (the likely mistake)",
        "explain part1.task3/back_face`\n",
    ] {
        assert!(text.contains(line), "no {line:?} in\n{text}");
    }
}

#[test]
fn a_half_written_task_without_wrong_answers_offers_no_hint() {
    let mut right = case("front_face", Tier::Core, "");
    right.status = Status::Passed;
    let mut open = case("interpolated_normals", Tier::Core, "");
    open.status = Status::NotAttempted;
    let half = task(
        "part1.task3",
        "Intersecting triangles",
        12.0,
        vec![right, open],
    );
    let text = screen(vec![half], &context("part1"), reveal(HintLevel::Findings));
    assert!(text.contains("12/30  right so far\n"), "{text}");
    assert!(!text.contains("--hint"), "{text}");
}

#[test]
fn where_only_whole_scenes_fail_the_other_tasks_come_first() {
    let scene = CaseResult {
        with_neighbours: true,
        ..case("whole_scene", Tier::Core, "your result: miss")
    };
    let extra = case("rounded_boxes", Tier::Robust, "your result: miss");
    let own = case("back_face", Tier::Core, "your result: miss");
    let says = |cases: Vec<CaseResult>| {
        let report = task("part2.task3", "", 1.0, cases);
        let text = screen(
            vec![report],
            &context("part2.task3"),
            reveal(HintLevel::Findings),
        );
        text.replace("\n    ", " ")
            .contains("if one of these tasks fails, mend it first")
    };
    assert!(says(vec![scene.clone(), extra.clone()]));
    assert!(!says(vec![scene, own]));
    assert!(!says(vec![extra]));
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
        ..task(
            "part1.task3",
            "",
            1.0,
            vec![case("back_face", Tier::Core, "your result: miss")],
        )
    };
    let shows = |hint, word: &str| {
        screen(vec![wrong.clone()], &context("part1.task3"), reveal(hint)).contains(word)
    };
    let levels = |word: &str| HintLevel::ALL.map(|hint| shows(hint, word));
    assert_eq!(
        levels("back_face tests: Rays beside it."),
        [true, false, true, true]
    );
    assert_eq!(levels("Pitfall"), [false; 4]);
    assert_eq!(levels("your result: miss"), [false, true, true, true]);
    assert_eq!(levels("In common"), [false, true, true, true]);
    assert_eq!(
        levels("Likely: your answers equal"),
        [false, false, true, true]
    );
    assert_eq!(
        levels("Hint: look at the sign"),
        [false, false, false, true]
    );
    assert_eq!(
        levels("More in the book: cargo grader book part1.task3#mistakes"),
        [false, false, false, true]
    );
    assert_eq!(levels("for more ("), [true, true, true, false]);
}

#[test]
fn without_a_known_mistake_the_book_is_opened_where_it_helps() {
    let shows = |tier, extra, word: &str| {
        let lost = case("back_face", tier, "your result: miss");
        let most = if tier == Tier::Core { 1.0 } else { 30.0 };
        let wrong = task("part1.task3", "", most, vec![lost]);
        let reveal = Reveal {
            hint: HintLevel::Remedy,
            extra,
        };
        screen(vec![wrong], &context("part1.task3"), reveal).contains(word)
    };
    assert!(shows(Tier::Core, false, "part1.task3#the-contract"));
    let limits = "part1.task3#where-the-formulas-break";
    assert!(shows(Tier::Robust, true, limits));
}

#[test]
fn what_cannot_be_judged_is_told_beside_the_score() {
    let mut free = case("growth", Tier::Robust, "");
    free.status = Status::Passed;
    free.findings[0].undecided = Some("the machine is busy");
    let lost = case("a_case", Tier::Core, "your result: miss");
    for (score, cases) in [(30.0, vec![free.clone()]), (28.0, vec![lost, free])] {
        let task = task("part2.task1", "Constructing the BVH", score, cases);
        let text = screen(
            vec![task],
            &context("part2.task1"),
            reveal(HintLevel::Cases),
        );
        let sentence = "part2.task1/growth costs nothing: the machine is busy\n";
        assert!(text.contains(sentence), "{text}");
    }
}

#[test]
fn full_marks_are_a_success() {
    let lost = case("by_a_hair", Tier::Robust, "your result: miss");
    let full = TaskReport {
        picture: Some(PathBuf::from("target/first-light/ring.png")),
        ..task("part1.task3", "Intersecting triangles", 30.0, vec![lost])
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
    let text = screen(vec![full.clone()], &context, reveal(HintLevel::Remedy));
    for line in [
        "Part 1 is complete.\n",
        "picture: target/first-light/ring.png\n",
        "Next: part2.task1 Constructing the BVH, in stages/bvh/src/construct.rs",
        "Its chapter: cargo grader book part2.task1\n",
        "extra credit 3 of 15: `cargo grader part1 --extra`\n",
        // Without a simple call, what the first failed case checks.
        "  it asks for by_a_hair: Rays beside it. a supercalifragilistic",
        "\n    your result: miss\n",
    ] {
        assert!(text.contains(line), "no {line:?} in\n{text}");
    }
    for word in ["no known mistake", "fails"] {
        assert!(!text.contains(word), "{text}");
    }
    // The simplest call that extra credit asks for is there to think about.
    let mut inviting = full.clone();
    inviting.simplest = Some(crate::diagnosis::simplest::SimplestCall {
        case: "by_a_hair".into(),
        aspect: Some(Aspect::HitOrMiss),
        function: None,
        input: "a triangle".into(),
        result: "your result: miss; expected: hit at t = 1.0".into(),
        test: None,
        only: None,
        wrong_where: Vec::new(),
        shown: None,
    });
    let invited = screen(vec![inviting], &context, reveal(HintLevel::Remedy));
    let invitation = "--extra`\n  it asks for by_a_hair: a triangle\n    your result: miss; expected: hit at t = 1\n";
    assert!(invited.contains(invitation), "{invited}");
    let extra = Reveal {
        hint: HintLevel::Remedy,
        extra: true,
    };
    let text = screen(vec![full], &context, extra);
    assert!(
        text.contains("1 case of extra credit fails: by_a_hair"),
        "{text}"
    );
    assert!(!text.contains("no known mistake"), "{text}");
}

#[test]
fn an_attempted_task_comes_before_one_that_is_not() {
    let mut open = task("part1.task1", "Filling in the sample loop", 0.0, Vec::new());
    open.result.status = Status::NotAttempted;
    let wrong = task(
        "part1.task2",
        "",
        3.0,
        vec![case("pinhole", Tier::Core, "your result: 1")],
    );
    let tasks = vec![open.clone(), wrong];
    let text = screen(tasks, &context("part1"), reveal(HintLevel::Findings));
    assert!(
        text.contains("part1.task2: 1 case fails: pinhole"),
        "{text}"
    );
    let place = Place {
        key: "part1.task1".into(),
        title: String::new(),
        file: Some("stages/raygen/src/pixel.rs".into()),
        open: vec!["raytrace_pixel".into()],
        has_hole: true,
    };
    let context = Context {
        places: vec![place],
        ..context("part1")
    };
    let text = screen(vec![open], &context, reveal(HintLevel::Findings));
    assert!(
        text.contains("Open stages/raygen/src/pixel.rs and write `raytrace_pixel`."),
        "{text}"
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
    let crash = task("part1.task3", "", 3.0, vec![crashed]);
    let text = screen(
        vec![crash],
        &context("part1.task3"),
        reveal(HintLevel::Findings),
    );
    assert!(
        text.contains("  back_face: panicked at lib.rs:3: too small (call 7"),
        "{text}"
    );
    let mut broken = task("part1.task3", "", 0.0, Vec::new());
    broken.result.status = Status::DoesNotCompile;
    let context = Context {
        compiler: Some("warning: x\n\nerror: expected `;`\n --> a.rs:1\n\nerror: more\n".into()),
        ..context("part1.task3")
    };
    let printed = screen(
        vec![broken.clone()],
        &self::context("part1.task3"),
        reveal(HintLevel::Findings),
    );
    assert!(
        printed.contains("does not compile: the compiler's messages are"),
        "{printed}"
    );
    assert!(!printed.contains("--long"), "{printed}");
    // Of messages longer than a page the first is repeated below them.
    let long = Context {
        first_error: Some("a.rs:1:5: error: expected `;`".into()),
        ..self::context("part1.task3")
    };
    let printed = screen(vec![broken.clone()], &long, reveal(HintLevel::Findings));
    let repeated = "\n    above.\n  The first: a.rs:1:5: error: expected `;`\n";
    assert!(printed.contains(repeated), "{printed}");
    let text = screen(vec![broken], &context, reveal(HintLevel::Findings));
    assert!(text.contains("stages/intersect does not compile"), "{text}");
    assert!(
        text.contains("  error: expected `;`\n   --> a.rs:1\n"),
        "{text}"
    );
    assert!(
        text.contains("and 1 other message of the compiler"),
        "{text}"
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
    assert!(text.starts_with("part1  5 tasks"), "{text}");
    assert!(text.contains("150/150  complete"), "{text}");
    assert_eq!(text.matches("\npart2.task").count(), 5, "{text}");
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
    let lines = |width: usize| -> Vec<String> {
        let page = Page {
            width,
            ..Page::default()
        };
        let text = format_screen(
            &report,
            &context("part1"),
            reveal(HintLevel::Findings),
            page,
        );
        text.lines().map(str::to_owned).collect()
    };
    let wide = lines(120);
    assert!(
        wide[0].ends_with("  1 case fails, 2 more count a quarter"),
        "{wide:?}"
    );
    let narrow = lines(80);
    assert!(narrow[0].ends_with("  1 case fails"), "{narrow:?}");
    let told = format!("  2 other cases are right, and each {why}");
    for lines in [wide, narrow] {
        let text: Vec<&str> = lines.iter().map(|line| line.trim()).collect();
        assert!(text.join(" ").contains(told.trim()), "{lines:?}");
    }
}

#[test]
fn a_right_case_with_an_unwritten_function_does_not_lack_the_idea() {
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
    let half_written = task("part1.task3", "", 1.0, vec![wrong, half]);
    let context = context("part1.task3");
    let text = screen(vec![half_written], &context, reveal(HintLevel::Findings));
    assert!(text.contains("  1 case fails\n"), "{text}");
    assert!(!text.contains("other case is right"), "{text}");
}

#[test]
fn a_cause_that_is_told_is_not_called_unknown() {
    let says = |class: Class| {
        let wrong = TaskReport {
            regularities: vec![Regularity {
                in_core: false,
                shared: Shared::Manner {
                    aspect: Aspect::T,
                    class,
                    has_exceptions: false,
                    is_robust: false,
                },
            }],
            ..task(
                "part1.task3",
                "",
                1.0,
                vec![case("front_face", Tier::Core, "your result: t = 2.32")],
            )
        };
        let context = context("part1.task3");
        let text = screen(vec![wrong], &context, reveal(HintLevel::Mistake));
        text.contains("single known mistake explains")
    };
    assert!(says(Class::Zero));
    assert!(!says(Class::Rounded));
}

#[test]
fn changed_given_files_are_told_even_if_all_is_complete() {
    let complete = task("part1.task1", "A task", 30.0, Vec::new());
    let context = Context {
        changed_given: vec!["stages/kit/src/ray.rs".into()],
        ..context("part1.task1")
    };
    let text = screen(vec![complete], &context, reveal(HintLevel::Cases));
    let says = "Given file stages/kit/src/ray.rs differs from the handout.";
    assert!(text.contains(says), "{text}");
}
