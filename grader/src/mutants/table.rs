//! The table mutant × case, and what is wrong with it.

use super::run::{Graded, Kind};
use crate::diagnosis::{Known, diagnose};
use crate::score::Status;
use crate::signature::Signature;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What the grader made of each mutant and variant of a task. Stored as `golden/mutants/<task>.json`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// For each mutant the cases that it lost points in.
    pub mutants: BTreeMap<String, Vec<String>>,
    /// The correct versions that kept every core point, and the robust points each lost.
    pub correct: BTreeMap<String, f64>,
    /// For each mutant the mistakes that the diagnosis names.
    pub diagnosed: BTreeMap<String, Vec<String>>,
    /// Held-out mutants whose diagnosis names a mistake that they make, and how many there are.
    pub recognised: (usize, usize),
}

impl Table {
    /// The table of what was graded.
    pub fn of(graded: &[Graded], known: &[Known]) -> Table {
        let mut table = Table::default();
        for graded in graded {
            let Kind::Mutant(mutant) = &graded.kind else {
                let lost = graded.result.robust_max_score - graded.result.robust_score;
                let most = table.correct.entry(graded.name.clone()).or_default();
                *most = most.max(lost);
                continue;
            };
            let failed = graded
                .result
                .cases
                .iter()
                .filter(|case| case.status != Status::Passed);
            table.mutants.insert(
                graded.name.clone(),
                failed.map(|case| case.name.clone()).collect(),
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
