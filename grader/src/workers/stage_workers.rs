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
    /// back to the question that is judged. A seed also draws the order of the cases. Returns its ending, or the names of the stages without
    /// which it cannot run. Appends the output of the code to `printed`.
    pub fn run(
        &self,
        specs: &[&Spec],
        printed: &mut Vec<Printed>,
    ) -> Result<Vec<Result<Ending, String>>, GraderError> {
        let in_order = shuffled(specs);
        let mut new_lines = Vec::new();
        let mut endings: Vec<Option<Result<Ending, String>>> = vec![None; specs.len()];
        let mut run = |worker: &Worker, all_stages: bool| -> Result<bool, GraderError> {
            let is_chosen = |i: &&usize| specs[**i].needs_all_stages() == all_stages;
            let chosen: Vec<usize> = in_order.iter().filter(is_chosen).copied().collect();
            let cases: Vec<wire::Case> = chosen.iter().map(|&i| specs[i].case()).collect();
            let run = runner::run(worker, &cases)?;
            new_lines.extend(run.printed);
            let has_ended = run.endings.contains(&Ending::NotRun);
            for (i, ending) in chosen.into_iter().zip(run.endings) {
                endings[i] = Some(Ok(ending));
            }
            Ok(has_ended)
        };
        let has_ended = run(&self.stage, false)?;
        let without = match &self.whole_scene {
            Ok(_) if has_ended => Some(Ok(Ending::NotRun)),
            Ok(worker) => run(worker, true).map(|_| None)?,
            Err(broken) => Some(Err(broken.clone())),
        };
        let place = |line: &Printed| {
            specs
                .iter()
                .position(|spec| spec.is(&line.task, &line.case))
        };
        new_lines.sort_by_key(place);
        printed.extend(new_lines);
        let lost = || GraderError::new("the worker returned no result for a case");
        let each = specs.iter().zip(endings).map(|(spec, ending)| {
            let ending = ending.or_else(|| without.clone()).ok_or_else(lost)?;
            Ok(ending.map(|ending| moved_back(spec, ending)))
        });
        let mut endings = each.collect::<Result<Vec<Result<Ending, String>>, GraderError>>()?;
        let tasks: Vec<&str> = specs.iter().map(|spec| spec.task).collect();
        fail_tasks_with_changed_counts(&tasks, &mut endings);
        Ok(endings)
    }
}

/// The cases in the order in which they run: a seed draws it within each task.
fn shuffled(specs: &[&Spec]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..specs.len()).collect();
    let task = |i: usize| specs.iter().position(|spec| spec.task == specs[i].task);
    order.sort_by_key(|&i| (task(i), specs[i].place()));
    order
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
    fn a_seed_draws_the_order_of_cases_within_their_task() {
        let of_seed = |seed| {
            let specs = judge::cases::all(seed).into_iter();
            specs
                .filter(|spec| spec.task.starts_with("part5"))
                .collect::<Vec<_>>()
        };
        let order = |specs: &[Spec]| shuffled(&specs.iter().collect::<Vec<_>>());
        let known = of_seed(0);
        assert!(order(&known).is_sorted());
        let drawn = [1, 2].map(|seed| order(&of_seed(seed)));
        assert_ne!(drawn[0], drawn[1]);
        for order in drawn {
            assert!(!order.is_sorted());
            assert!(order.is_sorted_by_key(|&i| known[i].task));
        }
    }

    #[test]
    fn changed_counts_fail_the_whole_task_and_no_other() {
        let changed = || Ok(Ending::ChangedCounts("it counts 3".into()));
        let mut endings = [Ok(Ending::OutOfTime), changed(), Ok(Ending::OutOfTime)];
        fail_tasks_with_changed_counts(&["a", "a", "b"], &mut endings);
        assert_eq!(endings, [changed(), changed(), Ok(Ending::OutOfTime)]);
    }
}
