//! Grading every mutant and every variant of a task.

use super::corpus::{Corpus, Mutant, REFERENCE, Sources, reference_sources, variants};
use super::host::{self, CHOICE};
use grader::course::{Course, Task};
use grader::diagnosis::Known;
use grader::error::GraderError;
use grader::grade::grade_tasks;
use grader::runner::Worker;
use grader::score::TaskResult;
use grader::signature::Signature;
use grader::stage_workers::Workers;
use grader::workspace::Workspace;
use judge::cases::{self, Spec};
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use wire::Work;

/// A version of a task's code and how the grader scored it.
#[derive(Clone, Debug)]
pub struct Graded {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// What it earned.
    pub result: TaskResult,
}

/// What a version is.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Correct: the reference or a variant.
    Correct,
    /// Wrong on purpose.
    Mutant(Mutant),
}

impl Graded {
    /// Whether this is correct code that lost a core point: the grader is wrong about it.
    pub fn is_accused(&self) -> bool {
        matches!(self.kind, Kind::Correct) && self.result.score < self.result.max_score
    }
}

/// Milliseconds that a case of a mutant may take. Sound code needs a few; one that never comes back should not cost
/// the corpus minutes. Correct code has the time that students have.
const MUTANT_LIMIT_MS: u64 = 1500;

/// Grades the reference, all variants and all mutants of `task`, in that order. Then the correct ones again with the
/// cases that `seeds` seeds make otherwise than the first one, 0: of these, only those that are accused are given.
pub fn task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    seeds: u64,
) -> Result<Vec<Graded>, GraderError> {
    let mutants = Corpus::read(workspace, task)?.mutants;
    let (kinds, versions) = versions(workspace, task, mutants)?;
    let has_own = |version: &usize| *version == 0 || solves(task, &versions[*version]);
    let host = Host {
        program: host::worker(workspace, &task.stage, &versions)?,
        course,
        versions: kinds,
    };
    let everything = 0..host.versions.len();
    let specs = cases::all(0);
    let mut graded = host.grade(task, &specs, everything.clone())?;
    let is_correct = |version: &usize| matches!(host.versions[*version].1, Kind::Correct);
    for seed in 1..seeds {
        let others = cases::all(seed);
        let fresh = changed(task, &specs, &others);
        if fresh.cases.is_empty() {
            break;
        }
        let correct = everything.clone().filter(is_correct).filter(has_own);
        let again = host.grade(&fresh, &others, correct)?;
        graded.extend(again.into_iter().filter(Graded::is_accused));
    }
    Ok(graded)
}

/// Grades mutants that need not be in the corpus.
pub fn strangers(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    mutants: Vec<Mutant>,
) -> Result<Vec<Graded>, GraderError> {
    let (kinds, versions) = versions(workspace, task, mutants)?;
    let is_wrong = |kind: &Kind| matches!(kind, Kind::Mutant(_));
    let wrong = (0..kinds.len()).filter(|&i| is_wrong(&kinds[i].1));
    let wrong: Vec<usize> = wrong.collect();
    let host = Host {
        program: host::worker(workspace, &task.stage, &versions)?,
        course,
        versions: kinds,
    };
    host.grade(task, &cases::all(0), wrong.into_iter())
}

/// Whether a variant solves `task` in a way of its own: others of its stage have the reference's.
fn solves(task: &Task, variant: &Sources) -> bool {
    let own = variant.get(Path::new("lib.rs"));
    let defines = |text: &String, hole: &String| {
        [format!("fn {hole}("), format!("fn {hole}<")]
            .iter()
            .any(|start| text.contains(start))
    };
    own.is_some_and(|text| task.holes.iter().any(|hole| defines(text, hole)))
}

/// The part of `task` whose cases are not the same in `others` as in `specs`.
fn changed(task: &Task, specs: &[Spec], others: &[Spec]) -> Task {
    let of = |specs: &[Spec], name: &str| -> Option<Work> {
        let spec = specs.iter().find(|spec| spec.is(&task.key, name));
        spec.map(|spec| spec.work.clone())
    };
    let mut task = task.clone();
    task.cases
        .retain(|case| of(specs, &case.name) != of(others, &case.name));
    task
}

/// A worker that holds all versions of a stage.
struct Host<'a> {
    program: PathBuf,
    course: &'a Course,
    versions: Vec<Named>,
}

impl Host<'_> {
    /// Grades some of the versions, by their numbers.
    fn grade(
        &self,
        task: &Task,
        specs: &[Spec],
        versions: impl Iterator<Item = usize>,
    ) -> Result<Vec<Graded>, GraderError> {
        let versions: Vec<usize> = versions.collect();
        let each = versions.into_par_iter();
        each.map(|version| self.grade_one(task, specs, version))
            .collect()
    }

    fn grade_one(
        &self,
        task: &Task,
        specs: &[Spec],
        version: usize,
    ) -> Result<Graded, GraderError> {
        let (name, kind) = self.versions[version].clone();
        let worker = Worker {
            program: self.program.clone(),
            environment: vec![(CHOICE, version.to_string())],
            longest_ms: match kind {
                Kind::Correct => u64::MAX,
                Kind::Mutant(_) => MUTANT_LIMIT_MS,
            },
        };
        // The host is built with every stage.
        let workers = Workers {
            together: Ok(worker.clone()),
            own: worker,
        };
        let mut results = grade_tasks(self.course, &[task], specs, &workers, &mut String::new())?;
        let result = results
            .pop()
            .ok_or_else(|| GraderError::new("the grader lost a task"))?;
        Ok(Graded { name, kind, result })
    }
}

/// A version's name, and what it is.
pub type Named = (String, Kind);

/// All versions of a task's stage: the reference, the variants, the mutants; and their sources. Fails if an edit does
/// not fit its code.
pub fn versions(
    workspace: &Workspace,
    task: &Task,
    mutants: Vec<Mutant>,
) -> Result<(Vec<Named>, Vec<Sources>), GraderError> {
    let reference = reference_sources(workspace, &task.stage)?;
    let variants = variants(workspace, &task.stage)?;
    let mut kinds = vec![(REFERENCE.to_string(), Kind::Correct)];
    let mut sources = vec![reference.clone()];
    for variant in &variants {
        kinds.push((variant.name.clone(), Kind::Correct));
        sources.push(on_reference(&reference, &variant.text));
    }
    for mutant in mutants {
        let base = if mutant.on == REFERENCE {
            mutant.apply(&reference)?
        } else {
            let variant = variants.iter().find(|variant| variant.name == mutant.on);
            let variant = variant.ok_or_else(|| {
                GraderError::new(format!(
                    "mutant `{}` is made from `{}`, which is no variant of `{}`",
                    mutant.name(),
                    mutant.on,
                    task.stage
                ))
            })?;
            let only = mutant.apply(&[(PathBuf::from("lib.rs"), variant.text.clone())].into())?;
            on_reference(&reference, &only[&PathBuf::from("lib.rs")])
        };
        kinds.push((mutant.name(), Kind::Mutant(mutant)));
        sources.push(base);
    }
    Ok((kinds, sources))
}

/// A crate whose `lib.rs` is a variant's text, with the reference beside it as the module `base`.
fn on_reference(reference: &Sources, variant: &str) -> Sources {
    let mut sources: Sources = reference
        .iter()
        .map(|(path, text)| {
            let path = if path.to_str() == Some("lib.rs") {
                PathBuf::from("base/mod.rs")
            } else {
                PathBuf::from("base").join(path)
            };
            (path, text.replace("crate::", "crate::base::"))
        })
        .collect();
    sources.insert(
        PathBuf::from("lib.rs"),
        format!("{variant}\npub mod base;\n"),
    );
    sources
}

/// What the diagnosis knows of a task, from the mutants that are not held out.
pub fn known(corpus: &Corpus, graded: &[Graded]) -> Vec<Known> {
    let mutants = graded.iter().filter_map(|graded| match &graded.kind {
        Kind::Mutant(mutant) if !mutant.held_out => Some((mutant, graded)),
        _ => None,
    });
    mutants
        .map(|(mutant, graded)| {
            let mistakes: Vec<_> = mutant
                .mistakes
                .iter()
                .filter_map(|id| corpus.mistake(id))
                .collect();
            Known {
                mistakes: mutant.mistakes.clone(),
                descriptions: mistakes
                    .iter()
                    .map(|mistake| mistake.says.clone())
                    .collect(),
                hints: mistakes
                    .iter()
                    .map(|mistake| mistake.hint.clone())
                    .collect(),
                signature: Signature::of(&graded.result.cases),
            }
        })
        .filter(|known| !known.signature.is_empty())
        .collect()
}
