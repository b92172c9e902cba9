//! The table `gradebook.csv`: one line for each submission, in the form of [`table`].

pub mod table;

use crate::collect::{Class, Row};
use base::GraderError;
use table::Line;

/// Writes the table. `id` is the name of a submission's folder or archive.
pub fn write(class: &Class) -> Result<String, GraderError> {
    let tasks: Vec<&str> = class
        .plan
        .tasks
        .iter()
        .map(|task| task.key.as_str())
        .collect();
    let lines: Vec<Line> = class.rows.iter().map(|row| line(row, &tasks)).collect();
    table::write(&tasks, class.plan.max_score(), &lines)
}

/// The line of a submission.
pub(crate) fn line(row: &Row, tasks: &[&str]) -> Line {
    let score = row.score.as_ref();
    let earned = |task: &&str| {
        let of_task = score.and_then(|score| score.tasks.get(*task));
        of_task.copied().unwrap_or_default()
    };
    Line {
        id: row.name.line(),
        name: String::new(),
        status: row.status.label().to_string(),
        score: score.map(|score| [score.core, score.extra]),
        tasks: tasks.iter().map(earned).collect(),
        note: row.about(),
    }
}
