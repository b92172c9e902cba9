//! The last report of this workspace, as far as another command needs it.

use crate::course::{Course, Task};
use crate::error::GraderError;
use crate::workspace::Workspace;
use serde::Deserialize;

/// The part of `report.json` that says which task is next.
#[derive(Deserialize)]
struct LastReport {
    tasks: Vec<Scored>,
}

#[derive(Deserialize)]
struct Scored {
    key: String,
    score: f64,
    max_score: f64,
}

/// The first task of the last report that lost core points; if there is none, the last task of the
/// report; without a report, the first task of the course.
pub fn next_task<'a>(workspace: &Workspace, course: &'a Course) -> Result<&'a Task, GraderError> {
    let text = std::fs::read_to_string(workspace.root().join("report.json")).unwrap_or_default();
    let task = next_of(&text).and_then(|key| course.tasks().find(|task| task.key == key));
    let first = || course.tasks().next();
    task.or_else(first)
        .ok_or_else(|| GraderError::new("the course has no tasks"))
}

/// The key in the text of a report. A text of another form has none.
fn next_of(text: &str) -> Option<String> {
    let mut tasks = serde_json::from_str::<LastReport>(text).ok()?.tasks;
    let lost = tasks.iter().position(|task| task.score < task.max_score);
    let next = lost.or(tasks.len().checked_sub(1))?;
    Some(tasks.swap_remove(next).key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_task_is_the_first_with_lost_points_or_the_last() {
        let task = |key: &str, score: f64| {
            format!(r#"{{"key": "{key}", "score": {score}, "max_score": 3, "cases": []}}"#)
        };
        let report = |scores: [f64; 3]| {
            let tasks: Vec<String> = ["a", "b", "c"]
                .iter()
                .zip(scores)
                .map(|(key, score)| task(key, score))
                .collect();
            next_of(&format!(r#"{{"tasks": [{}]}}"#, tasks.join(",")))
        };
        assert_eq!(report([3.0, 1.0, 0.0]).as_deref(), Some("b"));
        assert_eq!(report([3.0, 3.0, 3.0]).as_deref(), Some("c"));
        assert_eq!(next_of(r#"{"tasks": []}"#), None);
        assert_eq!(next_of("no report"), None);
    }
}
