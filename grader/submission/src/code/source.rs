//! The code of one stage, as it is compared: all its files one after the other.

use super::passages::{Known, Text};
use super::tokens::{self, Token};
use crate::Untrusted;
use crate::file_tree::Files;
use std::ops::Range;

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
    /// Their text.
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
        let shown: Vec<&str> = shown.take(lines.len()).collect();
        Excerpt {
            path: file.path.clone(),
            text: shown.join("\n").into(),
            lines,
        }
    }
}
