//! Which goldens the command line selects.

use base::GraderError;
use grader::course::{Course, Task};
use judge::pictures;

/// The selected goldens of a task.
#[derive(Clone, Debug)]
pub struct Selected<'a> {
    /// The task.
    pub task: &'a Task,
    /// The names of the cases; `None` for all of them.
    pub cases: Option<Vec<String>>,
    /// Whether the picture of the task is selected, too.
    pub picture: bool,
}

impl Selected<'_> {
    /// Whether the case is selected.
    pub fn has_case(&self, name: &str) -> bool {
        let cases = self.cases.as_ref();
        cases.is_none_or(|cases| cases.iter().any(|case| case == name))
    }
}

/// The goldens that `keys` select, in the order of the course. A key is `all`, a part, a task, or
/// `TASK/CASE`, where the case `task` is the picture of the task.
pub fn select<'a>(course: &'a Course, keys: &[&str]) -> Result<Vec<Selected<'a>>, GraderError> {
    let mut selected: Vec<Selected<'a>> = Vec::new();
    for key in keys {
        let (key, case) = match key.split_once('/') {
            Some((task, case)) => (task, Some(case)),
            None => (*key, None),
        };
        for task in course.select(key)? {
            if let Some(case) = case {
                check_case(task, case)?;
            }
            let found = selected.iter().position(|s| s.task.key == task.key);
            let at = found.unwrap_or_else(|| {
                selected.push(Selected {
                    task,
                    cases: Some(Vec::new()),
                    picture: false,
                });
                selected.len() - 1
            });
            let selected = &mut selected[at];
            match (case, &mut selected.cases) {
                (None, cases) => (*cases, selected.picture) = (None, true),
                (Some(pictures::NAME), _) => selected.picture = true,
                (Some(case), Some(cases)) => cases.push(case.to_string()),
                (Some(_), None) => {}
            }
        }
    }
    let place = |selected: &Selected<'_>| {
        let mut tasks = course.tasks();
        tasks.position(|task| task.key == selected.task.key)
    };
    selected.sort_by_key(place);
    Ok(selected)
}

fn check_case(task: &Task, case: &str) -> Result<(), GraderError> {
    let mut names: Vec<&str> = task.cases.iter().map(|case| case.name.as_str()).collect();
    names.push(pictures::NAME);
    if names.contains(&case) {
        return Ok(());
    }
    Err(GraderError::new(format!(
        "{} has no case `{case}`. Its goldens are {}",
        task.key,
        names.join(", ")
    )))
}
