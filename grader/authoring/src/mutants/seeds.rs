//! Grades the correct versions of a task with many seeds: no seed may mark correct code down.

use super::run::{Graded, VersionsWorker, redefines_hole, versions};
use super::versions_crate;
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::grade::{chosen, score_tasks};
use judge::cases::{self, Spec};
use rayon::prelude::*;
use std::ops::Range;
use wire::Work;

/// What a run with many seeds found.
pub struct Seeded {
    /// The versions that lost core points, with the seed.
    pub marked_down: Vec<(u64, Graded)>,
    /// How many correct versions were graded.
    pub versions: usize,
    /// The cases that depend on the seed. The others were not run again.
    pub cases: Vec<String>,
}

/// One process runs the cases of this many seeds, so that starting it takes little of the time.
const SEEDS_AT_ONCE: u64 = 10;

/// Grades the reference and the variants of `task` with each of `seeds`, in the cases that depend
/// on the seed.
///
/// A variant that does not define a function of the task is the reference, and is not graded again.
pub fn grade(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    seeds: Range<u64>,
) -> Result<Seeded, GraderError> {
    let task = &that_depend_on_the_seed(task);
    let (kinds, sources) = versions(workspace, task, Vec::new())?;
    let distinct = |version: &usize| *version == 0 || redefines_hole(task, &sources[*version]);
    let distinct: Vec<usize> = (0..sources.len()).filter(distinct).collect();
    let mut seeded = Seeded {
        marked_down: Vec::new(),
        versions: distinct.len(),
        cases: task.cases.iter().map(|case| case.name.clone()).collect(),
    };
    if task.cases.is_empty() {
        return Ok(seeded);
    }
    let worker = VersionsWorker::new(
        versions_crate::worker(workspace, &task.stage, &sources)?,
        course,
        kinds,
    );
    let blocks = seeds
        .clone()
        .step_by(SEEDS_AT_ONCE as usize)
        .map(|start| start..seeds.end.min(start + SEEDS_AT_ONCE));
    for block in blocks {
        let specs: Vec<(u64, Vec<Spec>)> = block
            .into_par_iter()
            .map(|seed| (seed, cases::of(&task.key, seed)))
            .collect();
        let each = distinct.par_iter();
        let graded: Vec<Vec<(u64, Graded)>> = each
            .map(|&version| worker.grade_seeds(task, &specs, version))
            .collect::<Result<_, _>>()?;
        let all = graded.into_iter().flatten();
        seeded
            .marked_down
            .extend(all.filter(|(_, graded)| graded.is_marked_down()));
    }
    Ok(seeded)
}

impl VersionsWorker<'_> {
    /// Grades one version with each of the seeds, in one process.
    fn grade_seeds(
        &self,
        task: &Task,
        specs: &[(u64, Vec<Spec>)],
        version: usize,
    ) -> Result<Vec<(u64, Graded)>, GraderError> {
        let mut all = Vec::new();
        for (_, specs) in specs {
            all.extend(chosen(&[task], specs)?);
        }
        let endings = self.workers(version).run(&all, &mut Vec::new())?;
        let count = task.cases.len();
        let of_each_seed = all.chunks(count).zip(endings.chunks(count));
        let (name, kind) = &self.versions[version];
        specs
            .iter()
            .zip(of_each_seed)
            .map(|((seed, _), (chosen, endings))| {
                let mut results = score_tasks(self.course, &[task], chosen, endings)?;
                let result = results
                    .pop()
                    .ok_or_else(|| GraderError::new("grading returned no result for the task"))?;
                let graded = Graded {
                    name: name.clone(),
                    kind: kind.clone(),
                    result,
                    blessings: Vec::new(),
                };
                Ok((*seed, graded))
            })
            .collect()
    }
}

/// `task` with only those cases that depend on the seed.
fn that_depend_on_the_seed(task: &Task) -> Task {
    let [zero, one] = [0, 1].map(|seed| cases::of(&task.key, seed));
    let of = |specs: &[Spec], name: &str| -> Option<Work> {
        let spec = specs.iter().find(|spec| spec.is(&task.key, name));
        spec.map(|spec| spec.work.clone())
    };
    let mut task = task.clone();
    task.cases
        .retain(|case| of(&zero, &case.name) != of(&one, &case.name));
    task
}
