//! Grades the versions of a task with many seeds: no seed may mark correct code down, and no move of
//! a question may change what an answer is worth.

use super::corpus::Corpus;
use super::run::{Graded, Kind, VersionsWorker, redefines_hole, versions};
use super::versions_crate;
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::grade::{chosen, score_tasks};
use grader::score::TaskResult;
use grader::workers::runner::Ending;
use judge::cases::{self, KNOWN_SEED, Spec};
use judge::moved::has_same_bits;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use submission::by_heart;
use wire::{Answer, Outcome};

/// What a run with many seeds found.
pub struct Seeded {
    /// The versions that lost core points, with the seed.
    pub marked_down: Vec<(u64, Graded)>,
    /// The versions that would be told that they know the answers by heart, with the seed.
    pub accused: Vec<(u64, String)>,
    /// How many versions were graded.
    pub versions: usize,
    /// The cases that depend on the seed. The others were not run again.
    pub cases: Vec<String>,
    /// For each version and case how many moves gave the answers other bits.
    pub other_bits: BTreeMap<(String, String), usize>,
    /// The same for the points of the case.
    pub other_points: BTreeMap<(String, String), usize>,
}

/// One process runs the cases of this many seeds, so that starting it takes little of the time.
const SEEDS_AT_ONCE: u64 = 10;

/// Grades the reference and the variants of `task` with each of `seeds`, in the cases that depend
/// on the seed; `with_mistakes` also its typical mistakes.
///
/// A variant that does not define a function of the task is the reference, and is not graded again.
pub fn grade(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    seeds: Range<u64>,
    with_mistakes: bool,
) -> Result<Seeded, GraderError> {
    let questions = Questions::of(task);
    let task = &questions.task;
    let mutants = match with_mistakes {
        true => Corpus::read(workspace, task)?.mutants,
        false => Vec::new(),
    };
    let (kinds, sources) = versions(workspace, task, mutants)?;
    let distinct = |version: &usize| {
        let is_mutant = matches!(kinds[*version].1, Kind::Mutant(_));
        *version == 0 || is_mutant || redefines_hole(task, &sources[*version])
    };
    let distinct: Vec<usize> = (0..sources.len()).filter(distinct).collect();
    let mut seeded = Seeded {
        marked_down: Vec::new(),
        accused: Vec::new(),
        versions: distinct.len(),
        cases: task.cases.iter().map(|case| case.name.clone()).collect(),
        other_bits: BTreeMap::new(),
        other_points: BTreeMap::new(),
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
            .map(|seed| (seed, questions.with_seed(seed)))
            .collect();
        let each = distinct.par_iter();
        let graded: Vec<Vec<WithSeed>> = each
            .map(|&version| worker.grade_seeds(&questions, &specs, version))
            .collect::<Result<_, _>>()?;
        for WithSeed {
            seed,
            graded,
            moved,
            is_accused,
        } in graded.into_iter().flatten()
        {
            let all = [
                (&mut seeded.other_bits, moved.other_bits),
                (&mut seeded.other_points, moved.other_points),
            ];
            for (counts, cases) in all {
                for case in cases {
                    *counts.entry((graded.name.clone(), case)).or_default() += 1;
                }
            }
            if is_accused {
                seeded.accused.push((seed, graded.name.clone()));
            }
            if graded.is_marked_down() {
                seeded.marked_down.push((seed, graded));
            }
        }
    }
    Ok(seeded)
}

/// A version that was graded with a seed.
struct WithSeed {
    seed: u64,
    graded: Graded,
    moved: Changes,
    is_accused: bool,
}

/// The moved cases whose answers, moved back, are not those without the move.
#[derive(Default)]
struct Changes {
    other_bits: Vec<String>,
    other_points: Vec<String>,
}

impl VersionsWorker<'_> {
    /// Grades one version with each of the seeds, and with the known one to compare, in one process.
    fn grade_seeds(
        &self,
        questions: &Questions,
        specs: &[(u64, Vec<Spec>)],
        version: usize,
    ) -> Result<Vec<WithSeed>, GraderError> {
        let task = &questions.task;
        let mut all = chosen(&[task], &questions.known)?;
        for (_, specs) in specs {
            all.extend(chosen(&[task], specs)?);
        }
        let endings = self.workers(version).run(&all, &mut Vec::new())?;
        let count = task.cases.len();
        let mut of_each_seed = all.chunks(count).zip(endings.chunks(count));
        let score = |chosen: &[&Spec], endings: &[Result<Ending, String>]| {
            let mut results = score_tasks(self.course, &[task], chosen, endings)?;
            let result = results.pop();
            result.ok_or_else(|| GraderError::new("grading returned no result for the task"))
        };
        let Some((known_cases, known_endings)) = of_each_seed.next() else {
            return Ok(Vec::new());
        };
        let known = score(known_cases, known_endings)?;
        let (name, kind) = &self.versions[version];
        let graded = specs
            .iter()
            .zip(of_each_seed)
            .map(|((seed, _), (chosen, endings))| {
                let result = score(chosen, endings)?;
                let pairs = known_endings.iter().zip(endings);
                Ok(WithSeed {
                    seed: *seed,
                    moved: questions.changes(pairs, &known, &result),
                    is_accused: *seed != KNOWN_SEED && by_heart::accuses(&result, &known),
                    graded: Graded {
                        name: name.clone(),
                        kind: kind.clone(),
                        result,
                        blessings: Vec::new(),
                    },
                })
            });
        graded.collect()
    }
}

/// The cases of a task that depend on the seed.
struct Questions {
    /// The task with these cases only.
    task: Task,
    /// All cases of the task with the known seed.
    known: Vec<Spec>,
    /// Those with other numbers with each seed. The others are only moved.
    fresh: BTreeSet<&'static str>,
}

impl Questions {
    fn of(task: &Task) -> Questions {
        let [known, other] = [KNOWN_SEED, KNOWN_SEED + 1].map(|seed| cases::of(&task.key, seed));
        let is_fresh = |(known, other): &(&Spec, &Spec)| {
            // As text, in which a NaN equals a NaN.
            format!("{:?}", known.work) != format!("{:?}", other.work)
        };
        let pairs = known.iter().zip(&other);
        let fresh: BTreeSet<&'static str> = pairs
            .filter(is_fresh)
            .map(|(known, _)| known.name)
            .collect();
        let depends = |name: &str| {
            let is_moved = |spec: &Spec| spec.name == name && spec.is_moved();
            fresh.contains(name) || other.iter().any(is_moved)
        };
        let mut task = task.clone();
        task.cases.retain(|case| depends(&case.name));
        Questions { task, known, fresh }
    }

    /// The cases with another seed. Those that are only moved share their exact results.
    fn with_seed(&self, seed: u64) -> Vec<Spec> {
        let drawn = cases::of(&self.task.key, seed).into_iter();
        let pairs = drawn.zip(&self.known);
        pairs
            .map(|(drawn, known)| match self.fresh.contains(drawn.name) {
                true => drawn,
                false => known.clone().moved_for(seed),
            })
            .collect()
    }

    /// What a move changed in the cases that are only moved: `pairs` has their endings without and
    /// with it.
    fn changes<'a>(
        &self,
        pairs: impl Iterator<Item = (&'a Result<Ending, String>, &'a Result<Ending, String>)>,
        known: &TaskResult,
        moved: &TaskResult,
    ) -> Changes {
        let mut changes = Changes::default();
        let results = known.cases.iter().zip(&moved.cases);
        for ((before, after), (known, moved)) in pairs.zip(results) {
            if self.fresh.contains(known.name.as_str()) {
                continue;
            }
            let is_same = match (answer(before), answer(after)) {
                (Some(before), Some(after)) => has_same_bits(before, after),
                (before, after) => before.is_none() == after.is_none(),
            };
            if !is_same {
                changes.other_bits.push(known.name.clone());
            }
            if known.earned != moved.earned {
                changes.other_points.push(known.name.clone());
            }
        }
        changes
    }
}

fn answer(ending: &Result<Ending, String>) -> Option<&Answer> {
    match ending.as_ref().ok()?.outcome()? {
        Outcome::Answered(answer) => Some(answer),
        _ => None,
    }
}
