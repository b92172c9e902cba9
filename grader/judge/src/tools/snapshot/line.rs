//! One line of a snapshot.

use std::fmt;

/// The question and the answer of one call.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// The number of the call in its case.
    pub call: u32,
    /// Fields of the question; empty on short lines.
    pub question: Vec<(String, Value)>,
    /// Fields of the answer; none for a miss.
    pub answer: Vec<(String, Value)>,
}

/// A value: numbers, and their brackets. Two values are equal if they have the same bits, so NaN
/// equals itself.
#[derive(Clone, Debug)]
pub enum Value {
    /// One number.
    Number(f64),
    /// `(x,y,z)`.
    Vector(Vec<f64>),
    /// `[a,b]`.
    Range(f64, f64),
}

/// The text of an answer without fields.
pub(super) const MISS: &str = "miss";

impl Line {
    /// All fields: those of the question, then those of the answer.
    pub fn fields(&self) -> impl Iterator<Item = &(String, Value)> {
        self.question.iter().chain(&self.answer)
    }

    /// The field `name` of the answer.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.answer
            .iter()
            .find(|(field, _)| field == name)
            .map(|(_, value)| value)
    }

    /// The field `name` of the answer as one number.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Whether the answer is a miss.
    pub fn is_miss(&self) -> bool {
        self.answer.is_empty()
    }
}

impl PartialEq for Value {
    fn eq(&self, other: &Value) -> bool {
        let bits = |value: &Value| -> Vec<u64> {
            let numbers = value.numbers().into_iter();
            numbers.map(f64::to_bits).collect()
        };
        std::mem::discriminant(self) == std::mem::discriminant(other) && bits(self) == bits(other)
    }
}

impl Value {
    /// The numbers of the value.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Value::Number(number) => vec![*number],
            Value::Vector(numbers) => numbers.clone(),
            Value::Range(min, max) => vec![*min, *max],
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Number(number) => write!(f, "{}", shortest(*number)),
            Value::Vector(numbers) => {
                let numbers: Vec<String> = numbers.iter().copied().map(shortest).collect();
                write!(f, "({})", numbers.join(","))
            }
            Value::Range(min, max) => write!(f, "[{},{}]", shortest(*min), shortest(*max)),
        }
    }
}

/// The shortest text that reads back to the same float.
fn shortest(number: f64) -> String {
    let text = format!("{number:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_string)
}

impl Line {
    /// The question, as text.
    pub fn asked(&self) -> String {
        let fields: Vec<String> = self
            .question
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        fields.join(" ")
    }
}

impl Line {
    /// The answer, as text.
    pub fn answer_text(&self) -> String {
        if self.is_miss() {
            return MISS.into();
        }
        let fields: Vec<String> = self
            .answer
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        fields.join(" ")
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.call)?;
        for (name, value) in &self.question {
            write!(f, " {name}={value}")?;
        }
        write!(f, " -> {}", self.answer_text())
    }
}
