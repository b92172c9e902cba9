//! Does the course keep its word? `grader course check` asks this before anything is handed out.
//!
//! [`grader::consistency`]: `course.toml`, cases and goldens agree. [`leak`]: no handout says what its solutions said. [`build`]: every
//! handout builds without a warning, is formatted, passes its tests, and its own grader finds every
//! carved task not attempted and every kept one full. The reference scores full.

pub mod build;
pub mod leak;

use crate::handout::Handout;
use build::Tests;
use grader::consistency;
use grader::course::{Course, Part};
use grader::error::GraderError;
use grader::grade::{self, GradeRequest};
use grader::score::Report;
use grader::workspace::Workspace;
use judge::cases;
use std::collections::BTreeSet;

/// Everything that is wrong with the course, sentence by sentence. Without `builds`, only what can be seen without
/// building anything. `progress` is told what is being done.
pub fn course(
    workspace: &Workspace,
    builds: bool,
    mut progress: impl FnMut(&str),
) -> Result<Vec<String>, GraderError> {
    let course = Course::read(workspace)?;
    let mut complaints = Vec::new();
    progress("lists: course.toml, cases, goldens");
    let found = consistency::problems(workspace, &course, &cases::all(0));
    note(&mut complaints, found, &mut progress);
    let mut handouts = Vec::new();
    for part in &course.parts {
        progress(&format!("handout of part {}: carving", part.number));
        let handout = Handout::carve(workspace, part.number)?;
        let found = of_texts(workspace, part, &handout)?;
        note(&mut complaints, found, &mut progress);
        handouts.push((part, handout));
    }
    if !builds {
        return Ok(complaints);
    }
    progress("the reference: grading");
    let everything = GradeRequest {
        what: "all".into(),
        seed: 0,
    };
    let graded = grade::in_place(workspace, &everything, false)?;
    let found = of_reference(&course, &graded.report);
    note(&mut complaints, found, &mut progress);
    let tests = std::iter::once(Tests::All).chain(std::iter::repeat(Tests::Stages));
    for ((part, handout), tests) in handouts.iter().zip(tests) {
        let number = part.number;
        let found = build::find(workspace, &course, number, handout, tests, &mut progress)?;
        note(&mut complaints, found, &mut progress);
    }
    Ok(complaints)
}

/// Adds what was found to the complaints, and tells it at once: the rest takes minutes.
fn note(complaints: &mut Vec<String>, found: Vec<String>, progress: &mut impl FnMut(&str)) {
    for complaint in found {
        progress(&format!("COMPLAINT: {complaint}"));
        complaints.push(complaint);
    }
}

/// What is wrong with a handout's texts.
fn of_texts(
    workspace: &Workspace,
    part: &Part,
    handout: &Handout,
) -> Result<Vec<String>, GraderError> {
    let here = format!("handout of part {}", part.number);
    let mut complaints = Vec::new();
    let again = Handout::carve(workspace, part.number)?;
    if again.files != handout.files {
        complaints.push(format!(
            "{here}: carving it twice gives two different handouts"
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
            complaints.push(format!("{here}: {} still has `{marker}`", path.display()));
        }
    }
    let solutions: BTreeSet<_> = handout.taken.iter().map(|taken| &taken.path).collect();
    for path in solutions {
        let reference = submission::file_tree::read(workspace.root(), path)?;
        if handout.files.get(path) == Some(&reference) {
            complaints.push(format!("{here}: {} is the reference's", path.display()));
        }
    }
    complaints.extend(
        leak::find(handout)
            .into_iter()
            .map(|leak| format!("{here}: {leak}")),
    );
    Ok(complaints)
}

/// What the reference lacks of full marks.
fn of_reference(course: &Course, report: &Report) -> Vec<String> {
    let mut complaints: Vec<String> = report
        .tasks
        .iter()
        .filter(|task| task.score < task.max_score || task.robust_score < task.robust_max_score)
        .map(|task| {
            format!(
                "the reference scores {} of {} and {} of {} robust points in {}",
                task.score, task.max_score, task.robust_score, task.robust_max_score, task.key
            )
        })
        .collect();
    let [core, robust] = consistency::total_points(course);
    if report.max_score != core || report.robust_max_score != robust {
        complaints.push(format!(
            "course.toml gives {core} core and {robust} robust points, the report {} and {}",
            report.max_score, report.robust_max_score
        ));
    }
    complaints
}
