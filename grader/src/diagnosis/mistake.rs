//! A known mistake, and what is said of code that makes it.

use crate::signature::Signature;
use serde::Serialize;

/// From this likeness on, the report says that the answers are those of the mistake.
pub(super) const SURE: f64 = 0.95;

/// A known mistake: its names, texts and signature.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Known {
    /// The mistake's names; two for a pair.
    pub mistakes: Vec<String>,
    /// How a sentence such as "your answers equal those of code that ..." ends; one for each mistake.
    pub descriptions: Vec<String>,
    /// Where to look; one for each mistake.
    pub hints: Vec<String>,
    /// The answers that it makes wrong.
    pub signature: Signature,
    /// Whether it is a symptom that many mistakes have: it is only named if every answer agrees.
    pub is_symptom: bool,
}

/// What a student's wrong answers look like.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Diagnosis {
    /// The mistakes' names; several if they cannot be distinguished or are made together.
    pub mistakes: Vec<String>,
    /// The sentence for the student.
    pub says: String,
    /// What the code does, such as "culls back faces".
    pub description: String,
    /// Where to look.
    pub hint: String,
    /// Calls on which the answers agree.
    pub equal: usize,
    /// Calls on which either is wrong.
    pub of: usize,
    /// How certain it is.
    pub certainty: Certainty,
}

impl Diagnosis {
    /// Whether it likely explains the wrong answers.
    pub fn is_likely(&self) -> bool {
        self.certainty == Certainty::Likely
    }
}

/// How certain a diagnosis is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// The answers are those of the mistake, but for a few.
    Likely,
    /// The answers look like those of the mistake, but many of them differ, or a whole case does.
    Perhaps,
}

impl Certainty {
    /// The certainty of a diagnosis that explains this share of the wrong answers. Robust cases
    /// alone make no name likely: correct textbook code fails them, too, in many ways.
    pub(super) fn of(likeness: f64, student: &Signature) -> Certainty {
        match likeness >= SURE && student.has_core_faults() {
            true => Certainty::Likely,
            false => Certainty::Perhaps,
        }
    }

    /// The word with which reports begin a diagnosis.
    pub fn label(self) -> &'static str {
        match self {
            Certainty::Likely => "Likely",
            Certainty::Perhaps => "Perhaps",
        }
    }
}
