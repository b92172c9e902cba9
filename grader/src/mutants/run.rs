//! Grading every mutant and every variant of a task.

use super::corpus::{Corpus, Mutant, REFERENCE, Sources, reference_sources, variants};
use super::host::{self, CHOICE};
use crate::cases;
use crate::course::{Course, Task};
use crate::diagnosis::Known;
use crate::error::GraderError;
use crate::grade::grade_tasks;
use crate::runner::Worker;
use crate::score::TaskResult;
use crate::signature::Signature;
use crate::workers::Workers;
use crate::workspace::Workspace;
use rayon::prelude::*;
use std::path::PathBuf;

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
    /// Whether the grader was right about it: mutants lose points, correct code keeps every core point.
    pub fn is_as_it_should_be(&self) -> bool {
        let result = &self.result;
        match self.kind {
            Kind::Correct => result.score >= result.max_score,
            Kind::Mutant(_) => {
                result.score + result.robust_score < result.max_score + result.robust_max_score
            }
        }
    }
}

/// Grades the reference, all variants and all mutants of `task` for each of `seeds`, in that order.
pub fn task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    seeds: &[u64],
) -> Result<Vec<Graded>, GraderError> {
    let corpus = Corpus::read(workspace, task)?;
    let (kinds, versions) = versions(workspace, task, corpus)?;
    let program = host::worker(workspace, &task.stage, &versions)?;
    let orders: Vec<(usize, u64)> = (0..kinds.len())
        .flat_map(|version| seeds.iter().map(move |seed| (version, *seed)))
        .collect();
    orders
        .into_par_iter()
        .map(|(version, seed)| {
            let environment = vec![(CHOICE, version.to_string())];
            let worker = Worker {
                program: program.clone(),
                environment,
            };
            let specs = cases::all(seed);
            // The host is built with every stage.
            let workers = Workers {
                together: Ok(worker.clone()),
                own: worker,
            };
            let mut results = grade_tasks(course, &[task], &specs, &workers, &mut String::new())?;
            let result = results
                .pop()
                .ok_or_else(|| GraderError::new("the grader lost a task"))?;
            let (name, kind) = kinds[version].clone();
            Ok(Graded { name, kind, result })
        })
        .collect()
}

type Named = (String, Kind);

/// All versions of a task's stage: name and kind, and sources.
fn versions(
    workspace: &Workspace,
    task: &Task,
    corpus: Corpus,
) -> Result<(Vec<Named>, Vec<Sources>), GraderError> {
    let reference = reference_sources(workspace, &task.stage)?;
    let variants = variants(workspace, &task.stage)?;
    let mut kinds = vec![(REFERENCE.to_string(), Kind::Correct)];
    let mut sources = vec![reference.clone()];
    for variant in &variants {
        kinds.push((variant.name.clone(), Kind::Correct));
        sources.push(on_reference(&reference, &variant.text));
    }
    for mutant in corpus.mutants {
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
                says: mistakes
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
