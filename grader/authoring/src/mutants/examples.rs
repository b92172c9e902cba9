//! Counts the typical mistakes that a student's examples would catch.

use super::run::{Graded, Kind, VersionsWorker};
use super::simplest::Shown;
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::workers::runner::Ending;
use grader::workers::stage_workers::StageWorkers;
use judge::Tier;
use judge::cases::{self, Spec};
use judge::examples::{Example, verdict};
use rayon::prelude::*;
use wire::Outcome;

/// What the right examples of a task tell of its mutants.
#[derive(Clone, Debug, Default)]
pub struct Caught {
    /// The mutants on which an example is wrong.
    pub caught: Vec<String>,
    /// The mutants on which no example is wrong, with the simplest call that shows each.
    pub missed: Vec<Shown>,
}

impl Caught {
    /// The mutant that slips through and whose call has the fewest digits.
    pub fn simplest_missed(&self) -> Option<&Shown> {
        let shown = self.missed.iter().filter(|shown| shown.call.is_some());
        shown.min_by_key(|shown| shown.digits())
    }
}

/// Asks the questions of the right `examples` of every mutant of `task` that loses core points.
pub fn of_task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    examples: &[Example],
) -> Result<Caught, GraderError> {
    let of_task = examples.iter().filter(|of| of.task() == task.key);
    let right = of_task.filter(|of| verdict(of).is_none());
    let questions: Vec<Spec> = right.filter_map(Example::question).collect();
    let worker = VersionsWorker::of_mutants(workspace, course, task)?;
    let specs = cases::of(&task.key, 0);
    let each = (0..worker.versions.len()).into_par_iter().map(|version| {
        let graded = worker.grade_one(task, &specs, version, None)?;
        let Graded { kind, result, .. } = &graded;
        if !matches!(kind, Kind::Mutant(_)) || result.score >= result.max_score {
            return Ok(Caught::default());
        }
        let workers = worker.workers(version);
        Ok(match catches(&workers, &questions)? {
            true => Caught {
                caught: vec![graded.name],
                missed: Vec::new(),
            },
            false => Caught {
                caught: Vec::new(),
                missed: vec![Shown::of(&workers, graded, &specs)?],
            },
        })
    });
    let each: Vec<Caught> = each.collect::<Result<_, GraderError>>()?;
    Ok(each.into_iter().fold(Caught::default(), |mut all, one| {
        all.caught.extend(one.caught);
        all.missed.extend(one.missed);
        all
    }))
}

/// Whether the code is wrong on one of the questions, or does not answer it.
fn catches(workers: &StageWorkers, questions: &[Spec]) -> Result<bool, GraderError> {
    let endings = workers.run(&questions.iter().collect::<Vec<_>>(), &mut Vec::new())?;
    let mut asked = questions.iter().zip(&endings);
    Ok(asked.any(|(spec, ending)| {
        let outcome = ending.as_ref().ok().and_then(Ending::outcome);
        match outcome {
            Some(Outcome::Answered(answer)) => {
                let findings = judge::judge(spec, Tier::Core, answer);
                findings.iter().any(|finding| !finding.passed())
            }
            _ => true,
        }
    }))
}
