//! Finds copies of the solutions in a handout.
//!
//! Splits both into tokens and compares sequences of `LENGTH` tokens, in the chapters of the book
//! sequences of `LENGTH_IN_BOOK`. So a copy is found even if its formatting was changed or if it was
//! moved into a comment.

use handout::Handout;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// The length of the compared sequences in tokens: about two statements. The longest sequence that
/// code of the course shared with a solution by coincidence has 33 tokens (the head of a loop over
/// axes); sequences of 12 tokens are shared in twenty places.
const LENGTH: usize = 36;

/// The same for the chapters of the book, which explain the formulas and must not contain them as
/// code: about half a statement.
const LENGTH_IN_BOOK: usize = 12;

/// The folder of the chapters.
const BOOK: &str = "stages/book/src";

/// Describes the files of `handout` that contain a part of a removed solution. Reference files of
/// earlier parts may: where a later solution repeats an earlier one, nothing is revealed.
pub fn find(handout: &Handout) -> Vec<String> {
    let solutions = Solutions::of(handout, LENGTH);
    let of_book = Solutions::of(handout, LENGTH_IN_BOOK).without_given_code(handout);
    let files = handout.files.iter();
    files
        .filter(|(path, _)| !handout.reference_files.contains(*path))
        .filter_map(|(path, contents)| {
            let solutions = if path.starts_with(BOOK) {
                &of_book
            } else {
                &solutions
            };
            solutions.first_copy(path, contents)
        })
        .collect()
}

/// The token sequences of one length in the removed solutions of a handout.
struct Solutions {
    length: usize,
    sequences: SolutionSequences,
}

impl Solutions {
    fn of(handout: &Handout, length: usize) -> Solutions {
        let mut sequences = SolutionSequences::new();
        // Tests of a solution are not compared.
        let is_compared = |path: &Path| {
            path.iter().any(|name| name == "src")
                && path.file_name().is_none_or(|name| name != "tests.rs")
        };
        for removed in handout
            .removed
            .iter()
            .filter(|removed| is_compared(&removed.path))
        {
            let origin = format!("{} in {}", removed.key, removed.path.display());
            for hash in sequence_hashes(&tokens(&code(&removed.text)), length) {
                sequences.entry(hash).or_insert_with(|| origin.clone());
            }
        }
        Solutions { length, sequences }
    }

    /// Without the sequences that the stages of the handout contain, such as signatures: they are
    /// no secret.
    fn without_given_code(mut self, handout: &Handout) -> Solutions {
        let stages = handout.files.iter().filter(|(path, _)| {
            path.starts_with("stages") && path.extension().is_some_and(|e| e == "rs")
        });
        for (_, contents) in stages {
            let text = String::from_utf8_lossy(contents);
            for hash in sequence_hashes(&tokens(&without_comments(&text)), self.length) {
                self.sequences.remove(&hash);
            }
        }
        self
    }

    /// Describes the first copy in one file, if there is one. Searches the file without its
    /// comments, for code whose comments were changed, and with them, for code in a comment.
    fn first_copy(&self, path: &Path, contents: &[u8]) -> Option<String> {
        let text = std::str::from_utf8(contents).ok()?;
        [without_comments(text).as_str(), text]
            .into_iter()
            .find_map(|text| {
                let tokens = tokens(text);
                let hashes = sequence_hashes(&tokens, self.length);
                let mut found = (0..)
                    .zip(&hashes)
                    .filter_map(|(i, hash)| Some((self.sequences.get(hash)?, i)));
                let (origin, first): (_, usize) = found.next()?;
                Some(format!(
                    "{} contains {} tokens of the solution of {origin}: `{}`",
                    path.display(),
                    self.length + found.count(),
                    tokens[first..first + self.length].join(" ")
                ))
            })
    }
}

/// The hashes of all token sequences of the solutions, each with the place of its solution.
type SolutionSequences = HashMap<u64, String>;

/// The hash of each sequence of `length` tokens, in order. (Comparing millions of strings would
/// take most of the check's time.) Two different sequences have the same hash with a probability of
/// about 2^-64.
///
/// This is the rolling hash of Karp and Rabin (1987): the sum of the tokens' hashes, each times a
/// power of `BASE`. The next hash follows from the last one by a multiplication, adding the new
/// token and subtracting the oldest one.
fn sequence_hashes(tokens: &[&str], length: usize) -> Vec<u64> {
    const BASE: u64 = 0x9e37_79b9_7f4a_7c15;
    let hash = |token: &&str| {
        let mut hasher = DefaultHasher::new();
        token.hash(&mut hasher);
        hasher.finish()
    };
    let hashes: Vec<u64> = tokens.iter().map(hash).collect();
    let oldest_power = (0..length).fold(1_u64, |power, _| power.wrapping_mul(BASE));
    let mut sum = 0_u64;
    let sums = hashes.iter().enumerate().map(|(i, &newest)| {
        let oldest = i.checked_sub(length).map_or(0, |i| hashes[i]);
        sum = sum.wrapping_mul(BASE).wrapping_add(newest);
        sum = sum.wrapping_sub(oldest.wrapping_mul(oldest_power));
        sum
    });
    sums.skip(length - 1).collect()
}

/// Splits text into words, numbers and operators, as Rust does. Skips the signs that begin a
/// comment, so that code in a comment gives the same tokens.
fn tokens(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        if let Some(comment) = rest.strip_prefix("//") {
            rest = comment.trim_start_matches(['/', '!']).trim_start();
            continue;
        }
        let operator = OPERATORS
            .iter()
            .find(|operator| rest.starts_with(**operator));
        let end = match operator {
            Some(operator) => operator.len(),
            None if first.is_ascii_digit() => {
                let word = rest.find(|c| !is_word(c) && c != '.').unwrap_or(rest.len());
                // A range or a method after a number is not part of it.
                rest[..word].find("..").unwrap_or(word)
            }
            None if is_word(first) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            None => first.len_utf8(),
        };
        let (token, after) = rest.split_at(end);
        tokens.push(token);
        rest = after.trim_start();
    }
    tokens
}

/// Operators of more than one character.
const OPERATORS: [&str; 16] = [
    "::", "->", "=>", "..=", "..", "&&", "||", "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "<<",
];

/// The code of a solution without comments, imports and unit tests.
fn code(solution: &str) -> String {
    let solution = solution.split("#[cfg(test)]").next().unwrap_or_default();
    let code = without_comments(solution);
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("use "));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// `text` without line comments. (Also cuts a string that contains `//`, which does not matter
/// here.)
fn without_comments(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    lines.flat_map(|line| [line, "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::file_tree::Files;
    use handout::RemovedSolution;
    use std::collections::BTreeSet;

    const SOLUTION: &str = "    let n = (p1 - p0).cross(p2 - p0); // the plane\n    let t = (p0 - o).dot(n) / d.dot(n);";

    fn copies(path: &str, text: &str) -> Vec<String> {
        let removed = RemovedSolution {
            path: "stages/intersect/src/triangle.rs".into(),
            key: "part1.task3".into(),
            text: SOLUTION.into(),
        };
        let files = Files::from([(path.into(), text.as_bytes().to_vec())]);
        let removed = vec![removed];
        find(&Handout {
            files,
            removed,
            reference_files: BTreeSet::from(["stages/bbox/src/lib.rs".into()]),
        })
    }

    #[test]
    fn reference_files_may_repeat_a_solution() {
        assert_eq!(copies("stages/bbox/src/lib.rs", SOLUTION), [""; 0]);
    }

    #[test]
    fn a_copy_is_found_with_any_formatting() {
        for copy in [
            SOLUTION,
            "fn f() { let n=(p1-p0)\n.cross(p2-p0);let t=(p0-o).dot(n)/d.dot(n); }",
            "//! let n = (p1 - p0).cross(p2 - p0);\n//! let t = (p0 - o)\n//! .dot(n) / d.dot(n);",
        ] {
            for path in [
                "grader/src/truth.rs",
                "stages/kit/src/shapes.rs",
                "README.md",
            ] {
                assert_eq!(copies(path, copy).len(), 1, "{path}: {copy}");
            }
        }
    }

    #[test]
    fn a_few_equal_tokens_are_not_a_copy() {
        assert_eq!(
            copies("grader/src/truth.rs", "let n = (p1 - p0).dot(x);"),
            [""; 0]
        );
    }

    #[test]
    fn a_chapter_of_the_book_contains_no_half_statement_of_a_solution() {
        let half = "Then `let n = (p1 - p0).cross(p2 - p0)` is the normal.";
        assert_eq!(copies("stages/book/src/part1/task3.md", half).len(), 1);
        assert_eq!(copies("README.md", half), [""; 0]);
        let formula = "the normal is along $(p_1 - p_0) \\times (p_2 - p_0)$";
        assert_eq!(copies("stages/book/src/part1/task3.md", formula), [""; 0]);
    }

    #[test]
    fn imports_tests_and_comments_of_a_solution_are_not_compared() {
        let text = "use a::{b, c}; // d\nfn f() {}\n\n#[cfg(test)]\nmod tests { g() }";
        assert_eq!(code(text).trim(), "fn f() {}");
    }

    #[test]
    fn operators_and_numbers_are_single_tokens() {
        let expected = ["a", "..=", "1.5e3", "-", "1", "..", "x", "::", "y", "z"];
        assert_eq!(tokens("a ..= 1.5e3 - 1..x::y /// z"), expected);
    }
}
