//! Whether the book says the points of the course.

use base::{GraderError, Workspace};
use grader::course::chapter::chapter;
use grader::course::{Course, Part, Task};
use judge::Tier;

/// How the row of a task in its chapter ends: with its core points and its extra credit.
pub(crate) fn row_end(task: &Task) -> String {
    format!(
        "| {} | {} |",
        task.points(Tier::Core),
        task.points(Tier::Robust)
    )
}

/// What the section "Checkpoint" of a chapter says.
pub(crate) fn checkpoint(task: &Task) -> String {
    format!("{} core points", task.points(Tier::Core))
}

/// How the row of a part in the chapter for instructors begins.
pub(crate) fn points_of_part(part: &Part) -> String {
    let core: f64 = part.tasks.iter().map(|task| task.points(Tier::Core)).sum();
    format!("| [{0}](part{0}/README.md) | {core} |", part.number)
}

/// The places of the book that say other points than the course.
pub fn problems(workspace: &Workspace, course: &Course) -> Result<Vec<String>, GraderError> {
    let read = |path: &str| {
        let full = workspace.root().join(path);
        std::fs::read_to_string(&full).map_err(|e| GraderError::file("read", &full, e))
    };
    let mut problems = Vec::new();
    for task in course.tasks() {
        let Some(path) = chapter(&task.key) else {
            continue;
        };
        if !workspace.root().join(&path).is_file() {
            problems.push(format!("{path}: the chapter of {} is missing", task.key));
            continue;
        }
        let text = read(&path)?;
        let row = row_end(task);
        let functions = format!("| `{}`", task.holes[0]);
        let has_row = text
            .lines()
            .any(|line| line.starts_with(&functions) && line.ends_with(&row));
        if !has_row {
            problems.push(format!(
                "{path}: expected a row of functions that ends with `{row}`, the points of {}",
                task.key
            ));
        }
        let checkpoint = checkpoint(task);
        let section = text
            .split_once("\n## Checkpoint")
            .unwrap_or_default()
            .1
            .split("\n## ")
            .next()
            .unwrap_or_default();
        if !section.contains(&checkpoint) {
            problems.push(format!(
                "{path}: expected \"{checkpoint}\" in the section Checkpoint"
            ));
        }
    }
    let hosting = "stages/book/src/hosting.md";
    let text = read(hosting)?;
    for part in &course.parts {
        let cell = points_of_part(part);
        if !text.contains(&cell) {
            problems.push(format!(
                "{hosting}: expected a row that begins with `{cell}`"
            ));
        }
    }
    Ok(problems)
}
