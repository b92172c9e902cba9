//! What is said about a wrong answer.

use serde::{Serialize, Serializer};
use std::fmt;

/// What is said about a wrong answer, part by part: readers shorten it without reading it.
///
/// ```
/// use judge::findings::Message;
/// let message = Message::new("your result: t = 2.5; expected: 2".into())
///     .compares([2.5], [2.0])
///     .asked("Ray: o = (0, 0, 0)".into());
/// assert_eq!(message.compared, [[2.5, 2.0]]);
/// assert_eq!(message.to_string(), "your result: t = 2.5; expected: 2. Ray: o = (0, 0, 0)");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Message {
    /// The code's result and the expected one.
    pub result: String,
    /// Why this is expected, as the end of the sentence.
    pub reason: String,
    /// What the function was called with; empty if it is not repeated.
    pub question: String,
    /// The numbers of the result, each with the expected one.
    pub compared: Vec<[f64; 2]>,
    /// Whether these are numbers of something else than what is called wrong.
    pub are_beside: bool,
}

impl Message {
    /// A message without a question.
    pub fn new(result: String) -> Message {
        Message {
            result,
            ..Message::default()
        }
    }

    /// Adds numbers of the result, and those that are expected in their places.
    pub fn compares(
        mut self,
        yours: impl IntoIterator<Item = f64>,
        expected: impl IntoIterator<Item = f64>,
    ) -> Message {
        let pairs = yours.into_iter().zip(expected);
        self.compared.extend(pairs.map(|(a, b)| [a, b]));
        self
    }

    /// Adds numbers as [`Message::compares`], of something else than what is called wrong, such as
    /// the end of a ray where the sum over rays is.
    pub fn compares_beside(self, yours: f64, expected: f64) -> Message {
        Message {
            are_beside: true,
            ..self.compares([yours], [expected])
        }
    }

    /// Adds why something else is expected: it ends the sentence.
    pub fn because(self, reason: String) -> Message {
        Message { reason, ..self }
    }

    /// Adds what the function was called with.
    pub fn asked(self, question: String) -> Message {
        Message { question, ..self }
    }

    /// The numbers that are farthest apart, the code's first; `None` if all are equal.
    pub fn farthest_apart(&self) -> Option<[f64; 2]> {
        let off = |[yours, expected]: [f64; 2]| match (yours - expected).abs() {
            off if off.is_nan() => f64::INFINITY,
            off => off,
        };
        let compared = self.compared.iter().copied();
        let different = compared.filter(|[yours, expected]| yours != expected);
        different.max_by(|a, b| off(*a).total_cmp(&off(*b)))
    }
}

impl From<String> for Message {
    fn from(result: String) -> Message {
        Message::new(result)
    }
}

impl From<&str> for Message {
    fn from(result: &str) -> Message {
        Message::new(result.into())
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.result, self.reason)?;
        let end = match self.result.ends_with('?') {
            true => "",
            false => ".",
        };
        match self.question.is_empty() {
            true => Ok(()),
            false => write!(f, "{end} {}", self.question),
        }
    }
}

impl Serialize for Message {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Two numbers with as many decimals as show that they differ, at least so many.
pub(crate) fn told_apart(yours: f64, expected: f64, decimals: usize) -> [String; 2] {
    let with = |decimals: usize| [yours, expected].map(|x| format!("{x:.decimals$}"));
    let mut texts = (decimals..MOST_DECIMALS).map(with);
    let different = texts.find(|[yours, expected]| yours != expected);
    let [a, b] = different.unwrap_or_else(|| with(decimals));
    // Of 0 there are no decimals.
    [(yours, a), (expected, b)].map(|(x, text)| if x == 0.0 { "0".into() } else { text })
}

/// More decimals of a number near 1 are not stored.
const MOST_DECIMALS: usize = 17;

#[cfg(test)]
mod tests {
    use super::told_apart;

    #[test]
    fn a_zero_has_no_decimals_and_no_sign() {
        assert_eq!(told_apart(-0.0, 0.75, 5), ["0", "0.75000"]);
        assert_eq!(told_apart(0.0, 1e-9, 5), ["0", "0.000000001"]);
    }
}
