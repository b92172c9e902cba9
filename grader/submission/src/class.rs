//! A class: a folder of submissions, a report for each, and a table of them all.

use super::Judgement;
use super::job::Job;
use super::read::Submission;
use grader::course::Course;
use grader::error::GraderError;
use grader::grade::GradeRequest;
use grader::report;
use grader::workspace::Workspace;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// How many submissions were graded, and which could not be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Summary {
    /// How many were graded.
    pub graded: usize,
    /// The others, and why.
    pub refused: Vec<String>,
}

/// Grades every folder in `class`; writes `NAME.txt` and `NAME.json` of each, and `summary.csv`, into `out`.
/// `show` makes the text.
pub fn grade(
    workspace: &Workspace,
    class: &Path,
    out: &Path,
    request: &GradeRequest,
    together: bool,
    show: impl Fn(&Judgement) -> String,
) -> Result<Summary, GraderError> {
    let course = Course::read(workspace)?;
    let tasks = course.select(&request.what)?;
    let folders = submissions(class)?;
    std::fs::create_dir_all(out).map_err(|e| GraderError::file("make", out, e))?;
    let job = Job::open(workspace)?;
    let mut table = String::from("submission,score,max_score,extra,max_extra,together");
    for task in &tasks {
        let _ = write!(table, ",{}", task.key);
    }
    table.push_str(",note\n");
    let mut summary = Summary {
        graded: 0,
        refused: Vec::new(),
    };
    for (i, folder) in folders.iter().enumerate() {
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        eprintln!("{} of {}: {name}", i + 1, folders.len());
        let judged = Submission::read(folder, &course, workspace.root())
            .and_then(|submission| Judgement::of(&submission, workspace, &job, request, together));
        let _ = write!(table, "{}", field(&name));
        let text = match judged {
            Ok(judgement) => {
                let json = report::json(&judgement)?;
                report::write_whole(&out.join(format!("{name}.json")), json.as_bytes())?;
                table.push_str(&row(&judgement));
                summary.graded += 1;
                show(&judgement)
            }
            Err(why) => {
                let why = why.to_string();
                let _ = write!(table, ",,,,,{}", ",".repeat(tasks.len()));
                let _ = writeln!(table, ",{}", field(&why));
                summary.refused.push(format!("{name}: {why}"));
                format!("not graded: {why}\n")
            }
        };
        report::write_whole(&out.join(format!("{name}.txt")), text.as_bytes())?;
    }
    report::write_whole(&out.join("summary.csv"), table.as_bytes())?;
    Ok(summary)
}

/// What lies in `class`, by name; a file among the folders will be refused by name, not passed over.
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
            "{} holds no folder. A class is a folder with a folder for each submission",
            class.display()
        )));
    }
    Ok(folders)
}

/// The rest of a line of the table, after the name.
fn row(judgement: &Judgement) -> String {
    let report = &judgement.report;
    let together = judgement
        .together
        .as_ref()
        .map(|report| report.score.to_string());
    let mut row = format!(
        ",{},{},{},{},{}",
        report.score,
        report.max_score,
        report.robust_score,
        report.robust_max_score,
        together.unwrap_or_default()
    );
    for task in &report.tasks {
        let _ = write!(row, ",{}", task.score);
    }
    let mut notes = Vec::new();
    if !judgement.compiler.is_empty() {
        notes.push("does not compile".to_string());
    }
    if !judgement.missing.is_empty() {
        notes.push(format!("not handed in: {}", judgement.missing.join(" ")));
    }
    if !judgement.ignored.is_empty() {
        notes.push(format!("{} files ignored", judgement.ignored.len()));
    }
    if !judgement.reaches_out.is_empty() {
        notes.push(format!("look at {}", judgement.reaches_out.join(" ")));
    }
    let _ = writeln!(row, ",{}", field(&notes.join("; ")));
    row
}

/// A field of a CSV file (RFC 4180). One that a spreadsheet would take for a formula is made text.
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
    fn a_field_keeps_its_commas_and_runs_no_formula() {
        assert_eq!(field("anna"), "anna");
        assert_eq!(field("a, \"b\""), "\"a, \"\"b\"\"\"");
        assert_eq!(field("=1+1"), "'=1+1");
    }
}
