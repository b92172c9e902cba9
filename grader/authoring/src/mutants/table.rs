//! The table mutant × case, and what is wrong with it.

use super::run::{Graded, Kind};
use grader::diagnosis::{Known, diagnose};
use grader::error::GraderError;
use grader::score::CaseResult;
use grader::signature::Signature;
use grader::workspace::Workspace;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// What the grader made of each mutant and variant of a task. Stored as `golden/mutants/<task>.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// For each mutant the cases in which it earns less than the correct code that it is made from.
    pub mutants: BTreeMap<String, Vec<String>>,
    /// The correct versions that kept every core point, and the robust points each lost.
    pub correct: BTreeMap<String, f64>,
    /// Those of them that lost a core point after all: each is a defect of the grader.
    #[serde(default)]
    pub accused: Vec<String>,
    /// For each mutant the mistakes that the diagnosis names.
    pub diagnosed: BTreeMap<String, Vec<String>>,
    /// Held-out mutants whose diagnosis names a mistake that they make, and how many there are.
    pub recognised: (usize, usize),
}

impl Table {
    /// Where the table of a task is stored.
    pub fn file(workspace: &Workspace, task: &str) -> PathBuf {
        workspace
            .root()
            .join("golden/mutants")
            .join(format!("{task}.json"))
    }

    /// The stored table of a task.
    pub fn read(workspace: &Workspace, task: &str) -> Result<Table, GraderError> {
        let path = Table::file(workspace, task);
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        serde_json::from_str(&text).map_err(|e| GraderError::file("understand", &path, e))
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
            let named = diagnose(known, &Signature::of(&graded.result.cases))
                .map(|d| d.mistakes)
                .unwrap_or_default();
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
