//! Grades a class, which is a folder of submissions: a report for each, and one table of all
//! scores.

use super::SubmissionReport;
use super::clean_workspace::CleanWorkspace;
use super::containment::Containment;
use super::read::Submission;
use grader::course::Course;
use grader::error::GraderError;
use grader::grade::GradeRequest;
use grader::report;
use grader::workspace::Workspace;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The number of graded submissions, and those that could not be graded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassSummary {
    /// The number of graded submissions.
    pub graded: usize,
    /// The names of the others, each with the reason.
    pub not_graded: Vec<String>,
}

/// Grades every folder in `class`. Writes `NAME.txt` and `NAME.json` for each, and `summary.csv`,
/// to `out`. `format` formats the text.
pub fn grade(
    workspace: &Workspace,
    class: &Path,
    out: &Path,
    request: &GradeRequest,
    together: bool,
    containment: Containment,
    format: impl Fn(&SubmissionReport) -> String,
) -> Result<ClassSummary, GraderError> {
    let course = Course::read(workspace)?;
    let tasks = course.select(&request.what)?;
    let folders = submissions(class)?;
    std::fs::create_dir_all(out).map_err(|e| GraderError::file("create", out, e))?;
    let clean = CleanWorkspace::open(workspace, containment)?;
    let mut table = String::from("submission,score,max_score,extra,max_extra,together");
    for task in &tasks {
        let _ = write!(table, ",{}", task.key);
    }
    table.push_str(",note\n");
    let mut summary = ClassSummary {
        graded: 0,
        not_graded: Vec::new(),
    };
    for (i, folder) in folders.iter().enumerate() {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        eprintln!("{} of {}: {name}", i + 1, folders.len());
        let result = Submission::read(folder, &course, workspace.root()).and_then(|submission| {
            SubmissionReport::of(&submission, workspace, &clean, request, together)
        });
        let _ = write!(table, "{}", field(&name));
        let text = match result {
            Ok(report) => {
                let json = report::json(&report)?;
                report::write_whole(&out.join(format!("{name}.json")), json.as_bytes())?;
                table.push_str(&row(&report));
                summary.graded += 1;
                format(&report)
            }
            Err(why) => {
                let why = why.to_string();
                let _ = write!(table, ",,,,,{}", ",".repeat(tasks.len()));
                let _ = writeln!(table, ",{}", field(&why));
                summary.not_graded.push(format!("{name}: {why}"));
                format!("not graded: {why}\n")
            }
        };
        report::write_whole(&out.join(format!("{name}.txt")), text.as_bytes())?;
    }
    report::write_whole(&out.join("summary.csv"), table.as_bytes())?;
    Ok(summary)
}

/// The entries of `class`, sorted by name. Files are included: grading one fails with a message.
fn submissions(class: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let failed = |e: std::io::Error| GraderError::file("read", class, e);
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(class).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        if !entry.file_name().to_string_lossy().starts_with('.') {
            folders.push(entry.path());
        }
    }
    folders.sort();
    if !folders.iter().any(|path| path.is_dir()) {
        return Err(GraderError::new(format!(
            "{} contains no folder. Expected a folder that contains one folder per submission",
            class.display()
        )));
    }
    Ok(folders)
}

/// A row of the table without its first field, the name.
fn row(report: &SubmissionReport) -> String {
    let scores = &report.scores;
    let together = report
        .together
        .as_ref()
        .map(|report| report.score.to_string());
    let mut row = format!(
        ",{},{},{},{},{}",
        scores.score,
        scores.max_score,
        scores.robust_score,
        scores.robust_max_score,
        together.unwrap_or_default()
    );
    for task in &scores.tasks {
        let _ = write!(row, ",{}", task.result.score);
    }
    let mut notes = Vec::new();
    if !report.compiler.is_empty() {
        notes.push("does not compile".to_string());
    }
    if !report.missing.is_empty() {
        notes.push(format!("not handed in: {}", report.missing.join(" ")));
    }
    if !report.ignored.is_empty() {
        notes.push(format!("{} files ignored", report.ignored.len()));
    }
    if !report.reaches_out.is_empty() {
        notes.push(format!("please check {}", report.reaches_out.join(" ")));
    }
    let _ = writeln!(row, ",{}", field(&notes.join("; ")));
    row
}

/// Formats a field of a CSV file (RFC 4180). Text that a spreadsheet would read as a formula gets
/// an apostrophe in front.
fn field(text: &str) -> String {
    let text = if text.starts_with(['=', '+', '-', '@']) {
        format!("'{text}")
    } else {
        text.to_string()
    };
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_with_commas_and_formulas_are_quoted() {
        assert_eq!(field("anna"), "anna");
        assert_eq!(field("a, \"b\""), "\"a, \"\"b\"\"\"");
        assert_eq!(field("=1+1"), "'=1+1");
    }
}
