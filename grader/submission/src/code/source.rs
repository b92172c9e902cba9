//! The code of one stage, as it is compared: all its files one after the other.

use super::passages::{Known, Text};
use super::tokens::{self, Token};
use crate::Untrusted;
use files::file_tree::Files;
use std::ops::Range;

/// The most characters of a passage that are shown, some hundred lines. A line may be as long as
/// its file, and every passage of the line would repeat it.
const MOST_SHOWN: usize = 6_000;

/// The code of a stage that one student handed in.
#[derive(Clone, Debug, Default)]
pub struct Source {
    files: Vec<File>,
    /// Their tokens.
    pub text: Text,
}

#[derive(Clone, Debug)]
struct File {
    path: Untrusted,
    text: String,
    /// The number of its first token.
    first: usize,
}

/// A passage as it stands in one student's code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The file, below `src/`.
    pub path: Untrusted,
    /// Its lines, counted from 1.
    pub lines: Range<usize>,
    /// Their text; of a long one the beginning.
    pub text: Untrusted,
}

impl Source {
    /// The code in `files`, without what is `known`. Files that are no Rust are left out: nothing of
    /// them compiles.
    pub fn new(files: &Files, known: &Known) -> Source {
        let mut all: Vec<Token> = Vec::new();
        let mut kept = Vec::new();
        for (path, bytes) in files {
            let text = String::from_utf8_lossy(bytes).into_owned();
            let Some(tokens) = tokens::of(&text) else {
                continue;
            };
            kept.push(File {
                path: path.to_string_lossy().into_owned().into(),
                text,
                first: all.len(),
            });
            all.extend(tokens);
            all.push(Token::END_OF_FILE);
        }
        // A class has a thousand of them.
        all.shrink_to_fit();
        Source {
            files: kept,
            text: Text::new(all, known),
        }
    }

    /// The passage of `length` tokens from the token `start` on.
    pub fn excerpt(&self, start: usize, length: usize) -> Excerpt {
        let after = self.files.partition_point(|file| file.first <= start);
        let file = &self.files[after.saturating_sub(1)];
        let lines = self.text.lines(start, length);
        let shown = file.text.lines().skip(lines.start.saturating_sub(1));
        Excerpt {
            path: file.path.clone(),
            text: beginning(shown.take(lines.len())).into(),
            lines,
        }
    }
}

/// The lines, at most [`MOST_SHOWN`] characters of them.
fn beginning<'a>(lines: impl Iterator<Item = &'a str>) -> String {
    let mut text = String::new();
    let mut left = MOST_SHOWN;
    for line in lines {
        let shown: String = line.chars().take(left).collect();
        text += &shown;
        left -= shown.chars().count();
        if left == 0 || shown.len() < line.len() {
            return text + " ...";
        }
        text.push('\n');
        left -= 1;
    }
    text.pop();
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_long_passage_the_beginning_is_shown() {
        let short = ["fn f() {", "}"];
        assert_eq!(beginning(short.into_iter()), "fn f() {\n}");
        let long = "ä".repeat(MOST_SHOWN);
        assert_eq!(
            beginning([long.as_str()].into_iter()),
            long.clone() + " ..."
        );
        assert_eq!(
            beginning(["a", &long].into_iter()).chars().count(),
            MOST_SHOWN + 4
        );
        let lines = vec!["a"; MOST_SHOWN];
        assert_eq!(beginning(lines.into_iter()).chars().count(), MOST_SHOWN + 4);
    }
}
