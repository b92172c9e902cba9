//! Keys: which side of which case a list of codes describes.

use judge::findings::Aspect;
use serde_json::Value;
use std::fmt;

/// A case, and the side of its answers that the codes describe.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct SignatureKey {
    pub(super) case: String,
    pub(super) side: Side,
}

/// A side of a case's answers.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The case has no answers: the code panicked or did not end.
    Crash,
    /// One aspect of the answers.
    Aspect {
        /// The aspect.
        aspect: Aspect,
        /// The function that gave the answers, where a case calls several.
        function: Option<String>,
        /// The name of the fault, if it has one.
        fault: Option<String>,
    },
}

impl SignatureKey {
    /// The keys of the wrong hits and misses, or samples and `None`s, of the same case and
    /// function. Where these are wrong, no other aspect is judged. None if this is such a key.
    pub(super) fn decisions(&self) -> impl Iterator<Item = SignatureKey> {
        let of = |aspect| SignatureKey {
            case: self.case.clone(),
            side: Side::Aspect {
                aspect,
                function: self.side.function().map(str::to_string),
                fault: None,
            },
        };
        let is_decision = self.side.is_decision();
        let keys = [Aspect::HitOrMiss, Aspect::SampleOrNone].map(of);
        keys.into_iter().filter(move |_| !is_decision)
    }

    /// The key of a crash of the same case.
    pub(super) fn crash(&self) -> SignatureKey {
        SignatureKey {
            case: self.case.clone(),
            side: Side::Crash,
        }
    }

    /// Reads `case aspect`, `case aspect@function`, either of them followed by a space and the
    /// fault's name, or `case crashed`.
    pub(super) fn parse(text: &str) -> Option<SignatureKey> {
        let (case, side) = text.split_once(' ')?;
        let side = if side == CRASHED {
            Side::Crash
        } else {
            let (place, fault) = match side.split_once(' ') {
                Some((place, fault)) => (place, Some(fault.to_string())),
                None => (side, None),
            };
            let (aspect, function) = match place.split_once('@') {
                Some((aspect, function)) => (aspect, Some(function.to_string())),
                None => (place, None),
            };
            Side::Aspect {
                aspect: serde_json::from_value(Value::from(aspect)).ok()?,
                function,
                fault,
            }
        };
        Some(SignatureKey {
            case: case.to_string(),
            side,
        })
    }
}

/// The key of a crash has this word in the place of an aspect.
const CRASHED: &str = "crashed";

impl Side {
    /// The function that gave the answers, if it is known.
    pub(super) fn function(&self) -> Option<&str> {
        match self {
            Side::Crash => None,
            Side::Aspect { function, .. } => function.as_deref(),
        }
    }

    /// Whether this is the side without which no other of the same answer is judged.
    pub(super) fn is_decision(&self) -> bool {
        self.place().is_some_and(|(aspect, _)| aspect.is_decision())
    }

    /// The aspect and the function, without the fault's name.
    pub(super) fn place(&self) -> Option<(Aspect, Option<&str>)> {
        match self {
            Side::Crash => None,
            Side::Aspect {
                aspect, function, ..
            } => Some((*aspect, function.as_deref())),
        }
    }
}

impl fmt::Display for SignatureKey {
    /// As [`SignatureKey::parse`] reads it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.side {
            Side::Crash => write!(f, "{} {CRASHED}", self.case),
            Side::Aspect {
                aspect,
                function,
                fault,
            } => {
                let aspect = serde_json::to_value(aspect).map_err(|_| fmt::Error)?;
                write!(f, "{} {}", self.case, aspect.as_str().unwrap_or_default())?;
                if let Some(function) = function {
                    write!(f, "@{function}")?;
                }
                match fault {
                    Some(fault) => write!(f, " {fault}"),
                    None => Ok(()),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_keys_are_read_back() {
        for text in [
            "one crashed",
            "one geometric_normal",
            "two t@refract",
            "two leaf_size one too many",
            "three pdf@glass_sample of the other side",
        ] {
            let key = SignatureKey::parse(text);
            assert_eq!(key.map(|key| key.to_string()).as_deref(), Some(text));
        }
        assert_eq!(SignatureKey::parse("one"), None);
        assert_eq!(SignatureKey::parse("one colour_of_the_moon"), None);
    }

    #[test]
    fn nothing_else_is_judged_where_a_hit_is_missed_in_the_same_function() {
        let key = |text| SignatureKey::parse(text).expect("it is a key");
        let hit_or_miss = key("one decision@refract");
        let decides = |key: &SignatureKey| key.decisions().any(|key| key == hit_or_miss);
        assert!(decides(&key("one t@refract")));
        assert!(!decides(&key("one t@glass")) && !decides(&hit_or_miss));
        assert_eq!(key("one t").crash(), key("one crashed"));
    }
}
