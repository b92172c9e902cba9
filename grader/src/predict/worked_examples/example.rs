//! What a worked example is made of.

use crate::predict::number::is_near;
use kit::PixelSampler;

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

/// Draws small whole numbers.
pub(super) struct Draw(PixelSampler);

impl Draw {
    pub(super) fn of(seed: u64) -> Draw {
        Draw(PixelSampler::new(0, 0, seed))
    }

    /// A whole number from `low` to `high`.
    pub(super) fn from(&mut self, low: i32, high: i32) -> i32 {
        let count = f64::from(high - low + 1);
        low + (self.0.get_sample().x * count) as i32
    }

    /// One of a list.
    pub(super) fn one<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.from(0, list.len() as i32 - 1) as usize]
    }
}

/// A vector of whole numbers or halves as the text has it: `(1, -0.5, 2)`.
pub(super) fn vector(v: [f64; 3]) -> String {
    format!("({}, {}, {})", v[0], v[1], v[2])
}
