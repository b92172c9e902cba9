//! What a worked example is made of.

use crate::predict::number::is_near;

/// A worked example with other numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct WorkedExample {
    /// What is given, in a few lines.
    pub given: Vec<String>,
    /// What is asked.
    pub asked: Vec<AskedNumber>,
}

/// A number that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedNumber {
    /// What the number is, such as `t`.
    pub name: &'static str,
    /// The right number.
    pub truth: f64,
    /// The numbers that typical mistakes give, with what they are: "t for a direction of length 1".
    pub mistakes: Vec<(f64, &'static str)>,
}

impl AskedNumber {
    pub(super) fn new(
        name: &'static str,
        truth: f64,
        mistakes: &[(f64, &'static str)],
    ) -> AskedNumber {
        let mut known: Vec<(f64, &'static str)> = Vec::new();
        for &(value, what) in mistakes {
            let is_known = known.iter().any(|(other, _)| is_near(value, *other));
            if value.is_finite() && !is_near(value, truth) && !is_known {
                known.push((value, what));
            }
        }
        AskedNumber {
            name,
            truth,
            mistakes: known,
        }
    }

    /// The mistake that gives `typed`, unless that is right.
    pub fn mistake(&self, typed: f64) -> Option<&'static str> {
        let same = self
            .mistakes
            .iter()
            .find(|(value, _)| is_near(typed, *value));
        same.map(|(_, what)| *what)
    }
}

/// A number of tenths.
pub(super) fn tenths(count: i32) -> f64 {
    f64::from(count) / 10.0
}

/// A vector of whole numbers or halves as the text has it: `(1, -0.5, 2)`.
pub(super) fn vector(v: [f64; 3]) -> String {
    format!("({}, {}, {})", v[0], v[1], v[2])
}
