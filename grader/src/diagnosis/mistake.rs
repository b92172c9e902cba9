//! A known mistake, and what is said of code that makes it.

use super::constant_values::Constants;
use crate::signature::{Evidence, Signature};
use judge::findings::Aspect;
use serde::Serialize;
use std::collections::BTreeSet;

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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
    /// What the sentence says of the answers.
    #[serde(skip)]
    pub claim: Claim,
    /// Where it explains wrong answers: their fields, and the functions that gave them.
    #[serde(skip)]
    pub places: BTreeSet<Place>,
}

/// A field of the answers of a function, if cases call several.
pub type Place = (Aspect, Option<String>);

impl Diagnosis {
    /// Whether it likely explains the wrong answers.
    pub fn is_likely(&self) -> bool {
        self.certainty == Certainty::Likely
    }

    /// Whether it explains wrong answers in this field, given by this function if it is known.
    pub(crate) fn explains(&self, aspect: Aspect, function: Option<&str>) -> bool {
        let mut of_field = self.places.iter().filter(|(field, _)| *field == aspect);
        of_field.any(|(_, place)| {
            let functions = place.as_deref().zip(function);
            functions.is_none_or(|(place, own)| place == own)
        })
    }

    /// Whether the answers are those of the known mistake, each of them.
    pub(super) fn is_exact(&self) -> bool {
        let is_exact = self.claim == Claim::Alike(Evidence::Exact);
        self.is_likely() && is_exact && self.equal == self.of
    }
}

/// What a diagnosis says of the answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Claim {
    /// They are like those of the mistake.
    Alike(Evidence),
    /// They look most like those of the mistake.
    #[default]
    MostAlike,
    /// Of two mistakes, each explains so many of the wrong values.
    Pair([usize; 2]),
    /// The mistake explains some of the wrong values, and not the rest.
    OneOfSeveral(Evidence),
    /// They do not change from call to call.
    Constant(Constants),
}

/// How certain a diagnosis is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// The answers are those of the mistake, but for a few.
    Likely,
    /// The answers look like those of the mistake, but many of them differ, or a whole case does.
    #[default]
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

    /// The words with which reports begin the hint: where the mistake may not be made, it is a
    /// condition.
    pub fn before_hint(self) -> &'static str {
        match self {
            Certainty::Likely => "Hint",
            Certainty::Perhaps => "If so",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_explains_its_fields_in_its_functions() {
        let places = [
            (Aspect::Normal, None),
            (Aspect::T, Some("test_triangle".into())),
        ];
        let mistake = Diagnosis {
            places: places.into(),
            ..Diagnosis::default()
        };
        assert!(mistake.explains(Aspect::Normal, Some("record_triangle")));
        assert!(mistake.explains(Aspect::T, Some("test_triangle")));
        assert!(mistake.explains(Aspect::T, None));
        assert!(!mistake.explains(Aspect::T, Some("intersect_triangle")));
        assert!(!mistake.explains(Aspect::HitOrMiss, None));
    }
}
