//! Hostile submissions: code that is refused, that does not compile within the limits, that tries
//! to get out while it runs, and that tries to spoil its own run; and folders that are not what
//! they seem. None of them gets out, gets points by it, or ends the grader.
//!
//! The corpus is in the files beside this one. All that needs a build takes minutes: run it with
//! `cargo test --release -p submission --test hostile -- --ignored`.

#![cfg(target_os = "linux")]

mod by_heart;
mod compiler;
mod corpus;
mod folders;
mod growth;

use corpus::{Case, Class, attempts_code, cases};
use grader::build::BuildOutcome;
use submission::one::Outcome;

/// How many attempts share a worker: so many lines of a case are kept.
const MOST_ATTEMPTS: usize = 9;

#[test]
fn the_corpus_is_large_enough() {
    let files = ["scan", "compile", "attempts", "run"];
    let count: usize = files.iter().map(|file| cases(file).len()).sum();
    assert!(count + folders::COUNT >= 60, "{count}");
}

#[test]
fn forbidden_code_is_refused_with_a_sentence() {
    for case in cases("scan") {
        let Some(says) = &case.says else { continue };
        let files = case.files();
        let found = submission::scan::forbidden("intersect", &files);
        let all = found.join("\n");
        assert!(all.contains(says.as_str()), "{}: {all:?}", case.name);
    }
}

#[test]
fn the_reference_has_no_forbidden_code() {
    for stage in [
        "raygen",
        "intersect",
        "bbox",
        "bvh",
        "direct",
        "global",
        "adaptive",
    ] {
        let found = submission::scan::forbidden(stage, &corpus::reference(stage));
        assert_eq!(found, [""; 0]);
    }
}

/// Fails the test with all of `wrong`, if there is any: a corpus takes too long to stop at the first.
#[track_caller]
fn assert_none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// What the scan refuses, the compiler and its limits refuse, too.
#[test]
#[ignore = "builds each submission: minutes"]
fn forbidden_code_that_is_not_scanned_does_not_compile() {
    let class = Class::open();
    let mut wrong = Vec::new();
    for case in cases("scan") {
        let Some(unscanned) = &case.unscanned else {
            continue;
        };
        match class.build(&case.files(), None) {
            BuildOutcome::Worker(_) => wrong.push(format!("{}: it compiles", case.name)),
            BuildOutcome::DoesNotCompile(errors) => {
                if !errors.messages.contains(unscanned.as_str()) {
                    wrong.push(format!("{}: {}", case.name, errors.messages));
                }
            }
        }
    }
    assert_none(&wrong);
}

/// Where nothing keeps files from the compiler, code that read one is refused by the compiler's
/// list of what it has read, and no message shows the file. `unscanned` says what stops it
/// elsewhere.
#[test]
#[ignore = "builds each submission: minutes"]
fn files_that_the_compiler_could_read_are_no_use() {
    let mut open = corpus::levels()
        .into_iter()
        .filter(|level| !level.closes_files() && level.seals());
    let class = Class::with(open.next_back().expect("a level without Landlock"));
    let mut wrong = Vec::new();
    for case in cases("scan") {
        if case.unscanned.as_deref() != Some("Permission denied") {
            continue;
        }
        let messages = match class.build(&case.files(), None) {
            BuildOutcome::Worker(_) => "it compiles".to_string(),
            BuildOutcome::DoesNotCompile(errors) => errors.messages,
        };
        let is_refused = [
            "the compiler read the file",
            "its messages are not shown",
            // Memory of another process, a device without end.
            "couldn't read",
        ]
        .iter()
        .any(|why| messages.contains(why));
        println!("{}: {messages}", case.name);
        if !is_refused || messages.contains("root:") {
            wrong.push(format!("{}: {messages}", case.name));
        }
    }
    assert_none(&wrong);
    class.still_grades_the_reference();
}

#[test]
#[ignore = "builds each submission: minutes"]
fn code_that_does_not_compile_has_no_points_and_shows_why() {
    let class = Class::open();
    let mut wrong = Vec::new();
    for case in cases("compile") {
        let graded = class.grade(&case.files(), 1).expect(&case.name);
        let report = &graded.report;
        let says = case.says.as_deref().unwrap_or_default();
        let is_obeyed = |c: char| c.is_control() && c != '\n' || c == '\u{202e}';
        let is_shown = report.compiler.contains(says) && !report.compiler.contains(is_obeyed);
        if graded.outcome == Outcome::Graded || !is_shown || report.scores.score > 0.0 {
            let start: String = report.compiler.chars().take(2000).collect();
            wrong.push(format!("{}: {:?}: {start}", case.name, graded.outcome));
        }
    }
    assert_none(&wrong);
    class.still_grades_the_reference();
}

#[test]
#[ignore = "builds submissions: a minute"]
fn no_attempt_gets_out() {
    let class = Class::open();
    let mut wrong = Vec::new();
    for some in cases("attempts").chunks(MOST_ATTEMPTS) {
        let code = attempts_code(some);
        let files = Case::with_code(&code).files();
        let graded = class.grade(&files, 1).expect("it is graded");
        let report = &graded.report;
        let is_held = |case: &&Case| !report.printed.contains(&format!("{}: held", case.name));
        wrong.extend(some.iter().filter(is_held).map(|case| case.name.clone()));
        if report.scores.score < report.scores.max_score {
            wrong.push(format!("it spoils its run: {}", report.printed));
        }
        wrong.extend((!report.compiler.is_empty()).then(|| report.compiler.clone()));
    }
    assert_none(&wrong);
    class.still_grades_the_reference();
}

#[test]
#[ignore = "builds each submission: minutes"]
fn code_that_spoils_its_run_loses_only_its_own_points() {
    let class = Class::open();
    let wrong = cases("run")
        .into_iter()
        .filter_map(|case| spoiled(&class, &case));
    let wrong: Vec<String> = wrong.collect();
    assert_none(&wrong);
    class.still_grades_the_reference();
}

/// Grades a case of `run.toml`. Returns what is wrong with its report, if anything is.
fn spoiled(class: &Class, case: &Case) -> Option<String> {
    let graded = class.grade(&case.files(), 1).expect(&case.name);
    let (report, scores) = (&graded.report, &graded.report.scores);
    println!("{}: {} of {}", case.name, scores.score, scores.max_score);
    let has_score = match case.score.as_deref() {
        // The seed draws which case is run first: it may be one of extra credit.
        Some("less") => {
            scores.score < scores.max_score || scores.robust_score < scores.robust_max_score
        }
        Some("all") => scores.score == scores.max_score,
        _ => true,
    };
    let json = grader::report::json(report).expect("a report is JSON");
    let says = case.says.as_deref().unwrap_or_default();
    let got_out = case.never.as_ref().is_some_and(|sign| json.contains(sign));
    let is_held = has_score && !got_out && json.contains(says) && report.compiler.is_empty();
    (!is_held).then(|| {
        let start: String = json.chars().take(2000).collect();
        format!("{}: {}{start}", case.name, report.compiler)
    })
}

/// Files that make cargo build more, or refuse the crate, are files that no module names.
#[test]
#[ignore = "builds a submission: seconds"]
fn files_to_which_cargo_gives_a_meaning_have_none() {
    let class = Class::open();
    let mut files = corpus::reference("intersect");
    for name in [
        "bin/build.rs",
        "bin/deps.rs",
        "bin/worker/main.rs",
        "main.rs",
        "build.rs",
    ] {
        let code = b"compile_error!(\"it is built\");".to_vec();
        files.insert(name.into(), code);
    }
    files.insert("bin/build\nscore 80 of 80.rs".into(), Vec::new());
    let report = class.grade(&files, 1).expect("it is graded").report;
    assert_eq!(report.compiler, "");
    assert_eq!(report.scores.score, report.scores.max_score);
}

/// Grades the cases that `FIRSTLIGHT_ONE` names, divided by commas, and prints what came of them. To
/// try new ones.
#[test]
#[ignore = "for trying a new submission"]
fn one_submission() {
    let names = std::env::var("FIRSTLIGHT_ONE").unwrap_or_default();
    let is_named = |case: &Case| names.split(',').any(|name| case.name == name.trim());
    let class = Class::open();
    let all = ["scan", "compile", "run"].into_iter().flat_map(cases);
    for case in all.filter(is_named) {
        let started = std::time::Instant::now();
        let graded = match class.grade(&case.files(), 1) {
            Ok(graded) => graded,
            Err(why) => {
                println!("{}: {why}", case.name);
                continue;
            }
        };
        let scores = &graded.report.scores;
        let seconds = started.elapsed().as_secs();
        println!(
            "{}: {:?}, {} of {}, {seconds} s",
            case.name, graded.outcome, scores.score, scores.max_score
        );
        let start = |text: &str| text.chars().take(1000).collect::<String>();
        println!(
            "{}\n{}",
            start(&graded.report.compiler),
            start(&graded.report.printed)
        );
        for case in scores.tasks.iter().flat_map(|task| &task.result.cases) {
            println!(
                "    {}: {}",
                case.name,
                start(&format!("{:?}", case.status))
            );
        }
    }
}

/// What keeps code in its folder changes no answer and no point.
#[test]
#[ignore = "builds submissions: a minute"]
fn honest_code_has_the_same_score_at_every_level() {
    for (stage, task) in [("intersect", "part1.task3"), ("bvh", "part2.task3")] {
        let files = corpus::reference(stage);
        for containment in corpus::levels() {
            let class = Class::with(containment.clone());
            let graded = class.grade_stage(stage, &files, task, 7);
            let report = graded.expect("it is graded").report;
            assert_eq!(report.containment, containment.to_string());
            let scores = report.scores;
            assert_eq!(scores.score, scores.max_score);
            assert_eq!(scores.robust_score, scores.robust_max_score);
        }
    }
}
