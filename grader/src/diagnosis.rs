//! Diagnosis: which typical mistake a student's wrong answers look like.
//!
//! `golden/signatures/<task>.json` holds the signature of each known mistake, made by `grader mutants --bless` from
//! the mutants. A student's signature is compared with all of them.

use crate::error::GraderError;
use crate::signature::{Agreement, Signature};
use crate::workspace::Workspace;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What is known of one mistake.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Known {
    /// The mistake's names; two for a pair.
    pub mistakes: Vec<String>,
    /// How the sentence "your answers equal those of code that ..." ends; one for each mistake.
    pub says: Vec<String>,
    /// Where to look; one for each mistake.
    pub hints: Vec<String>,
    /// What it gets wrong.
    pub signature: Signature,
}

/// What a student's wrong answers look like.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Diagnosis {
    /// The mistakes' names; several if they cannot be told apart or are made together.
    pub mistakes: Vec<String>,
    /// The sentence for the student.
    pub says: String,
    /// Where to look.
    pub hint: String,
    /// Calls on which the answers agree.
    pub equal: usize,
    /// Calls on which either is wrong.
    pub of: usize,
}

/// From this likeness on, the mistake is named as what it is.
const SURE: f64 = 0.95;

/// From this likeness on, the mistake is named as what it looks like.
const LIKELY: f64 = 0.6;

/// Two mistakes together must explain this share of the wrong calls.
const TOGETHER: f64 = 0.9;

/// The known mistakes of a task; none if nothing is stored for it.
pub fn known(workspace: &Workspace, task: &str) -> Result<Vec<Known>, GraderError> {
    let path = file(workspace, task);
    if !path.is_file() {
        return Ok(Vec::new());
    }
    let text = std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
    serde_json::from_str(&text).map_err(|e| GraderError::file("understand", &path, e))
}

/// Where the signatures of a task are stored.
pub fn file(workspace: &Workspace, task: &str) -> PathBuf {
    workspace
        .root()
        .join("golden/signatures")
        .join(format!("{task}.json"))
}

/// What `student` looks like, if it looks like anything known.
pub fn diagnose(known: &[Known], student: &Signature) -> Option<Diagnosis> {
    let mut ranked: Vec<(&Known, Agreement)> = known
        .iter()
        .map(|known| (known, student.agreement(&known.signature)))
        .collect();
    ranked.sort_by(|a, b| b.1.likeness().total_cmp(&a.1.likeness()));
    let &(best, agreement) = ranked.first()?;
    let likeness = agreement.likeness();
    if likeness < SURE
        && let Some(pair) = two_at_once(known, student, likeness)
    {
        return Some(pair);
    }
    if likeness < LIKELY {
        return None;
    }
    let mut mistakes = best.mistakes.clone();
    let mut says = best.says.join(", and ");
    for (twin, theirs) in &ranked[1..] {
        let same = *theirs == agreement
            && twin.mistakes.len() == 1
            && !mistakes.contains(&twin.mistakes[0]);
        if same && best.signature == twin.signature {
            mistakes.extend(twin.mistakes.iter().cloned());
            says = format!("{says}; or of code that {}", twin.says.join(", and "));
        }
    }
    let of = agreement.first + agreement.second - agreement.both;
    let verb = if likeness >= SURE {
        "equal"
    } else {
        "look most like"
    };
    Some(Diagnosis {
        mistakes,
        says: format!(
            "your answers {verb} those of code that {says}: on {} of {of} calls",
            agreement.equal
        ),
        hint: best.hints.join(" "),
        equal: agreement.equal,
        of,
    })
}

/// Two mistakes that together explain what neither explains alone.
fn two_at_once(known: &[Known], student: &Signature, alone: f64) -> Option<Diagnosis> {
    let first = explains_most(known, student)?;
    let rest = student.without(&first.signature);
    let second = explains_most(known, &rest)?;
    if first.mistakes == second.mistakes {
        return None;
    }
    // A call on which both are wrong may be wrong in a third way: it counts as explained by either.
    let explained = |known: &Known, of: &Signature| of.agreement(&known.signature).equal;
    let both = student.agreement(&first.signature).both;
    let equal = both + explained(second, &rest);
    let share = equal as f64 / student.wrong().max(1) as f64;
    (share >= TOGETHER && share > alone).then(|| Diagnosis {
        mistakes: [&first.mistakes[..], &second.mistakes[..]].concat(),
        says: format!(
            "two mistakes at once: your answers look like those of code that {}, and that {}: together on {equal} of {} calls",
            first.says.join(", and "),
            second.says.join(", and "),
            student.wrong()
        ),
        hint: [&first.hints[..], &second.hints[..]].concat().join(" "),
        equal,
        of: student.wrong(),
    })
}

/// The single mistake whose wrong calls are nearly all wrong for the student too, and which explains most.
fn explains_most<'a>(known: &'a [Known], student: &Signature) -> Option<&'a Known> {
    let singles = known.iter().filter(|known| known.mistakes.len() == 1);
    let candidates = singles.map(|known| (known, student.agreement(&known.signature)));
    candidates
        .filter(|(_, a)| a.equal > 0 && a.both as f64 >= TOGETHER * a.second as f64)
        .max_by_key(|(_, a)| a.equal)
        .map(|(known, _)| known)
}
