//! What never changes in the answers of a student's code: all of them, or a field.

use super::mistake::Place;
use judge::findings::Aspect;
use std::collections::BTreeSet;

/// So many constant fields are named.
const NAMED: usize = 3;

/// What does not change from call to call.
#[derive(Clone, Debug, PartialEq)]
pub enum Constants {
    /// The whole answer.
    Answer {
        /// The answer, as text.
        text: String,
        /// The calls that have it.
        calls: usize,
        /// The failed cases whose answers are all the same, and all failed ones.
        cases: [usize; 2],
    },
    /// Fields of the answers.
    Fields(Vec<ConstantField>),
}

/// A field that is the same number or vector in all answers of the core cases in which it is wrong,
/// where others are expected.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstantField {
    /// The field.
    pub aspect: Aspect,
    /// The function that gives it, if cases call several.
    pub function: Option<&'static str>,
    /// Its numbers.
    pub numbers: Vec<f64>,
    /// How many wrong answers have them, which are all.
    pub wrong: usize,
}

impl Constants {
    /// The fields that never change, if it is not the whole answer.
    pub(super) fn places(&self) -> impl Iterator<Item = Place> {
        let fields = match self {
            Constants::Answer { .. } => &[][..],
            Constants::Fields(fields) => fields,
        };
        let place = |field: &ConstantField| (field.aspect, field.function.map(str::to_owned));
        fields.iter().map(place)
    }

    /// The functions that give them.
    pub(super) fn functions(&self) -> BTreeSet<&'static str> {
        match self {
            Constants::Answer { .. } => BTreeSet::new(),
            Constants::Fields(fields) => fields.iter().filter_map(|it| it.function).collect(),
        }
    }

    /// The sentence, without a full stop.
    pub(super) fn says(&self) -> String {
        match self {
            Constants::Answer {
                text,
                calls,
                cases: [count, of],
            } => format!(
                "your code {SAME_ANSWER}: all {calls} answers in {count} of {of} failed cases are {text}"
            ),
            Constants::Fields(fields) => {
                let named = fields.iter().take(NAMED).map(ConstantField::says);
                let more = match fields.len().saturating_sub(NAMED) {
                    0 => String::new(),
                    more => format!("; {more} more"),
                };
                let named = named.collect::<Vec<_>>().join("; ");
                format!("your code {SAME_FIELD}: {named}{more}")
            }
        }
    }
}

/// What code does whose whole answer never changes.
pub(super) const SAME_ANSWER: &str = "gives the same answer to every call";

/// What code does a field of whose answers never changes.
pub(super) const SAME_FIELD: &str = "gives the same value where other calls need other values";

impl ConstantField {
    fn says(&self) -> String {
        let label = self.aspect.label();
        let of = self
            .function
            .map_or(String::new(), |name| format!(" of {name}"));
        let are = if self.aspect.is_plural() { "are" } else { "is" };
        let numbers: Vec<String> = self.numbers.iter().copied().map(short).collect();
        let value = match &numbers[..] {
            [number] => number.clone(),
            numbers => format!("({})", numbers.join(", ")),
        };
        format!(
            "{label}{of} {are} {value} in all {} wrong answers",
            self.wrong
        )
    }

    /// Whether there is nothing in it: 0, black.
    pub(super) fn is_empty(&self) -> bool {
        self.numbers.iter().all(|number| *number == 0.0)
    }
}

/// A number with four digits.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.3e}").parse().unwrap_or(number);
    // Adding 0 turns -0 into 0.
    format!("{}", rounded + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_few_digits() {
        let of = [0.123456789, -0.0, 1.0, 1234567.0, 1e-9, f64::INFINITY].map(short);
        assert_eq!(of, ["0.1235", "0", "1", "1235000", "0.000000001", "inf"]);
    }
}
