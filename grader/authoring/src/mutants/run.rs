//! Grades every mutant and every variant of a task.

use super::blessing::{Blessing, ReferenceAnswers};
use super::corpus::{Corpus, Mutant, REFERENCE, Sources, Variant, reference_sources, variants};
use super::families;
use super::versions_crate::{self, VERSION_VARIABLE};
use base::{GraderError, Workspace, errln};
use grader::course::{Course, Task};
use grader::diagnosis::{Known, diagnose};
use grader::grade::{chosen, score_tasks};
use grader::score::TaskResult;
use grader::signature::Signature;
use grader::workers::runner::Worker;
use grader::workers::stage_workers::StageWorkers;
use judge::Tier;
use judge::cases::{self, Spec};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use tempfile::TempPath;

/// A version of a task's code and its score.
#[derive(Clone, Debug)]
pub struct Graded {
    /// Its name.
    pub name: String,
    /// Whether it is correct or a mutant.
    pub kind: Kind,
    /// Its score.
    pub result: TaskResult,
    /// For a mutant: what `grader bless` would do with each case that it changes, if the reference
    /// made the mistake.
    pub blessings: Vec<Blessing>,
}

/// The kinds of versions.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Correct code: the reference or a variant.
    Correct,
    /// Code with a mistake.
    Mutant(Mutant),
}

impl Graded {
    /// Why a case of this version was not judged: the machine was too busy. `None` if all were.
    fn undecided(&self) -> Option<&'static str> {
        let cases = &self.result.cases;
        cases.iter().find_map(|case| case.undecided().next())
    }

    /// Whether this is correct code that lost core points, which is an error of the grader.
    pub fn is_marked_down(&self) -> bool {
        matches!(self.kind, Kind::Correct) && self.result.score < self.result.max_score
    }
}

/// Grades the reference, all variants and all mutants of `task`, in that order, with seed 0. Fails
/// if the machine is too busy to judge a case of one of them.
pub fn task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
) -> Result<Vec<Graded>, GraderError> {
    let worker = VersionsWorker::of_mutants(workspace, course, task)?;
    worker.grade_all(task, &cases::of(&task.key, 0), 0..worker.versions.len())
}

/// Grades mutants whose mistakes need not be listed in the corpus.
pub fn unlisted(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    mutants: Vec<Mutant>,
) -> Result<Vec<Graded>, GraderError> {
    let none = BTreeSet::new();
    let (graded, broken) = those_that_compile(workspace, course, task, mutants, &none)?;
    if !broken.is_empty() {
        errln!("These do not compile:\n  {}", broken.join("\n  "));
    }
    Ok(graded)
}

/// Grades mutants, and the correct versions with the names `correct`. Returns with them the names
/// of mutants that do not compile.
pub fn those_that_compile(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    mutants: Vec<Mutant>,
    correct: &BTreeSet<String>,
) -> Result<(Vec<Graded>, Vec<String>), GraderError> {
    let compiled =
        VersionsWorker::of_those_that_compile(workspace, course, task, mutants, correct)?;
    let (worker, wanted, broken) = compiled;
    let graded = worker.grade_all(task, &cases::of(&task.key, 0), wanted.into_iter())?;
    Ok((graded, broken))
}

/// As [`those_that_compile`], but only in the core cases that a signature describes, and not
/// compared with the reference.
pub(super) fn in_core_cases(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    mutants: Vec<Mutant>,
    correct: &BTreeSet<String>,
) -> Result<Vec<Graded>, GraderError> {
    let compiled =
        VersionsWorker::of_those_that_compile(workspace, course, task, mutants, correct)?;
    let (worker, wanted, _) = compiled;
    let specs = cases::of(&task.key, 0);
    let mut of_task = task.clone();
    of_task.cases.retain(|entry| {
        let spec = specs.iter().find(|spec| spec.is(&task.key, &entry.name));
        entry.tier == Tier::Core && spec.is_some_and(|spec| !spec.needs_all_stages())
    });
    worker.grade_each(&of_task, &specs, wanted.into_iter(), None)
}

/// Grades every small slip in the reference and the variants of a task; see [`mod@families`].
pub fn families(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
) -> Result<Vec<Graded>, GraderError> {
    let reference = reference_sources(workspace, &task.stage)?;
    let variants = variants(workspace, &task.stage)?;
    let own = |variant: &&Variant| defines_hole(task, &variant.text);
    let variants: Vec<&Variant> = variants.iter().filter(own).collect();
    let mutants = families::mutants(&task.key, &reference, &variants);
    unlisted(workspace, course, task, mutants)
}

/// Whether a variant defines functions of `task` itself and does not use the reference's.
pub(super) fn redefines_hole(task: &Task, variant: &Sources) -> bool {
    let own = variant.get(Path::new("lib.rs"));
    own.is_some_and(|text| defines_hole(task, text))
}

/// Whether a source file defines a function of `task`.
fn defines_hole(task: &Task, text: &str) -> bool {
    let defines = |hole: &String| {
        let starts = [format!("fn {hole}("), format!("fn {hole}<")];
        starts.iter().any(|start| text.contains(start))
    };
    task.holes.iter().any(defines)
}

/// A worker that contains all versions of a stage.
pub(super) struct VersionsWorker<'a> {
    program: TempPath,
    /// The course, whose points the scores are.
    pub(super) course: &'a Course,
    /// The versions, in the order of their numbers.
    pub(super) versions: Vec<Named>,
}

impl<'a> VersionsWorker<'a> {
    /// The worker with the reference, the variants and the mutants of `task`.
    pub(super) fn of_mutants(
        workspace: &Workspace,
        course: &'a Course,
        task: &Task,
    ) -> Result<Self, GraderError> {
        let mutants = Corpus::read(workspace, task)?.mutants;
        let (kinds, sources) = versions(workspace, task, mutants)?;
        let program = versions_crate::worker(workspace, &task.stage, &sources)?;
        Ok(VersionsWorker::new(program, course, kinds))
    }

    /// `program`, whose versions have these names, in this order.
    pub(super) fn new(program: TempPath, course: &'a Course, versions: Vec<Named>) -> Self {
        VersionsWorker {
            program,
            course,
            versions,
        }
    }

    /// The worker with mutants, and the numbers of those that compile and of the correct versions
    /// with the names `correct`; then the names of those that do not compile.
    fn of_those_that_compile(
        workspace: &Workspace,
        course: &'a Course,
        task: &Task,
        mutants: Vec<Mutant>,
        correct: &BTreeSet<String>,
    ) -> Result<(Self, Vec<usize>, Vec<String>), GraderError> {
        let (kinds, versions) = versions(workspace, task, mutants)?;
        let (program, broken) =
            versions_crate::worker_of_those_that_compile(workspace, &task.stage, &versions)?;
        let is_wanted = |i: &usize| match &kinds[*i] {
            (name, Kind::Correct) => correct.contains(name),
            (_, Kind::Mutant(_)) => !broken.contains(i),
        };
        let wanted = (0..kinds.len()).filter(is_wanted).collect();
        let broken = broken.iter().map(|&i| kinds[i].0.clone()).collect();
        Ok((VersionsWorker::new(program, course, kinds), wanted, broken))
    }

    /// Grades some of the versions, by their numbers, and compares the answers of mutants with
    /// those of the reference, which is the first version.
    fn grade_all(
        &self,
        task: &Task,
        specs: &[Spec],
        versions: impl Iterator<Item = usize>,
    ) -> Result<Vec<Graded>, GraderError> {
        let chosen = chosen(&[task], specs)?;
        let endings = self.workers(0).run(&chosen, &mut Vec::new())?;
        let reference = ReferenceAnswers::of(&chosen, &endings);
        self.grade_each(task, specs, versions, Some(&reference))
    }

    /// Grades some of the versions, by their numbers.
    fn grade_each(
        &self,
        task: &Task,
        specs: &[Spec],
        versions: impl Iterator<Item = usize>,
        reference: Option<&ReferenceAnswers>,
    ) -> Result<Vec<Graded>, GraderError> {
        let versions: Vec<usize> = versions.collect();
        progress::stage(&task.key);
        progress::expect(versions.len() as u64);
        let each = versions.par_iter();
        let graded: Result<Vec<Graded>, GraderError> = each
            .map(|version| {
                let graded = self.grade_one(task, specs, *version, reference);
                progress::advance(1);
                graded
            })
            .collect();
        progress::pause();
        let mut graded = graded?;
        for (graded, version) in graded.iter_mut().zip(versions) {
            self.decide(graded, task, specs, version, reference)?;
        }
        Ok(graded)
    }

    /// Grades a version again, alone, if the versions beside it kept a case from being judged.
    fn decide(
        &self,
        graded: &mut Graded,
        task: &Task,
        specs: &[Spec],
        version: usize,
        reference: Option<&ReferenceAnswers>,
    ) -> Result<(), GraderError> {
        for _ in 0..TIMES_ALONE {
            if graded.undecided().is_none() {
                return Ok(());
            }
            *graded = self.grade_one(task, specs, version, reference)?;
        }
        match graded.undecided() {
            None => Ok(()),
            Some(why) => Err(GraderError::new(format!(
                "{}, {}: {why}. Nothing is compared or stored: run this again while nothing else runs",
                task.key, graded.name
            ))),
        }
    }

    /// Grades one of the versions, by its number. Without `reference`, a mutant is not compared
    /// with it.
    pub(super) fn grade_one(
        &self,
        task: &Task,
        specs: &[Spec],
        version: usize,
        reference: Option<&ReferenceAnswers>,
    ) -> Result<Graded, GraderError> {
        let (name, kind) = self.versions[version].clone();
        let chosen = chosen(&[task], specs)?;
        let endings = self.workers(version).run(&chosen, &mut Vec::new())?;
        let mut results = score_tasks(self.course, &[task], &chosen, &endings)?;
        let blessings = match (&kind, reference) {
            (Kind::Mutant(_), Some(reference)) => reference.bless(&chosen, &endings),
            _ => Vec::new(),
        };
        let result = results
            .pop()
            .ok_or_else(|| GraderError::new("grading returned no result for the task"))?;
        Ok(Graded {
            name,
            kind,
            result,
            blessings,
        })
    }

    /// The workers that run one version.
    pub(super) fn workers(&self, version: usize) -> StageWorkers {
        let worker = Worker {
            environment: vec![(VERSION_VARIABLE, version.to_string())],
            ..Worker::from(self.program.to_path_buf())
        };
        // The worker links every stage.
        StageWorkers {
            whole_scene: Ok(worker.clone()),
            stage: worker,
        }
    }
}

/// The number of times that a version is graded alone before the machine counts as too busy.
const TIMES_ALONE: usize = 5;

/// The name of a version and its kind.
pub type Named = (String, Kind);

/// All versions of a task's stage (the reference, the variants, the mutants) and their sources.
/// Fails if the text to replace is not found exactly once.
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
        sources.push(with_reference(&reference, &variant.text));
    }
    for mutant in mutants {
        let base = if let Some(code) = &mutant.code {
            with_reference(&reference, code)
        } else if mutant.on == REFERENCE {
            mutant.apply(&reference)?
        } else {
            let variant = variants.iter().find(|variant| variant.name == mutant.on);
            let variant = variant.ok_or_else(|| {
                let all = variants.iter().map(|variant| variant.name.as_str());
                let names: Vec<&str> = [REFERENCE].into_iter().chain(all).collect();
                GraderError::new(format!(
                    "the form of `{}` that ends in line {} of its list changes `{}`; expected one of {}",
                    mutant.name(),
                    mutant.line,
                    mutant.on,
                    names.join(", ")
                ))
            })?;
            let only = mutant.apply(&[(PathBuf::from("lib.rs"), variant.text.clone())].into())?;
            with_reference(&reference, &only[&PathBuf::from("lib.rs")])
        };
        kinds.push((mutant.name(), Kind::Mutant(mutant)));
        sources.push(base);
    }
    Ok((kinds, sources))
}

/// The sources of a crate whose `lib.rs` is a variant's text and whose module `base` is the
/// reference.
fn with_reference(reference: &Sources, variant: &str) -> Sources {
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

/// The known mistakes of a task for the diagnosis, from the mutants that are not held out. Of
/// mutants that make the same mistake and give nearly the same answers, only the first counts,
/// unless the diagnosis does not name the others without their own answers. Returns with them the
/// names of the mutants that do not count: they may leave the list.
pub fn known<'a>(corpus: &Corpus, graded: &'a [Graded]) -> (Vec<Known>, Vec<&'a str>) {
    let mut known: Vec<Known> = Vec::new();
    let mut alike = Vec::new();
    for (mutant, result) in all_known(corpus, graded) {
        let is_alike = |other: &Known| {
            other.mistakes == mutant.mistakes && other.signature.is_alike(&mutant.signature, ALIKE)
        };
        match known.iter().any(is_alike) {
            true => alike.push((mutant, result)),
            false => known.push(mutant),
        }
    }
    let mut spare = Vec::new();
    for (mutant, graded) in alike {
        let diagnosis = diagnose(&known, &Signature::of(&graded.result.cases));
        let named = diagnosis.map_or(Vec::new(), |diagnosis| diagnosis.mistakes);
        match mutant.mistakes.iter().all(|made| named.contains(made)) {
            true => spare.push(graded.name.as_str()),
            false => known.push(mutant),
        }
    }
    (known, spare)
}

/// Two mutants of one mistake that are this alike teach the diagnosis no more than one.
const ALIKE: f64 = 0.99;

/// The signature of a mutant, without the functions in which it has the same faults as the correct
/// code that it was made from: some correct variants fail robust cases, which is no sign of the
/// mistake.
fn signature_of_mistake(
    mutant: &Mutant,
    graded: &Graded,
    correct: &BTreeMap<&str, Signature>,
) -> Signature {
    let signature = Signature::of(&graded.result.cases);
    match correct.get(mutant.on.as_str()) {
        Some(base) if mutant.code.is_none() => signature.changed_from(base),
        _ => signature,
    }
}

/// The signatures of the reference and the variants, by their names.
fn signatures_of_correct_code(all: &[Graded]) -> BTreeMap<&str, Signature> {
    let correct = all
        .iter()
        .filter(|graded| matches!(graded.kind, Kind::Correct));
    correct
        .map(|graded| (graded.name.as_str(), Signature::of(&graded.result.cases)))
        .collect()
}

/// The known mistake of each mutant that is not held out, with the mutant.
pub(super) fn all_known<'a>(corpus: &Corpus, all: &'a [Graded]) -> Vec<(Known, &'a Graded)> {
    let correct = signatures_of_correct_code(all);
    let mutants = all.iter().filter_map(|graded| match &graded.kind {
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
            let known = Known {
                mistakes: mutant.mistakes.clone(),
                descriptions: mistakes
                    .iter()
                    .map(|mistake| mistake.description.clone())
                    .collect(),
                hints: mistakes
                    .iter()
                    .map(|mistake| mistake.hint.clone())
                    .collect(),
                signature: signature_of_mistake(mutant, graded, &correct),
                is_symptom: mistakes.iter().any(|mistake| mistake.symptom),
            };
            (known, graded)
        })
        .filter(|(known, _)| !known.signature.is_empty())
        .collect()
}
