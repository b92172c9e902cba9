//! Checks the course before it is handed out: `grader course check`.
//!
//! - [`grader::course::consistency`]: `course.toml`, the cases and the goldens agree.
//! - [`book`]: the book says the points of the course.
//! - [`solution_copies`]: no handout contains a copy of a solution that was removed from it.
//! - [`build`]: every handout builds without warnings, is formatted and passes its tests. Its own
//!   grader reports *not attempted* for every task without a solution and full points for the
//!   others.
//! - The reference earns all points.

pub mod book;
pub mod build;
pub mod solution_copies;

use base::{GraderError, Workspace};
use build::Tests;
use grader::course::consistency;
use grader::course::moved_points::MovedPoints;
use grader::course::{Course, Part};
use grader::grade::{self, GradeRequest};
use grader::report::Report;
use grader::score::TaskResult;
use handout::Handout;
use judge::cases;
use std::collections::BTreeSet;

/// Checks the course and returns a message for each problem. Without `builds`, only runs the checks
/// that build nothing. Calls `progress` with a message before each step.
pub fn course(
    workspace: &Workspace,
    builds: bool,
    mut progress: impl FnMut(&str),
) -> Result<Vec<String>, GraderError> {
    let course = Course::read(workspace)?;
    let mut problems = Vec::new();
    progress("comparing course.toml, cases and goldens");
    let found = consistency::problems(workspace, &course, &cases::all(0));
    report(&mut problems, found, &mut progress);
    report(
        &mut problems,
        book::problems(workspace, &course)?,
        &mut progress,
    );
    progress(&MovedPoints::of(&course).summary());
    let mut handouts = Vec::new();
    for part in &course.parts {
        progress(&format!("handout of part {}: creating it", part.number));
        let handout = Handout::carve(workspace, part.number)?;
        let found = check_text(workspace, part, &handout)?;
        report(&mut problems, found, &mut progress);
        handouts.push((part, handout));
    }
    if !builds {
        return Ok(problems);
    }
    progress("grading the reference");
    let everything = GradeRequest {
        what: "all".into(),
        seed: 0,
    };
    let graded = grade::in_place(workspace, &everything, false, false)?;
    let found = check_reference_score(&course, &graded.report);
    report(&mut problems, found, &mut progress);
    let tests = std::iter::once(Tests::All).chain(std::iter::repeat(Tests::Stages));
    for ((part, handout), tests) in handouts.iter().zip(tests) {
        let number = part.number;
        let found = build::find(workspace, &course, number, handout, tests, &mut progress)?;
        report(&mut problems, found, &mut progress);
    }
    Ok(problems)
}

/// Adds `found` to the problems and prints it at once, because the other checks take minutes.
fn report(problems: &mut Vec<String>, found: Vec<String>, progress: &mut impl FnMut(&str)) {
    for problem in found {
        progress(&format!("PROBLEM: {problem}"));
        problems.push(problem);
    }
}

/// Checks the text of a handout's files: no markers, no solutions.
fn check_text(
    workspace: &Workspace,
    part: &Part,
    handout: &Handout,
) -> Result<Vec<String>, GraderError> {
    let here = format!("handout of part {}", part.number);
    let mut problems = Vec::new();
    let again = Handout::carve(workspace, part.number)?;
    if again.files != handout.files {
        problems.push(format!(
            "{here}: creating it twice gives two different handouts"
        ));
    }
    for (path, contents) in handout
        .files
        .iter()
        .filter(|(path, _)| path.starts_with("stages"))
    {
        let text = String::from_utf8_lossy(contents);
        if let Some(marker) = ["BEGIN SOLUTION", "END SOLUTION", "// STUB:"]
            .iter()
            .find(|marker| text.contains(**marker))
        {
            problems.push(format!(
                "{here}: {} still contains `{marker}`",
                path.display()
            ));
        }
    }
    let solutions: BTreeSet<_> = handout
        .removed
        .iter()
        .map(|removed| &removed.path)
        .collect();
    for path in solutions {
        let reference = files::file_tree::read(workspace.root(), path)?;
        if handout.files.get(path) == Some(&reference) {
            problems.push(format!(
                "{here}: {} is still the reference's file",
                path.display()
            ));
        }
    }
    problems.extend(
        solution_copies::find(handout)
            .into_iter()
            .map(|copy| format!("{here}: {copy}")),
    );
    Ok(problems)
}

/// Checks that the reference earns all points.
fn check_reference_score(course: &Course, report: &Report) -> Vec<String> {
    // Nobody writes examples of what is given.
    let of_examples = |key: &str| {
        let task = course.tasks().find(|task| task.key == key);
        task.map_or(0.0, |task| task.examples)
    };
    let lacks = |task: &TaskResult| {
        let extra = task.robust_score + of_examples(&task.key);
        task.score < task.max_score || extra < task.robust_max_score
    };
    let mut problems: Vec<String> = report
        .tasks
        .iter()
        .map(|task| &task.result)
        .filter(|task| lacks(task))
        .map(|task| {
            format!(
                "the reference earns {} of {} core points and {} of {} robust points in {}",
                task.score, task.max_score, task.robust_score, task.robust_max_score, task.key
            )
        })
        .collect();
    let [core, robust] = consistency::total_points(course);
    if report.max_score != core || report.robust_max_score != robust {
        problems.push(format!(
            "course.toml lists {core} core and {robust} robust points, but the report has {} and {}",
            report.max_score, report.robust_max_score
        ));
    }
    problems
}
