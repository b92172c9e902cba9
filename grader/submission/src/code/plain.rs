//! Tokens without what may be added or left out while the program stays the same.

use super::tokens::{self, Token};
use std::ops::Range;

/// A run of plain tokens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// A hash of their forms.
    pub hash: u64,
    /// The lines that they stand in, counted from 1.
    pub lines: Range<usize>,
}

/// All runs of `length` plain tokens of a text, in its order; none of what is no Rust.
pub fn runs(text: &[u8], length: usize) -> Vec<Run> {
    let tokens = plain(&tokens::of(&String::from_utf8_lossy(text)).unwrap_or_default());
    let runs = tokens.windows(length).map(|run| Run {
        hash: tokens::hash(run.iter().map(|token| token.form)),
        lines: run[0].line..run[length - 1].line + 1,
    });
    runs.collect()
}

/// `tokens` without braces, commas, semicolons, brackets that only group, visibilities, types of
/// `let`, and all but the last part of each path.
fn plain(tokens: &[Token]) -> Vec<Token> {
    let is = |i: usize, text: &str| tokens.get(i).is_some_and(|token| token.is(text));
    let is_name = |i: usize| tokens.get(i).is_some_and(Token::is_name);
    let mut kept = Vec::with_capacity(tokens.len());
    // Whether each open bracket is one of a call.
    let mut calls = Vec::new();
    let mut i = 0;
    while let Some(token) = tokens.get(i) {
        let is_prefix = (is_name(i) || is(i, "self")) && is(i + 1, ":") && is(i + 2, ":");
        if is_prefix && is_name(i + 3) {
            i += 3;
            continue;
        }
        if is(i, "pub") {
            i += if is(i + 1, "(") { 4 } else { 1 };
            continue;
        }
        let is_kept = if is(i, "(") {
            calls.push(i > 0 && is_name(i - 1));
            calls.last() == Some(&true)
        } else if is(i, ")") {
            calls.pop() == Some(true)
        } else {
            !DROPPED.iter().any(|text| is(i, text))
        };
        kept.extend(is_kept.then_some(*token));
        i += 1;
        let name = if is(i, "mut") { i + 1 } else { i };
        if token.is("let") && is_name(name) && is(name + 1, ":") {
            kept.push(tokens[name]);
            i = name + 1;
            while i < tokens.len() && !is(i, "=") && !is(i, ";") {
                i += 1;
            }
        }
    }
    kept
}

/// What stands between the words that decide.
const DROPPED: [&str; 7] = ["{", "}", ";", ",", "mut", "return", "where"];

#[cfg(test)]
mod tests {
    use super::*;

    fn hashes(text: &str) -> Vec<u64> {
        let runs = runs(text.as_bytes(), 8).into_iter();
        runs.map(|run| run.hash).collect()
    }

    #[test]
    fn what_changes_no_program_changes_no_run() {
        let text = "fn f(&self, a: f64) -> Option<f64> {
            let b = self.scale * a;
            if b < 2.0 { return None; }
            Some(b + f64::from(self.n))
        }";
        let other = "pub(crate) fn f(&self, a: core::primitive::f64,) -> Option<f64> {;
            let mut b: f64 = ((self).scale * a);;
            if (b < (2.0)) {{ None }} else
            { Option::Some((b) + core::primitive::f64::from((self).n)) }
        }";
        assert_eq!(hashes(text), hashes(&other.replace("else", "")));
        assert!(hashes(text).len() > 20);
        for change in [
            ("b < 2.0", "b > 2.0"),
            ("let b", "let [b]"),
            ("from(", "from.of("),
        ] {
            assert_ne!(
                hashes(text),
                hashes(&text.replace(change.0, change.1)),
                "{change:?}"
            );
        }
        assert_eq!(runs(b"fn f( {", 8), []);
    }

    #[test]
    fn a_run_has_the_lines_that_it_stands_in() {
        let runs = runs(b"\n;\na b {\n} c\n", 3);
        let lines: Vec<Range<usize>> = runs.into_iter().map(|run| run.lines).collect();
        assert_eq!(lines, vec![3..5]);
    }
}
