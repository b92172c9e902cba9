//! The table of the results of every mutant in every case, and its checks.

use super::run::{Graded, Kind};
use base::{GraderError, Workspace, write_whole};
use grader::course::Task;
use grader::course::packed::binary;
use grader::diagnosis::{Known, diagnose};
use grader::score::{CaseResult, TaskResult};
use grader::signature::Signature;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

/// How the grader scored each mutant and variant of a task. Stored as `golden/mutants/TASK.bin`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// For each mutant the cases in which it earns less than the correct code that it is made from.
    pub mutants: BTreeMap<String, Vec<String>>,
    /// For each correct version that kept every core point, the robust points that it lost.
    pub correct: BTreeMap<String, f64>,
    /// The correct versions that lost core points: each is a defect of the grader.
    pub accused: Vec<String>,
    /// For each mutant the mistakes that the diagnosis names.
    pub diagnosed: BTreeMap<String, Vec<String>>,
    /// The number of held-out mutants whose diagnosis names all their mistakes, and the number of
    /// all held-out mutants.
    pub recognised: (usize, usize),
}

impl Table {
    /// Where the table of a task is stored.
    fn file(workspace: &Workspace, task: &str) -> PathBuf {
        let file = format!("golden/mutants/{task}.bin");
        workspace.root().join(file)
    }

    /// The stored table of a task.
    pub fn read(workspace: &Workspace, task: &str) -> Result<Table, GraderError> {
        let path = Table::file(workspace, task);
        let bytes = std::fs::read(&path).map_err(|e| GraderError::file("read", &path, e))?;
        binary::from_bytes(&bytes).map_err(|why| {
            let why = format!(
                "it is damaged: {why}. Restore it with `git checkout`, or make it with \
                 `cargo grader mutants {task} --bless`"
            );
            GraderError::file("understand", &path, why)
        })
    }

    /// Stores the table of a task.
    pub fn store(&self, workspace: &Workspace, task: &str) -> Result<(), GraderError> {
        let path = Table::file(workspace, task);
        let folder = path.parent().unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder).map_err(|e| GraderError::file("make", folder, e))?;
        let bytes = binary::to_bytes(self).map_err(|why| GraderError::file("write", &path, why))?;
        write_whole(&path, &bytes)
    }

    /// In which versions this table differs from another, by name.
    pub fn differences(&self, other: &Table) -> Vec<String> {
        let differing = |a: Option<String>, b: Option<String>| a != b;
        let mutants: BTreeSet<&String> = self.mutants.keys().chain(other.mutants.keys()).collect();
        let correct: BTreeSet<&String> = self.correct.keys().chain(other.correct.keys()).collect();
        let of_mutant = |table: &Table, name: &String| {
            let found = (table.mutants.get(name)?, table.diagnosed.get(name)?);
            Some(format!("{found:?}"))
        };
        let of_correct = |table: &Table, name: &String| Some(table.correct.get(name)?.to_string());
        let mutants = mutants
            .into_iter()
            .filter(|name| differing(of_mutant(self, name), of_mutant(other, name)));
        let correct = correct
            .into_iter()
            .filter(|name| differing(of_correct(self, name), of_correct(other, name)));
        mutants.chain(correct).cloned().collect()
    }

    /// The table of what was graded.
    pub fn of(graded: &[Graded], known: &[Known]) -> Table {
        let mut table = Table::default();
        let of_version = |name: &str| {
            let correct = graded
                .iter()
                .find(|graded| matches!(graded.kind, Kind::Correct) && graded.name == name);
            correct.map(|graded| &graded.result.cases)
        };
        for graded in graded {
            let Kind::Mutant(mutant) = &graded.kind else {
                let lost = graded.result.robust_max_score - graded.result.robust_score;
                let most = table.correct.entry(graded.name.clone()).or_default();
                *most = most.max(lost);
                if graded.is_marked_down() && !table.accused.contains(&graded.name) {
                    table.accused.push(graded.name.clone());
                }
                continue;
            };
            let base = of_version(&mutant.on);
            let earns_less = |case: &&CaseResult| {
                let base = base.and_then(|base| base.iter().find(|other| other.name == case.name));
                case.score < base.map_or(case.max_score, |base| base.score)
            };
            let lost = graded.result.cases.iter().filter(earns_less);
            table.mutants.insert(
                graded.name.clone(),
                lost.map(|case| case.name.clone()).collect(),
            );
            let mut named = diagnose(known, &Signature::of(&graded.result.cases))
                .map(|d| d.mistakes)
                .unwrap_or_default();
            // Names that cannot be distinguished have no order.
            named.sort_unstable();
            if mutant.held_out {
                table.recognised.1 += 1;
                table.recognised.0 += usize::from(
                    mutant
                        .mistakes
                        .iter()
                        .all(|mistake| named.contains(mistake)),
                );
            }
            table.diagnosed.insert(graded.name.clone(), named);
        }
        table
    }

    /// Mutants that lose no points.
    pub fn survivors(&self) -> Vec<&str> {
        self.mutants
            .iter()
            .filter(|(_, failed)| failed.is_empty())
            .map(|(name, _)| name.as_str())
            .collect()
    }

    /// Mutants whose diagnosis names no mistake that they make.
    pub fn misnamed(&self) -> Vec<(&str, &[String])> {
        self.diagnosed
            .iter()
            .filter(|(name, named)| {
                let made = name.split(" on ").next().unwrap_or_default();
                !made
                    .split('+')
                    .all(|mistake| named.iter().any(|name| name == mistake))
            })
            .map(|(name, named)| (name.as_str(), named.as_slice()))
            .collect()
    }
}

/// The mutants that earn more than the correct code that they are made from: their names, their points
/// and those of the correct code, core and extra together. Then a case rewards a mistake.
pub fn rewarded(graded: &[Graded]) -> Vec<(&str, [f64; 2])> {
    let points = |graded: &Graded| graded.result.score + graded.result.robust_score;
    let correct: BTreeMap<&str, f64> = graded
        .iter()
        .filter(|graded| matches!(graded.kind, Kind::Correct))
        .map(|graded| (graded.name.as_str(), points(graded)))
        .collect();
    let rewarded = graded.iter().filter_map(|graded| {
        let Kind::Mutant(mutant) = &graded.kind else {
            return None;
        };
        // Code that is not an edit of a version is compared with the reference, which earns all.
        let base = *correct.get(mutant.on.as_str())?;
        let earned = points(graded);
        (earned > base).then_some((graded.name.as_str(), [earned, base]))
    });
    rewarded.collect()
}

/// The versions that would earn more if their code crashed in one or two cases, with the names of the
/// cases: crashing must not pay.
pub fn crashing_pays(task: &Task, graded: &[Graded]) -> Vec<(String, String)> {
    let names: Vec<&str> = task.cases.iter().map(|entry| entry.name.as_str()).collect();
    let pairs = || (0..names.len()).flat_map(|i| (i..names.len()).map(move |j| [i, j]));
    let points = |result: &TaskResult| result.score + result.robust_score;
    let pays = graded.iter().filter_map(|graded| {
        let without = graded.result.with_crashes(task, |_| false);
        let crashed = pairs().map(|pair| pair.map(|i| names[i])).find(|crashed| {
            let with = without.with_crashes(task, |case| crashed.contains(&case));
            points(&with) > points(&without) + 1e-9
        })?;
        Some((graded.name.clone(), crashed.join(" and ")))
    });
    pays.collect()
}

/// A line for each version: the points that correct code loses, the cases in which a mutant does,
/// and the mistakes that it is named as.
impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, lost) in &self.correct {
            writeln!(f, "correct | {name} | loses {lost} robust points")?;
        }
        for name in &self.accused {
            writeln!(f, "correct | {name} | loses core points")?;
        }
        for (name, failed) in &self.mutants {
            let named = self.diagnosed.get(name).map_or(&[][..], Vec::as_slice);
            let (failed, named) = (failed.join(" "), named.join(" "));
            writeln!(f, "mutant | {name} | {failed} | {named}")?;
        }
        let (recognised, held_out) = self.recognised;
        writeln!(f, "held out | {recognised} of {held_out} recognised")
    }
}
