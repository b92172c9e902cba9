//! Text that somebody handed in: names of students and files, what code prints, messages that quote
//! either.
//!
//! [`shown`] is the only way in which such text is shown. [`Untrusted`] is text that cannot be shown
//! in another way, because it does not implement `Display`.

use formats::{Layout, shown};
use serde::{Deserialize, Serialize};

/// Text that was handed in. It is stored as it is, compared as it is, and shown by [`shown`].
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Untrusted(String);

impl Untrusted {
    /// Marks a text as handed in.
    pub fn new(text: impl Into<String>) -> Untrusted {
        Untrusted(text.into())
    }

    /// The text as it is: to compare it, to hash it, to open a file. Never to show it.
    pub fn raw(&self) -> &str {
        &self.0
    }

    /// The text as a part of one line.
    pub fn line(&self) -> String {
        shown(&self.0, Layout::Line)
    }

    /// The text with its ends of lines.
    pub fn lines(&self) -> String {
        shown(&self.0, Layout::Lines)
    }

    /// Whether there is no text.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl From<String> for Untrusted {
    fn from(text: String) -> Untrusted {
        Untrusted(text)
    }
}

impl From<&str> for Untrusted {
    fn from(text: &str) -> Untrusted {
        Untrusted(text.to_owned())
    }
}

impl PartialEq<str> for Untrusted {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

impl PartialEq<&str> for Untrusted {
    fn eq(&self, other: &&str) -> bool {
        self.0 == *other
    }
}
