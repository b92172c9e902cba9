//! Passages that two texts have in common: runs of equal tokens.
//!
//! Winnowing (Schleimer, Wilkerson and Aiken, "Winnowing: local algorithms for document
//! fingerprinting", 2003) chooses among the hashes of all runs of `SHORTEST` tokens the least of
//! each window, so every common run of [`CERTAIN`] tokens has a common fingerprint, and no shorter
//! run than `SHORTEST` has one. Of the common runs only those of [`CERTAIN`] tokens are passages,
//! so what is found does not depend on where the windows lie.

use super::tokens::{self, Token};
use std::collections::{BTreeMap, HashSet};
use std::ops::Range;

/// The tokens of one hash.
const SHORTEST: usize = 20;

/// The fewest tokens of a passage, about four lines: all code has shorter runs in common.
pub const CERTAIN: usize = 30;

/// A run that stands in one text more often is a pattern of this text, such as the rows of a table.
const MOST_PLACES: usize = 16;

/// How many neighbouring hashes one fingerprint is chosen from.
const WINDOW: usize = CERTAIN - SHORTEST + 1;

/// What everybody may have: the text of the handout, textbook code. Hashes of all its runs.
#[derive(Clone, Debug, Default)]
pub struct Known(HashSet<u64>);

impl Known {
    /// Adds the text of a source file; nothing of what is no Rust.
    pub fn add_text(&mut self, text: &[u8]) {
        let text = String::from_utf8_lossy(text);
        self.add(&tokens::of(&text).unwrap_or_default());
    }

    /// Adds a text.
    pub fn add(&mut self, tokens: &[Token]) {
        self.0.extend(tokens.windows(SHORTEST).map(run_hash));
    }
}

/// A text that is compared.
#[derive(Clone, Debug, Default)]
pub struct Text {
    tokens: Vec<Token>,
    /// Whether each token is the student's own, and not in a known run.
    is_own: Vec<bool>,
    /// The places of the fingerprints, by their hashes.
    fingerprints: BTreeMap<u64, Vec<usize>>,
    /// The places and hashes of the fingerprints, sorted by place.
    by_place: Vec<(usize, u64)>,
}

/// A common passage: its tokens in both texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Passage {
    /// The first token in each text.
    pub starts: [usize; 2],
    /// The number of tokens.
    pub length: usize,
}

impl Text {
    /// A text without what is `known`.
    pub fn new(tokens: Vec<Token>, known: &Known) -> Text {
        let hashes: Vec<u64> = tokens.windows(SHORTEST).map(run_hash).collect();
        let is_end = |token: &Token| *token == Token::END_OF_FILE;
        let mut is_own: Vec<bool> = tokens.iter().map(|token| !is_end(token)).collect();
        for (start, _) in hashes
            .iter()
            .enumerate()
            .filter(|(_, hash)| known.0.contains(hash))
        {
            is_own[start..start + SHORTEST].fill(false);
        }
        let mut fingerprints: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for start in winnowed(&hashes) {
            if is_own[start..start + SHORTEST].iter().all(|is_own| *is_own) {
                fingerprints.entry(hashes[start]).or_default().push(start);
            }
        }
        fingerprints.retain(|_, places| places.len() <= MOST_PLACES);
        let all = fingerprints
            .iter()
            .flat_map(|(hash, places)| places.iter().map(|place| (*place, *hash)));
        let mut by_place: Vec<(usize, u64)> = all.collect();
        by_place.sort_unstable();
        Text {
            tokens,
            is_own,
            fingerprints,
            by_place,
        }
    }

    /// The number of tokens that are the student's own.
    pub fn own(&self) -> usize {
        self.is_own.iter().filter(|is_own| **is_own).count()
    }

    /// The hashes of the fingerprints.
    pub fn fingerprints(&self) -> impl Iterator<Item = u64> {
        self.fingerprints.keys().copied()
    }

    /// The hashes of the fingerprints in a passage that starts at `start`.
    pub fn fingerprints_in(&self, start: usize, length: usize) -> impl Iterator<Item = u64> {
        let end = start + length;
        let first = self.by_place.partition_point(|(place, _)| *place < start);
        let from = self.by_place[first..].iter();
        from.take_while(move |(place, _)| *place + SHORTEST <= end)
            .map(|(_, hash)| *hash)
    }

    /// The lines of a passage that starts at `start`, counted from 1.
    pub fn lines(&self, start: usize, length: usize) -> Range<usize> {
        self.tokens[start].line..self.tokens[start + length - 1].line + 1
    }

    /// The passages that it has in common with `other`, in its order, the longer first where two
    /// overlap.
    pub fn common(&self, other: &Text) -> Vec<Passage> {
        let mut found = self.runs(other);
        found.sort_by_key(|passage| (usize::MAX - passage.length, passage.starts));
        let mut taken = [
            vec![false; self.tokens.len()],
            vec![false; other.tokens.len()],
        ];
        let mut passages: Vec<Passage> = Vec::new();
        for passage in found {
            let places = passage.starts.map(|start| start..start + passage.length);
            let is_free = (0..2).all(|i| taken[i][places[i].clone()].iter().all(|taken| !taken));
            if is_free {
                (0..2).for_each(|i| taken[i][places[i].clone()].fill(true));
                passages.push(passage);
            }
        }
        passages.sort_by_key(|passage| passage.starts);
        passages
    }

    /// All common runs that are long enough for a passage, each once: a pair of fingerprints in a
    /// run that was found is not followed again. Otherwise the work for equal texts would grow with
    /// the square of their length.
    fn runs(&self, other: &Text) -> Vec<Passage> {
        let mut found: Vec<Passage> = Vec::new();
        // The ends of the runs, by how far the texts are shifted and by the start of the run. Runs
        // of one shift do not overlap: each goes on as far as it can.
        let mut ends: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (hash, places) in &self.fingerprints {
            let others = other.fingerprints.get(hash).into_iter().flatten();
            for [a, b] in others.flat_map(|b| places.iter().map(move |a| [*a, *b])) {
                let shift = other.tokens.len() + a - b;
                let before = ends.range((shift, 0)..=(shift, a)).next_back();
                if before.is_none_or(|(_, end)| *end < a + SHORTEST)
                    && let Some(passage) = self.grown(other, [a, b])
                {
                    let start = passage.starts[0];
                    ends.insert((shift, start), start + passage.length);
                    found.push(passage);
                }
            }
        }
        found
    }

    /// Whether a passage has the same names in both texts, too.
    pub fn has_same_names(&self, other: &Text, passage: &Passage) -> bool {
        let [a, b] = passage.starts;
        let exact = |text: &Text, start| -> Vec<u64> {
            let tokens = &text.tokens[start..start + passage.length];
            tokens.iter().map(|token| token.exact).collect()
        };
        exact(self, a) == exact(other, b)
    }

    /// The longest common run of own tokens around a pair of places; `None` if it is too short for a
    /// passage.
    fn grown(&self, other: &Text, [a, b]: [usize; 2]) -> Option<Passage> {
        let is_equal = |a: usize, b: usize| {
            let own = |text: &Text, i: usize| text.is_own.get(i).copied() == Some(true);
            own(self, a) && own(other, b) && self.tokens[a].form == other.tokens[b].form
        };
        let from = (0..).take_while(|n| is_equal(a + n, b + n)).count();
        if from < SHORTEST {
            return None;
        }
        let before = (1..=a.min(b))
            .take_while(|n| is_equal(a - n, b - n))
            .count();
        (before + from >= CERTAIN).then_some(Passage {
            starts: [a - before, b - before],
            length: before + from,
        })
    }
}

fn run_hash(run: &[Token]) -> u64 {
    tokens::hash(run.iter().map(|token| token.form))
}

/// The places of the fingerprints: the least hash of each window, the last of equal ones.
fn winnowed(hashes: &[u64]) -> Vec<usize> {
    let mut places: Vec<usize> = Vec::new();
    let windows = hashes
        .len()
        .saturating_sub(WINDOW - 1)
        .max(hashes.len().min(1));
    for first in 0..windows {
        let end = (first + WINDOW).min(hashes.len());
        let least = (first..end).rev().min_by_key(|place| hashes[*place]);
        if let Some(least) = least.filter(|least| places.last() != Some(least)) {
            places.push(least);
        }
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A text of statements, each of 7 tokens, that differ in their numbers.
    fn code(numbers: impl IntoIterator<Item = usize>) -> Vec<Token> {
        let lines = numbers.into_iter().map(|i| format!("let a = b * {i}.5;\n"));
        tokens::of(&lines.collect::<String>()).expect("Rust")
    }

    #[test]
    fn every_run_that_is_long_enough_is_found_and_no_shorter_one() {
        for shift in 0..12 {
            for statements in 1..12 {
                let a = code((0..20).chain(100..100 + statements).chain(20..30));
                let b = code(
                    (500..500 + shift)
                        .chain(100..100 + statements)
                        .chain(600..620),
                );
                let [a, b] = [a, b].map(|tokens| Text::new(tokens, &Known::default()));
                let tokens: usize = a.common(&b).iter().map(|passage| passage.length).sum();
                let shared = 7 * statements;
                if shared >= CERTAIN {
                    assert!(tokens >= shared, "{tokens} of {shared}, shift {shift}");
                } else if shared + 10 < CERTAIN {
                    assert_eq!(tokens, 0, "{shared} tokens, shift {shift}");
                }
            }
        }
    }

    #[test]
    fn equal_texts_are_followed_once_for_each_shift() {
        let [a, b] = [0..2000, 0..2000].map(|numbers| Text::new(code(numbers), &Known::default()));
        let runs = a.runs(&b);
        assert!(a.fingerprints.len() > 1000, "{}", a.fingerprints.len());
        assert_eq!(runs.len(), 1);
        assert_eq!(runs, a.common(&b));
        // The same three times in one of them: three shifts.
        let three = (0..3).flat_map(|i| (0..100).chain(5000 + i..5001 + i));
        let three = Text::new(code(three), &Known::default());
        let once = Text::new(code(0..100), &Known::default());
        assert_eq!(three.runs(&once).len(), 3);
        assert_eq!(three.common(&once).len(), 1);
    }

    #[test]
    fn known_text_is_no_passage_and_not_ones_own() {
        let text = code(0..20);
        let mut known = Known::default();
        known.add(&text);
        let own = Text::new(code((0..20).chain(40..50)), &known);
        assert_eq!(own.own(), 70);
        let other = Text::new(text, &known);
        assert_eq!((other.own(), own.common(&other)), (0, Vec::new()));
    }

    #[test]
    fn a_passage_with_other_names_is_found_and_told_apart() {
        let same = Text::new(code(0..9), &Known::default());
        let renamed = "let x = y * 0.5;\n".to_string()
            + &(1..9)
                .map(|i| format!("let x = y * {i}.5;\n"))
                .collect::<String>();
        let renamed = Text::new(tokens::of(&renamed).expect("Rust"), &Known::default());
        let passages = same.common(&renamed);
        assert_eq!(
            passages,
            [Passage {
                starts: [0, 0],
                length: 63
            }]
        );
        assert!(!same.has_same_names(&renamed, &passages[0]));
        assert!(same.has_same_names(&same.clone(), &passages[0]));
        assert_eq!(same.lines(0, 63), 1..10);
    }
}
