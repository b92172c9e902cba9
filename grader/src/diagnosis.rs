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

/// A mistake is made only if this share of what it gets wrong is wrong for the student too.
const MADE: f64 = 0.75;

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
    let (equal, of) = student.calls_alike(&best.signature);
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
        equal,
        of,
    })
}

/// Two mistakes that together explain what neither explains alone.
fn two_at_once(known: &[Known], student: &Signature, alone: f64) -> Option<Diagnosis> {
    let first = explains_most(known, student, student)?;
    let rest = student.without(&first.signature);
    let second = explains_most(known, student, &rest)?;
    if first.mistakes == second.mistakes {
        return None;
    }
    let equal = student.agreement(&first.signature).equal + rest.agreement(&second.signature).equal;
    let of = student.wrong();
    let share = equal as f64 / of.max(1) as f64;
    (share >= TOGETHER && share > alone).then(|| Diagnosis {
        mistakes: [&first.mistakes[..], &second.mistakes[..]].concat(),
        says: format!(
            "two mistakes at once: your answers look like those of code that {}, and that {}: together they explain {equal} of {of} wrong values",
            first.says.join(", and "),
            second.says.join(", and "),
        ),
        hint: [&first.hints[..], &second.hints[..]].concat().join(" "),
        equal,
        of,
    })
}

/// The single mistake all of whose wrong values are wrong for the student too (or hidden by another mistake), and which
/// explains most of `rest`.
fn explains_most<'a>(
    known: &'a [Known],
    student: &Signature,
    rest: &Signature,
) -> Option<&'a Known> {
    let singles = known.iter().filter(|known| known.mistakes.len() == 1);
    let candidates = singles.filter_map(|known| {
        let with_student = student.agreement(&known.signature);
        let explained = rest.agreement(&known.signature).equal;
        let is_made = with_student.both as f64 >= MADE * with_student.second as f64;
        (is_made && explained > 0).then_some((known, explained))
    });
    candidates
        .max_by_key(|(_, explained)| *explained)
        .map(|(known, _)| known)
}
