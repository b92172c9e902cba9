//! The book with the points and the front page of a term. Which lines of it say points is what
//! [`crate::check::book`] checks.

use super::text;
use crate::check::book::{checkpoint, points_of_part, row_end};
use base::GraderError;
use files::file_tree::Files;
use grader::course::chapter::chapter;
use grader::course::consistency::total_points;
use grader::course::{Course, Part, Task};
use std::path::{Path, PathBuf};

/// The chapter that opens the book.
const FRONT: &str = "stages/book/src/introduction.md";

/// The chapter with the table of parts for instructors.
const HOSTING: &str = "stages/book/src/hosting.md";

/// The chapters that change.
pub(super) fn with_changes(
    files: &Files,
    before: &Course,
    after: &Course,
    front: &str,
) -> Result<Vec<(PathBuf, String)>, GraderError> {
    let mut changed = Vec::new();
    for task in before.tasks() {
        let Some(path) = chapter(&task.key).map(PathBuf::from) else {
            continue;
        };
        let old = text(files, &path)?;
        let new = match after.tasks().find(|other| other.key == task.key) {
            Some(now) => with_points(&old, task, now),
            None => after_heading(
                &old,
                "*This course leaves the task out: its code is given, and nothing of it is graded.*",
            ),
        };
        changed.push((path, new));
    }
    for part in &before.parts {
        let Some(words) = left_out(part, after) else {
            continue;
        };
        let path = PathBuf::from(format!("stages/book/src/part{}/README.md", part.number));
        let chapter = after_heading(&text(files, &path)?, &words);
        changed.push((path, chapter));
    }
    let mut hosting = text(files, Path::new(HOSTING))?;
    for part in &before.parts {
        let now = after.parts.iter().find(|other| other.number == part.number);
        let old = points_of_part(part);
        let new = now.map_or_else(
            || format!("| [{0}](part{0}/README.md) | left out |", part.number),
            points_of_part,
        );
        hosting = hosting.replace(&old, &new);
    }
    changed.push((HOSTING.into(), hosting));
    let old = text(files, Path::new(FRONT))?;
    changed.push((FRONT.into(), with_front(&old, after, front)));
    Ok(changed)
}

/// A chapter with other points of its task.
fn with_points(chapter: &str, before: &Task, now: &Task) -> String {
    let (old_row, new_row) = (row_end(before), row_end(now));
    let functions = format!("| `{}`", before.holes[0]);
    let lines = chapter.split('\n').map(|line| {
        let row = line.strip_suffix(old_row.as_str());
        match row.filter(|_| line.starts_with(&functions)) {
            Some(row) => format!("{row}{new_row}"),
            None => line.to_string(),
        }
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    match text.split_once("\n## Checkpoint") {
        Some((start, rest)) => {
            let rest = rest.replacen(&checkpoint(before), &checkpoint(now), 1);
            format!("{start}\n## Checkpoint{rest}")
        }
        None => text,
    }
}

/// What the chapter of a part says of its tasks that are left out, if some are.
fn left_out(part: &Part, after: &Course) -> Option<String> {
    let is_left_out = |task: &&Task| after.tasks().all(|other| other.key != task.key);
    let titles: Vec<&str> = part
        .tasks
        .iter()
        .filter(is_left_out)
        .map(|task| task.title.as_str())
        .collect();
    (!titles.is_empty()).then(|| {
        format!(
            "*This course leaves out, and gives the code of: {}.*",
            titles.join("; ")
        )
    })
}

/// The first chapter with the name of the course, the teacher's words and the dates.
fn with_front(chapter: &str, course: &Course, front: &str) -> String {
    let tasks = course.tasks().count();
    let number = match tasks {
        1 => "There is one task".to_string(),
        15 => "There are fifteen tasks".to_string(),
        tasks => format!("There are {tasks} tasks"),
    };
    // `stages/book/tests/course.rs` holds these words.
    let chapter = chapter.replace("There are fifteen tasks", &number);
    let Some(term) = &course.term else {
        return chapter;
    };
    let [core, _] = total_points(course);
    let words = [
        format!("**{}**", term.title()),
        front.trim().to_string(),
        term.table().trim_end().to_string(),
        format!("There are {core} core points in all."),
    ];
    let words: Vec<String> = words
        .into_iter()
        .filter(|words| !words.is_empty())
        .collect();
    after_heading(&chapter, &words.join("\n\n"))
}

/// A chapter with `words` as the first paragraphs after its heading.
fn after_heading(chapter: &str, words: &str) -> String {
    match chapter.split_once("\n\n") {
        Some((heading, rest)) => format!("{heading}\n\n{words}\n\n{rest}"),
        None => format!("{chapter}\n{words}\n"),
    }
}
