//! Pairs: two known mistakes made at once, composed from a form of each on the same code.
//!
//! `grader/mutants/pairs.toml` lists groups of typical mistakes; each two of a group are a pair. The
//! diagnosis names most pairs by what it knows of each mistake alone. Where both change the same
//! value, the value is wrong in a third way, or right: for such pairs `grader mutants TASK --bless`
//! stores a signature of their own.

use super::corpus::{
    Corpus, Mutant, REFERENCE, Sources, Variant, merged, reference_sources, variants,
};
use super::run::{self, Graded, Kind};
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::diagnosis::{Known, MOST_GUESSES, diagnose};
use grader::signature::Signature;
use rayon::prelude::*;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::fmt;
use std::path::PathBuf;

/// Typical mistakes in the same function of a task.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Key of the task.
    pub task: String,
    /// The names of the mistakes.
    pub mistakes: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    group: Vec<Group>,
}

/// What became of the pairs of a task.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Pairs of listed mistakes.
    pub listed: usize,
    /// Pairs with code that makes both mistakes and compiles.
    pub composed: usize,
    /// Pairs that the diagnosis names by what it knows of each mistake alone.
    pub named_by_halves: usize,
    /// Pairs with the answers of one mistake, of right code, or of too many other pairs.
    pub indistinguishable: usize,
    /// Pairs with a signature of their own.
    pub stored: usize,
}

impl Group {
    /// The groups of all tasks.
    pub fn all(workspace: &Workspace) -> Result<Vec<Group>, GraderError> {
        workspace.ensure_full("it does not contain the list of typical mistakes")?;
        let path = workspace.root().join("grader/mutants/pairs.toml");
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        let list: List = toml::from_str(&text).map_err(|e| GraderError::file("parse", &path, e))?;
        Ok(list.group)
    }
}

/// Each two mistakes of a group of the task, once.
fn listed(groups: &[Group], task: &str) -> BTreeSet<[String; 2]> {
    let of_task = groups.iter().filter(|group| group.task == task);
    let pairs = of_task.flat_map(|Group { mistakes, .. }| {
        mistakes.iter().enumerate().flat_map(|(i, first)| {
            let others = mistakes[i + 1..].iter();
            others.map(move |second| {
                let mut pair = [first.clone(), second.clone()];
                pair.sort_unstable();
                pair
            })
        })
    });
    pairs.collect()
}

/// The pairs of a task, graded.
#[derive(Debug)]
pub struct Pairs {
    /// The pairs, and the correct versions that they are made from.
    pub graded: Vec<Graded>,
    listed: usize,
}

/// Grades the pairs of a task that can be composed and compile.
pub fn graded(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    corpus: &Corpus,
) -> Result<Pairs, GraderError> {
    let listed = listed(&Group::all(workspace)?, &task.key);
    let pairs = composed_pairs(workspace, task, corpus, &listed)?;
    let mut graded = Vec::new();
    if !pairs.is_empty() {
        let bases = pairs.iter().map(|pair| pair.on.clone()).collect();
        graded = run::in_core_cases(workspace, course, task, pairs, &bases)?;
    }
    Ok(Pairs {
        graded,
        listed: listed.len(),
    })
}

/// Code for each of the pairs that can be composed and has no form of its own.
fn composed_pairs(
    workspace: &Workspace,
    task: &Task,
    corpus: &Corpus,
    listed: &BTreeSet<[String; 2]>,
) -> Result<Vec<Mutant>, GraderError> {
    let mut names = listed.iter().flatten();
    if let Some(unknown) = names.find(|id| corpus.mistake(id).is_none()) {
        return Err(GraderError::new(format!(
            "grader/mutants/pairs.toml: `{unknown}` is no mistake of {}: correct its name",
            task.key
        )));
    }
    let variants = variants(workspace, &task.stage)?.into_iter();
    let of_variants = variants.map(|Variant { name, text }| {
        let only = Sources::from([(PathBuf::from("lib.rs"), text)]);
        (name, only)
    });
    let reference = reference_sources(workspace, &task.stage)?;
    let bases: Vec<(String, Sources)> = of_variants
        .chain([(REFERENCE.to_string(), reference)])
        .collect();
    let unwritten = listed.iter().filter(|pair| !is_written(corpus, *pair));
    let pairs = unwritten.filter_map(|pair| composed(corpus, &bases, pair));
    Ok(pairs.collect())
}

/// Whether the list of mistakes has a form that makes both mistakes.
fn is_written(corpus: &Corpus, pair: &[String]) -> bool {
    let is_both = |form: &Mutant| {
        form.mistakes.len() == pair.len() && pair.iter().all(|id| form.mistakes.contains(id))
    };
    corpus.mutants.iter().any(is_both)
}

/// Code that makes both mistakes: edits of the first of `bases` that allows both. `None` if the edits
/// exclude each other everywhere.
fn composed(corpus: &Corpus, bases: &[(String, Sources)], pair: &[String; 2]) -> Option<Mutant> {
    bases.iter().find_map(|(on, sources)| {
        let [first, second] = pair.each_ref().map(|id| forms(corpus, id, on));
        let mut both = first
            .iter()
            .flat_map(|a| second.iter().map(move |b| [*a, *b]));
        both.find_map(|forms| {
            Some(Mutant {
                mistakes: pair.to_vec(),
                on: on.clone(),
                edits: merged(forms, sources)?,
                ..Mutant::default()
            })
        })
    })
}

/// The edits of this code that make one mistake alone.
fn forms<'a>(corpus: &'a Corpus, id: &str, on: &str) -> Vec<&'a Mutant> {
    let of_mistake = corpus.mutants.iter().filter(|form| form.mistakes == [id]);
    of_mistake
        .filter(|form| form.on == on && form.code.is_none() && !form.held_out)
        .collect()
}

/// Replaces the composed pairs among the known mistakes by those of `pairs` that the diagnosis does
/// not name without.
pub fn renew(known: &mut Vec<Known>, corpus: &Corpus, pairs: &Pairs) -> Counts {
    known.retain(|known| known.mistakes.len() == 1 || is_written(corpus, &known.mistakes));
    let is_pair = |graded: &&Graded| matches!(graded.kind, Kind::Mutant(_));
    let mut counts = Counts {
        listed: pairs.listed,
        composed: pairs.graded.iter().filter(is_pair).count(),
        ..Counts::default()
    };
    let pairs = run::all_known(corpus, &pairs.graded);
    counts.indistinguishable = counts.composed - pairs.len();
    let fates: Vec<(Fate, Known)> = pairs
        .into_par_iter()
        .map(|(pair, graded)| (Fate::of(&pair, graded, known), pair))
        .collect();
    let mut own: Vec<Known> = Vec::new();
    for (fate, pair) in fates {
        match fate {
            Fate::NamedByHalves => counts.named_by_halves += 1,
            Fate::Indistinguishable => counts.indistinguishable += 1,
            Fate::Own => own.push(pair),
        }
    }
    let alike = |pair: &Known| {
        let same = own.iter().filter(|other| other.signature == pair.signature);
        same.count()
    };
    let stored: Vec<Known> = own
        .iter()
        .filter(|pair| alike(pair) <= MOST_GUESSES)
        .cloned()
        .collect();
    counts.indistinguishable += own.len() - stored.len();
    counts.stored = stored.len();
    known.extend(stored);
    counts
}

/// What becomes of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    NamedByHalves,
    Indistinguishable,
    Own,
}

impl Fate {
    fn of(pair: &Known, graded: &Graded, known: &[Known]) -> Fate {
        if !pair.signature.has_core_faults()
            || known
                .iter()
                .any(|one| one.signature.shows_the_same(&pair.signature))
        {
            return Fate::Indistinguishable;
        }
        let diagnosis = diagnose(known, &Signature::of(&graded.result.cases));
        let named = diagnosis.map_or(Vec::new(), |diagnosis| diagnosis.mistakes);
        match pair.mistakes.iter().all(|made| named.contains(made)) {
            true => Fate::NamedByHalves,
            false => Fate::Own,
        }
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Counts {
            listed,
            composed,
            named_by_halves,
            indistinguishable,
            stored,
        } = self;
        write!(
            f,
            "pairs: {composed} of {listed} composed; {named_by_halves} named by what is known of each \
             mistake, {indistinguishable} not to be told from something else, {stored} with a \
             signature of their own"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn corpus() -> Corpus {
        let text = "mistake no_pi: a\n  hint: b\n  half: f / PI ~> f\n\
                    mistake cosine: a\n  hint: b\n  half: return f ~> return cos * f\n\
                    mistake white: a\n  hint: b\n  half: return f / PI ~> return f * 2.0\n  reference: rho ~> WHITE\n\
                    mistake other: a\n  hint: b\n  half: return f / PI ~> return g / PI\n";
        Corpus::of_text(text).expect("it is a list of mistakes")
    }

    #[test]
    fn a_pair_is_composed_of_edits_that_do_not_exclude_each_other() {
        let file = |text: &str| Sources::from([(PathBuf::from("lib.rs"), text.to_string())]);
        let variant = file("return f / PI;");
        let bases = [
            ("half".to_string(), variant.clone()),
            (REFERENCE.to_string(), file("rho")),
        ];
        let of = |pair: [&str; 2]| composed(&corpus(), &bases, &pair.map(str::to_string));
        let pair = of(["no_pi", "cosine"]).expect("both change the variant");
        assert_eq!(pair.name(), "no_pi+cosine on half");
        let made = pair.apply(&variant).expect("it can be applied");
        assert_eq!(made[Path::new("lib.rs")], "return cos * f;");
        assert_eq!(of(["no_pi", "white"]), None);
        // Edits of the same text are merged if they leave a part of it between them as it is.
        let pair = of(["other", "white"]).expect("they change different letters");
        let made = pair.apply(&variant).expect("it can be applied");
        assert_eq!(made[Path::new("lib.rs")], "return g * 2.0;");
    }

    #[test]
    fn every_listed_mistake_is_known() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let workspace = Workspace::above(folder).expect("authoring is in the workspace");
        let course = Course::read(&workspace).expect("the course is sound");
        for Group { task, mistakes } in Group::all(&workspace).expect("the list can be read") {
            let found = course.tasks().find(|of| of.key == task);
            let of_course = found.unwrap_or_else(|| panic!("{task} is no task"));
            let corpus = Corpus::read(&workspace, of_course).expect("the task has mistakes");
            for id in mistakes {
                assert!(corpus.mistake(&id).is_some(), "{task}: {id}");
            }
        }
    }

    #[test]
    fn the_pairs_of_a_task_are_those_of_its_groups() {
        let group = |task: &str, mistakes: &[&str]| Group {
            task: task.into(),
            mistakes: mistakes.iter().map(|id| id.to_string()).collect(),
        };
        let groups = [
            group("part3.task1", &["a", "b", "c"]),
            group("part3.task1", &["c", "b"]),
            group("part3.task2", &["a", "d"]),
        ];
        let pairs: Vec<String> = listed(&groups, "part3.task1")
            .iter()
            .map(|pair| pair.concat())
            .collect();
        assert_eq!(pairs, ["ab", "ac", "bc"]);
    }
}
