//! A name keeps its meaning: a chain or a better name says more than the same name, bound again on
//! the next line.

use crate::sizes::{files, read};

/// How often it happens. Whoever needs one more finds another that can go.
const MOST: usize = 210;

/// The name that the line binds: `let name = …` or `let mut name = …`.
fn bound(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("let ")?;
    let rest = rest.strip_prefix("mut ").unwrap_or(rest);
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    (end > 0).then_some(&rest[..end])
}

fn bound_again(text: &str) -> usize {
    text.lines()
        .zip(text.lines().skip(1))
        .filter(|(line, _)| line.ends_with(';'))
        .filter(|(line, next)| bound(line).is_some() && bound(line) == bound(next))
        .count()
}

#[test]
fn names_are_seldom_bound_again_on_the_next_line() {
    assert_eq!(bound_again("let a = 1;\nlet mut a = a;\nlet b = a;\n"), 1);
    assert_eq!(
        bound_again("let a = 1;\n\nlet a = a;\nlet (b, c) = a;\n"),
        0
    );
    let sources = files(&[".rs"]);
    let ours = sources
        .iter()
        .filter(|file| !file.starts_with("grader/mutants"));
    let sum: usize = ours.map(|file| bound_again(&read(file))).sum();
    assert!(
        sum <= MOST,
        "{sum} names are bound again, expected at most {MOST}"
    );
}
