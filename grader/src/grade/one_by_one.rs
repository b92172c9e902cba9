//! Grades tasks one after the other for an editor, which shows what is wrong in a task as soon as
//! it is known.
//!
//! Nothing is measured and no picture is rendered. A task is left at its first call that does not
//! return: the others of its cases would take as long again at each save.

use super::{add_examples, explain, grade_tasks, specs, workers};
use crate::build::BuildRoot;
use crate::course::{Course, Task};
use crate::diagnosis::simplest::{self, Choice, SimplestCall};
use crate::report::TaskReport;
use crate::score::TaskResult;
use crate::workers::runner::Patience;
use crate::workers::stage_workers::StageWorkers;
use base::{GraderError, Workspace};
use judge::cases::Spec;

/// A task that was graded.
#[derive(Clone, Debug)]
pub struct Graded<'a> {
    /// Its report, which lacks the cases that were not run.
    pub report: TaskReport,
    workers: Option<&'a StageWorkers>,
    specs: &'a [Spec],
}

#[cfg(test)]
impl<'a> Graded<'a> {
    /// A report without workers that could be asked more.
    pub(crate) fn for_tests(report: TaskReport) -> Graded<'a> {
        Graded {
            report,
            workers: None,
            specs: &[],
        }
    }
}

impl Graded<'_> {
    /// The simplest call for the wrong answers of `result`, a part of those of the task, that
    /// `choice` leaves.
    pub fn simplest(
        &self,
        result: &TaskResult,
        choice: &Choice<'_>,
    ) -> Result<Option<SimplestCall>, GraderError> {
        match self.workers {
            Some(workers) => simplest::of_wrong(workers, result, self.specs, choice),
            None => Ok(None),
        }
    }
}

/// Grades `tasks` in this order with the code in `workspace`, and passes each to `done`.
pub fn in_place(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    mut done: impl FnMut(&Task, Graded<'_>) -> Result<(), GraderError>,
) -> Result<(), GraderError> {
    let seed = 0;
    let specs = specs(tasks, seed)?;
    let build_root = BuildRoot {
        quiet: true,
        ..BuildRoot::of(workspace)
    };
    let workers = workers(&build_root, tasks, &specs, false)?;
    for task in tasks {
        let of_stage = workers
            .workers(&task.stage)
            .map(|workers| workers.with(Patience::OneTimeout));
        let results = match &of_stage {
            None => vec![super::does_not_compile(task)],
            Some(workers) => grade_tasks(course, &[task], &specs, workers, &mut Vec::new())?,
        };
        for mut report in explain(workspace, course, results, &specs, seed, &workers)? {
            add_examples(workspace, course, &mut report.result)?;
            if !is_whole(task, &report) {
                // Few cases look like those of many mistakes.
                report.diagnosis = None;
                report.regularities.clear();
            }
            let graded = Graded {
                report,
                workers: of_stage.as_ref(),
                specs: &specs,
            };
            done(task, graded)?;
        }
    }
    Ok(())
}

/// Whether all cases of `task` were run.
pub fn is_whole(task: &Task, report: &TaskReport) -> bool {
    let cases = report.result.cases.iter();
    cases.filter(|case| !case.is_of_examples()).count() == task.cases.len()
}
