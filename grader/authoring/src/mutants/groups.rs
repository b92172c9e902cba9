//! Groups of mutants that give nearly the same wrong answers: one sentence can name them all.

use super::corpus::{Mutant, form_text};
use super::run::{Graded, Kind};
use grader::diagnosis::{Diagnosis, Known, diagnose};
use grader::signature::Signature;
use std::fmt::Write;

/// Mutants whose wrong answers are this alike are one group.
const ALIKE: f64 = 0.95;

/// What many mutants come to.
#[derive(Debug, Default)]
pub struct Groups {
    /// Those that lose no core points.
    survivors: Vec<Mutant>,
    /// How many are surely named.
    named: usize,
    /// The others, those with the most members first.
    unnamed: Vec<Group>,
}

/// Mutants that give nearly the same wrong answers.
#[derive(Debug)]
struct Group {
    members: Vec<Mutant>,
    signature: Signature,
    /// Core points that the first member keeps, as a share.
    kept: f64,
    /// What the diagnosis says of the first member.
    says: String,
}

/// Groups graded mutants by their answers.
pub fn of(graded: Vec<Graded>, known: &[Known]) -> Groups {
    let mut groups = Groups::default();
    for Graded { kind, result, .. } in graded {
        let Kind::Mutant(mutant) = kind else { continue };
        // A variant may lose extra credit without any mistake.
        if result.score >= result.max_score {
            groups.survivors.push(mutant);
            continue;
        }
        let signature = Signature::of(&result.cases);
        let diagnosis = diagnose(known, &signature);
        if diagnosis.as_ref().is_some_and(Diagnosis::is_likely) {
            groups.named += 1;
            continue;
        }
        let alike = groups
            .unnamed
            .iter_mut()
            .find(|group| group.signature.is_alike(&signature, ALIKE));
        match alike {
            Some(group) => group.members.push(mutant),
            None => groups.unnamed.push(Group {
                members: vec![mutant],
                signature,
                kept: result.score / result.max_score,
                says: diagnosis.map_or(String::new(), |diagnosis| diagnosis.says),
            }),
        }
    }
    let size = |group: &Group| std::cmp::Reverse(group.members.len());
    groups.unnamed.sort_by_key(size);
    groups
}

impl Groups {
    /// The groups as entries for `grader/mutants/TASK.txt`, whose names and sentences are still to
    /// be written.
    pub fn to_text(&self, task: &str) -> String {
        let unnamed = self.unnamed.iter().map(|group| group.members.len());
        let mut text = format!(
            "# {task}: {} slips surely named, {} not, in {} groups; {} lose no core points\n",
            self.named,
            unnamed.sum::<usize>(),
            self.unnamed.len(),
            self.survivors.len()
        );
        for mutant in &self.survivors {
            let _ = writeln!(
                text,
                "# full core points on {}: {}",
                mutant.on, mutant.mistakes[0]
            );
        }
        for group in &self.unnamed {
            let _ = writeln!(
                text,
                "\n# {} of core points kept; diagnosis: {}",
                (100.0 * group.kept).round() / 100.0,
                if group.says.is_empty() {
                    "none"
                } else {
                    &group.says
                }
            );
            for member in &group.members {
                let _ = writeln!(text, "# on {}: {}", member.on, member.mistakes[0]);
            }
            let _ = write!(
                text,
                "mistake : \n  hint: \n{}",
                form_text(&group.members[0])
            );
        }
        text
    }
}
