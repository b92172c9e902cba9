//! The workers that run a stage's cases: most cases run in a worker that links only the stage, so
//! that other stages cannot break them; rays through whole scenes run in one that links all
//! intersection stages.

use crate::workers::printed::Printed;
use crate::workers::runner::{self, Ending, Patience, Worker};
use base::GraderError;
use judge::cases::Spec;
use std::collections::BTreeMap;
use wire::Outcome;

/// The workers of a stage.
#[derive(Clone, Debug)]
pub struct StageWorkers {
    /// Links the stage.
    pub stage: Worker,
    /// Links all intersection stages; the names of those that do not compile, if there are any.
    pub whole_scene: Result<Worker, String>,
}

impl StageWorkers {
    /// The same workers with another patience.
    pub fn with(&self, patience: Patience) -> StageWorkers {
        let impatient = |worker: &Worker| Worker {
            patience,
            ..worker.clone()
        };
        StageWorkers {
            stage: impatient(&self.stage),
            whole_scene: self
                .whole_scene
                .as_ref()
                .map(impatient)
                .map_err(String::clone),
        }
    }

    /// Runs each case in its worker, which gets the case's question moved, and moves the answers
    /// back to the question that is judged. Returns its ending, or the names of the stages without
    /// which it cannot run. Appends the output of the code to `printed`.
    pub fn run(
        &self,
        specs: &[&Spec],
        printed: &mut Vec<Printed>,
    ) -> Result<Vec<Result<Ending, String>>, GraderError> {
        let mut run = |worker: &Worker, all_stages: bool| -> Result<_, GraderError> {
            let chosen = specs
                .iter()
                .filter(|spec| spec.needs_all_stages() == all_stages);
            let cases: Vec<wire::Case> = chosen.map(|spec| spec.case()).collect();
            let run = runner::run(worker, &cases)?;
            printed.extend(run.printed);
            Ok(run.endings)
        };
        let alone = run(&self.stage, false)?;
        let has_ended = alone.contains(&Ending::NotRun);
        let whole_scene = match &self.whole_scene {
            Ok(_) if has_ended => Ok(vec![Ending::NotRun; specs.len() - alone.len()]),
            Ok(worker) => Ok(run(worker, true)?),
            Err(broken) => Err(broken),
        };
        let (mut alone, mut whole_scene) = (alone.into_iter(), whole_scene.map(Vec::into_iter));
        let lost = || GraderError::new("the worker returned no result for a case");
        let each = specs.iter();
        let endings = each.map(|spec| match (spec.needs_all_stages(), &mut whole_scene) {
            (false, _) => alone.next().map(Ok).ok_or_else(lost),
            (true, Ok(whole_scene)) => whole_scene.next().map(Ok).ok_or_else(lost),
            (true, Err(broken)) => Ok(Err((*broken).clone())),
        });
        let endings = endings.collect::<Result<Vec<_>, GraderError>>()?;
        let each = specs.iter().zip(endings);
        let mut endings: Vec<Result<Ending, String>> = each
            .map(|(spec, ending)| ending.map(|ending| moved_back(spec, ending)))
            .collect();
        let tasks: Vec<&str> = specs.iter().map(|spec| spec.task).collect();
        fail_tasks_with_changed_counts(&tasks, &mut endings);
        Ok(endings)
    }
}

/// The ending of a case as if its question had not been moved.
fn moved_back(spec: &Spec, mut ending: Ending) -> Ending {
    if let Ending::Recorded(record) = &mut ending
        && let Outcome::Answered(answer) = record.outcome.clone()
    {
        record.outcome = Outcome::Answered(spec.moved_back(answer));
    }
    ending
}

/// Code that changes its counts in one case may have done so in the others of its task, in whole
/// scenes for example: all of them end so. `tasks` has the task of each ending.
fn fail_tasks_with_changed_counts(tasks: &[&str], endings: &mut [Result<Ending, String>]) {
    let changed: BTreeMap<&str, Ending> = tasks
        .iter()
        .zip(endings.iter())
        .rev()
        .filter_map(|(task, ending)| match ending {
            Ok(ending @ Ending::ChangedCounts(_)) => Some((*task, ending.clone())),
            _ => None,
        })
        .collect();
    for (task, ending) in tasks.iter().zip(endings) {
        if let Some(changed) = changed.get(task) {
            *ending = Ok(changed.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_counts_fail_the_whole_task_and_no_other() {
        let changed = || Ok(Ending::ChangedCounts("it counts 3".into()));
        let mut endings = [Ok(Ending::OutOfTime), changed(), Ok(Ending::OutOfTime)];
        fail_tasks_with_changed_counts(&["a", "a", "b"], &mut endings);
        assert_eq!(endings, [changed(), changed(), Ok(Ending::OutOfTime)]);
    }
}
