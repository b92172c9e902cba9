//! Grades a submission for a report in the format of a course system.

use crate::folder;
use base::{GraderError, Workspace};
use clap::ArgMatches;
use formats::{Graded, Outcome, annotation, command};
use grader::cli::grade::hint;
use grader::course::Task;
use grader::course::sources::{SourceFile, with_slashes};
use grader::grade;
use grader::report::{self, Reveal};
use judge::Tier;
use std::fmt::Write;
use std::path::Path;
use submission::SubmissionReport;
use submission::arguments::{containment, draws_seed, seeded_request};
use submission::one::{GradingCourse, NotGraded, Options, grade_one};
use submission::read::Submission;

/// How many ignored files are named.
const IGNORED_NAMED: usize = 20;

/// Grades what `matches` name.
pub(crate) fn grade(matches: &ArgMatches) -> Result<Outcome, GraderError> {
    let reveal = Reveal {
        hint: hint(matches),
        extra: matches.get_flag("extra"),
    };
    let workspace = Workspace::above(Path::new("."))?;
    let folder = folder(matches)?;
    let options = Options {
        pictures: false,
        request: seeded_request(matches)?,
        together: matches.get_flag("together"),
    };
    let seed = options.request.seed;
    let course = GradingCourse::open(&workspace, containment(matches, &workspace)?)?;
    let graded = submission(&workspace, &course, options, reveal, folder)?;
    Ok(with_seed(graded, draws_seed(matches).then_some(seed)))
}

fn submission(
    workspace: &Workspace,
    course: &GradingCourse,
    options: Options,
    reveal: Reveal,
    folder: &Path,
) -> Result<Outcome, GraderError> {
    let tasks = course.course().select(&options.request.what)?;
    let report = match grade_one(course, folder, &options) {
        Ok(graded) => graded.report,
        Err(NotGraded::Refused(why)) => {
            let max_score = tasks.iter().map(|task| task.points(Tier::Core)).sum();
            return Ok(Outcome::Refused { why, max_score });
        }
        Err(NotGraded::Infrastructure(why)) => return Ok(Outcome::Infrastructure(why)),
    };
    let json = report::json(&report)?;
    base::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
    let handed_in = Submission::read(folder, course.course(), workspace.root())?;
    let files = files(&handed_in, &tasks);
    Ok(Outcome::Graded(Box::new(Graded {
        annotations: annotation::all(&report.scores, &report.compiler, &files, reveal),
        notes: notes(&report),
        what: options.request.what,
        report: report.scores,
        json,
        reveal,
    })))
}

/// Adds the seed to what students read, if it was drawn for this run alone. The seed of `--seed` is
/// also that of the next submission: who knows it knows every question.
fn with_seed(mut outcome: Outcome, drawn: Option<u64>) -> Outcome {
    if let (Outcome::Graded(graded), Some(seed)) = (&mut outcome, drawn) {
        graded.notes = format!("seed of the random inputs: {seed}\n{}", graded.notes);
    }
    outcome
}

/// The files of a submission that were graded, by their paths in the workspace.
fn files(submission: &Submission, tasks: &[&Task]) -> Vec<SourceFile> {
    let stages = grade::stages(tasks);
    let graded = stages
        .iter()
        .filter_map(|stage| Some((stage, submission.stages.get(*stage)?)));
    let files = graded.flat_map(|(stage, files)| {
        files.iter().map(move |(path, text)| SourceFile {
            path: format!("stages/{stage}/src/{}", with_slashes(path)),
            text: String::from_utf8_lossy(text).into_owned(),
        })
    });
    files.collect()
}

/// What is said about a submission besides its tasks. What a person should check is for the
/// instructor, and not in it: students read these files.
fn notes(report: &SubmissionReport) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "containment: {}", report.containment);
    for stage in &report.missing {
        let _ = writeln!(text, "not handed in: stages/{stage}/src");
    }
    if let Some(sentence) = report.about_changed_given() {
        let _ = writeln!(text, "{sentence}");
    }
    let ignored = report.other_ignored();
    if !ignored.is_empty() {
        let named = ignored.get(..IGNORED_NAMED).unwrap_or(&ignored);
        let more = ignored.len() - named.len();
        let more = match more {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let _ = writeln!(
            text,
            "ignored files (only stages/<stage>/src/**/*.rs is graded): {}{more}",
            named.join(", ")
        );
    }
    command::notes([&*text, &report.compiler, &report.printed])
}

#[cfg(test)]
mod tests {
    use super::*;
    use grader::report::{HintLevel, Report};

    #[test]
    fn students_read_the_seed_of_one_run_and_not_that_of_all() {
        let notes = |drawn| {
            let graded = Outcome::Graded(Box::new(Graded {
                what: "part1".into(),
                report: Report::new(Vec::new(), None),
                json: String::new(),
                reveal: Reveal {
                    hint: HintLevel::Cases,
                    extra: false,
                },
                notes: "containment: none\n".into(),
                annotations: Vec::new(),
            }));
            match with_seed(graded, drawn) {
                Outcome::Graded(graded) => graded.notes,
                _ => String::new(),
            }
        };
        assert_eq!(notes(None), "containment: none\n");
        let drawn = "seed of the random inputs: 7\ncontainment: none\n";
        assert_eq!(notes(Some(7)), drawn);
    }
}
