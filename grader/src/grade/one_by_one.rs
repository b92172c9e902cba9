//! Grades tasks one after the other for an editor, which shows what is wrong in a task as soon as it
//! is known.
//!
//! Nothing is measured and no picture is rendered. A task is left at its first call that does not
//! return: the others of its cases would take as long again at each save.

use super::{add_examples, explain, grade_tasks, specs, workers};
use crate::build::BuildRoot;
use crate::course::{Course, Task};
use crate::report::TaskReport;
use crate::workers::runner::Patience;
use base::{GraderError, Workspace};

/// Grades `tasks` in this order with the code in `workspace`. `done` gets each task with its report,
/// which lacks the cases that were not run.
pub fn in_place(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    mut done: impl FnMut(&Task, TaskReport) -> Result<(), GraderError>,
) -> Result<(), GraderError> {
    let seed = 0;
    let specs = specs(seed)?;
    let build_root = BuildRoot {
        quiet: true,
        ..BuildRoot::of(workspace)
    };
    let workers = workers(&build_root, tasks, &specs, false)?;
    for task in tasks {
        let results = match workers.workers(&task.stage) {
            None => vec![super::does_not_compile(task)],
            Some(workers) => {
                let workers = workers.with(Patience::OneTimeout);
                grade_tasks(course, &[task], &specs, &workers, &mut Vec::new())?
            }
        };
        for mut report in explain(workspace, course, results, &specs, seed, &workers)? {
            add_examples(workspace, course, &mut report.result)?;
            if !is_whole(task, &report) {
                // Few cases look like those of many mistakes.
                report.diagnosis = None;
                report.regularities.clear();
            }
            done(task, report)?;
        }
    }
    Ok(())
}

/// Whether all cases of `task` were run.
pub fn is_whole(task: &Task, report: &TaskReport) -> bool {
    let cases = report.result.cases.iter();
    cases.filter(|case| !case.is_of_examples()).count() == task.cases.len()
}
