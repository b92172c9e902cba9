//! Looks for copies of the solutions in a handout.
//!
//! Both are cut into tokens, and runs of `RUN` tokens are compared: laying code out anew, or moving it into a
//! comment, hides nothing.

use crate::handout::Handout;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

/// So many tokens in a row, two statements or so, are no coincidence. The longest run that code of the course shared
/// with a solution by chance was 33 tokens (the head of a loop over axes); 12 tokens are shared in twenty places.
const RUN: usize = 36;

/// Files of `handout` that say what a solution said. Those of parts before are not among them: where a later solution
/// repeats an earlier one, nothing is given away.
pub fn find(handout: &Handout) -> Vec<String> {
    let mut secret = Secret::new();
    // What tests of a solution say is no solution.
    for taken in handout
        .taken
        .iter()
        .filter(|taken| taken.path.iter().any(|name| name == "src"))
    {
        let from = format!("{} in {}", taken.key, taken.path.display());
        for run in runs(&tokens(&code(&taken.text))) {
            secret.entry(run).or_insert_with(|| from.clone());
        }
    }
    let files = handout.files.iter();
    files
        .filter(|(path, _)| !handout.solved.contains(*path))
        .filter_map(|(path, contents)| leak(path, contents, &secret))
        .collect()
}

/// The runs of all solutions, by their digests, and where each stands.
type Secret = HashMap<u64, String>;

/// The first leak in one file, if there is one. Looks at the file without its comments, for code whose comments
/// were changed, and with them, for code in a comment.
fn leak(path: &Path, contents: &[u8], secret: &Secret) -> Option<String> {
    let text = std::str::from_utf8(contents).ok()?;
    [without_comments(text).as_str(), text]
        .into_iter()
        .find_map(|text| {
            let tokens = tokens(text);
            let runs = runs(&tokens);
            let mut found = (0..)
                .zip(&runs)
                .filter_map(|(i, run)| Some((secret.get(run)?, i)));
            let (from, first): (_, usize) = found.next()?;
            Some(format!(
                "{} says what the solution of {from} says, {} tokens long: `{}`",
                path.display(),
                RUN + found.count(),
                tokens[first..first + RUN].join(" ")
            ))
        })
}

/// A number for each run of `RUN` tokens, in order: a text for each of millions would take most of the check's time.
/// Different runs have the same number with a chance of about 2^-64.
///
/// A run's number is the sum of its tokens' hashes, each times a power of `BASE`: so the next one is had by multiplying,
/// adding the token that comes and subtracting the one that goes (Karp and Rabin 1987).
fn runs(tokens: &[&str]) -> Vec<u64> {
    const BASE: u64 = 0x9e37_79b9_7f4a_7c15;
    let hash = |token: &&str| {
        let mut hasher = DefaultHasher::new();
        token.hash(&mut hasher);
        hasher.finish()
    };
    let hashes: Vec<u64> = tokens.iter().map(hash).collect();
    let oldest = (0..RUN).fold(1_u64, |power, _| power.wrapping_mul(BASE));
    let mut run = 0_u64;
    let sums = hashes.iter().enumerate().map(|(i, &comes)| {
        let goes = i.checked_sub(RUN).map_or(0, |i| hashes[i]);
        run = run.wrapping_mul(BASE).wrapping_add(comes);
        run = run.wrapping_sub(goes.wrapping_mul(oldest));
        run
    });
    sums.skip(RUN - 1).collect()
}

/// Words, numbers, and every other run of signs as Rust reads them. Comment signs are no tokens, so that code in a
/// comment is still code.
fn tokens(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        if let Some(comment) = rest.strip_prefix("//") {
            rest = comment.trim_start_matches(['/', '!']).trim_start();
            continue;
        }
        let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
        let end = match sign {
            Some(sign) => sign.len(),
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

/// Signs of more than one character.
const SIGNS: [&str; 16] = [
    "::", "->", "=>", "..=", "..", "&&", "||", "+=", "-=", "*=", "/=", "==", "!=", "<=", ">=", "<<",
];

/// The code of a solution alone, without comments, imports and unit tests.
fn code(solution: &str) -> String {
    let solution = solution.split("#[cfg(test)]").next().unwrap_or_default();
    let code = without_comments(solution);
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("use "));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// `text` without line comments. (One inside a string goes with the rest of its line: nothing is told apart by it.)
fn without_comments(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    lines.flat_map(|line| [line, "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handout::Taken;
    use std::collections::BTreeSet;
    use submission::file_tree::Files;

    const SOLUTION: &str = "    let n = (p1 - p0).cross(p2 - p0); // the plane\n    let t = (p0 - o).dot(n) / d.dot(n);";

    fn leaks(path: &str, text: &str) -> Vec<String> {
        let taken = Taken {
            path: "stages/intersect/src/triangle.rs".into(),
            key: "part1.task3".into(),
            text: SOLUTION.into(),
        };
        let files = Files::from([(path.into(), text.as_bytes().to_vec())]);
        let taken = vec![taken];
        find(&Handout {
            files,
            taken,
            solved: BTreeSet::from(["stages/bbox/src/lib.rs".into()]),
        })
    }

    #[test]
    fn what_a_part_before_says_is_given() {
        assert_eq!(leaks("stages/bbox/src/lib.rs", SOLUTION), [""; 0]);
    }

    #[test]
    fn a_copy_is_found_however_it_is_laid_out() {
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
                assert_eq!(leaks(path, copy).len(), 1, "{path}: {copy}");
            }
        }
    }

    #[test]
    fn a_few_equal_tokens_are_no_copy() {
        assert_eq!(
            leaks("grader/src/truth.rs", "let n = (p1 - p0).dot(x);"),
            [""; 0]
        );
    }

    #[test]
    fn imports_tests_and_comments_of_a_solution_are_no_secret() {
        let text = "use a::{b, c}; // d\nfn f() {}\n\n#[cfg(test)]\nmod tests { g() }";
        assert_eq!(code(text).trim(), "fn f() {}");
    }

    #[test]
    fn signs_and_numbers_are_whole_tokens() {
        let expected = ["a", "..=", "1.5e3", "-", "1", "..", "x", "::", "y", "z"];
        assert_eq!(tokens("a ..= 1.5e3 - 1..x::y /// z"), expected);
    }
}
