//! Hostile submissions: code that is refused, that does not compile within the limits, that tries
//! to get out while it runs, and that tries to spoil its own run; and folders that are not what
//! they seem. None of them gets out, gets points by it, or ends the grader.
//!
//! The corpus is in the files beside this one. All that needs a build takes minutes: run it with
//! `cargo test --release -p submission --test hostile -- --ignored`.

#![cfg(target_os = "linux")]

mod by_heart;
mod corpus;
mod folders;

use corpus::{Case, Class, attempts_code, cases};
use grader::compile::{BuildLimit, BuildOutcome};
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

/// What the scan refuses, the compiler's limits hold, too.
#[test]
#[ignore = "builds each submission: minutes"]
fn forbidden_code_that_is_not_scanned_does_not_compile() {
    let class = Class::open();
    for case in cases("scan") {
        let Some(unscanned) = &case.unscanned else {
            continue;
        };
        let built = class.build(&case.files());
        match built {
            BuildOutcome::Worker(_) => panic!("{}: it compiles", case.name),
            BuildOutcome::DoesNotCompile(errors) => assert!(
                errors.messages.contains(unscanned.as_str()),
                "{}: {}",
                case.name,
                errors.messages
            ),
        }
    }
}

#[test]
#[ignore = "builds each submission: minutes"]
fn code_that_is_too_much_for_the_compiler_is_ended() {
    let class = Class::open();
    for case in cases("compile") {
        let graded = class.grade(&case.files(), 1).expect(&case.name);
        let says = case.says.as_deref().unwrap_or_default();
        let report = &graded.report;
        assert!(
            report.compiler.contains(says),
            "{}: {}",
            case.name,
            report.compiler
        );
        let expected = match case.limit.as_deref() {
            Some("time") => Outcome::OverLimit(BuildLimit::Time),
            Some(_) => Outcome::OverLimit(BuildLimit::Memory),
            None => graded.outcome,
        };
        assert_ne!(graded.outcome, Outcome::Graded, "{}", case.name);
        assert_eq!(graded.outcome, expected, "{}", case.name);
        assert_eq!(report.scores.score, 0.0, "{}", case.name);
    }
    class.still_grades_the_reference();
}

#[test]
#[ignore = "builds submissions: a minute"]
fn no_attempt_gets_out() {
    let class = Class::open();
    let all = cases("attempts");
    for some in all.chunks(MOST_ATTEMPTS) {
        let code = attempts_code(some);
        let files = Case::with_code(&code).files();
        let graded = class.grade(&files, 1).expect("it is graded");
        let report = &graded.report;
        let printed = &report.printed;
        for case in some {
            let held = format!("{}: held", case.name);
            assert!(
                printed.contains(&held),
                "{}: {printed}{}",
                case.name,
                report.compiler
            );
        }
        assert_eq!(report.scores.score, report.scores.max_score, "{printed}");
    }
    class.still_grades_the_reference();
}

#[test]
#[ignore = "builds each submission: minutes"]
fn code_that_spoils_its_run_loses_only_its_own_points() {
    let class = Class::open();
    for case in cases("run") {
        let started = std::time::Instant::now();
        let graded = class.grade(&case.files(), 1).expect(&case.name);
        let report = &graded.report;
        assert_eq!(report.compiler, "", "{}", case.name);
        let scores = &report.scores;
        println!("{}: {} in {:?}", case.name, scores.score, started.elapsed());
        match case.score.as_deref() {
            Some("less") => assert!(scores.score < scores.max_score, "{}", case.name),
            Some("all") => assert_eq!(scores.score, scores.max_score, "{}", case.name),
            _ => {}
        }
        let json = grader::report::json(report).expect("a report is JSON");
        let says = case.says.as_deref().unwrap_or_default();
        assert!(json.contains(says), "{}: {json}", case.name);
    }
    class.still_grades_the_reference();
}
