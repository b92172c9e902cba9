//! Guesses which line of a function a hint is about: the line whose names the hint mentions.

use std::collections::{BTreeMap, BTreeSet};

/// The line of `body`, counted from 0, whose names `clue` mentions and few other lines contain.
/// `None` if no line, or no single line, stands out. The first line, the signature, does not count.
pub fn of(body: &str, clue: &str) -> Option<usize> {
    let mentioned: BTreeSet<&str> = names(clue).collect();
    let lines: Vec<BTreeSet<&str>> = body
        .lines()
        .map(|line| names(line.split("//").next().unwrap_or_default()).collect())
        .collect();
    let mut lines_with: BTreeMap<&str, f64> = BTreeMap::new();
    for name in lines.iter().skip(1).flatten() {
        *lines_with.entry(name).or_default() += 1.0;
    }
    let weight = |line: &BTreeSet<&str>| -> f64 {
        let known = line.iter().filter(|name| mentioned.contains(*name));
        known
            .map(|name| lines_with.get(name).map_or(0.0, |lines| 1.0 / lines))
            .sum()
    };
    let weights = lines
        .iter()
        .enumerate()
        .skip(1)
        .map(|(at, line)| (weight(line), at));
    let mut weights: Vec<(f64, usize)> = weights.collect();
    weights.sort_by(|a, b| b.0.total_cmp(&a.0));
    match weights.as_slice() {
        [(best, at)] if *best > 0.0 => Some(*at),
        [(best, at), (second, _), ..] if best > second => Some(*at),
        _ => None,
    }
}

/// The names in a text: identifiers of at least two characters that are no words of Rust, and no
/// short words of English.
fn names(text: &str) -> impl Iterator<Item = &str> {
    const WORDS: [&str; 34] = [
        "let", "mut", "if", "else", "for", "in", "while", "loop", "match", "return", "fn", "pub",
        "as", "is", "it", "its", "of", "to", "the", "and", "or", "not", "are", "by", "at", "on",
        "with", "that", "code", "use", "ref", "true", "false", "self",
    ];
    let words = text.split(|c: char| c != '_' && !c.is_alphanumeric());
    words
        .filter(|word| word.len() > 1 && !word.starts_with(|c: char| c.is_ascii_digit()))
        .filter(|word| !WORDS.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: &str = "pub fn hits(ray: &Ray) -> bool {\n    let t = ray.d.x; // min_t\n    if t < ray.min_t {\n        return false;\n    }\n    t <= ray.max_t\n}";

    #[test]
    fn it_is_the_line_with_the_names_of_the_hint() {
        assert_eq!(
            of(BODY, "Which hits are too near is decided by min_t alone."),
            Some(2)
        );
        assert_eq!(of(BODY, "The range ends at max_t"), Some(5));
    }

    #[test]
    fn it_is_none_where_no_line_stands_out() {
        assert_eq!(of(BODY, "Follow the loop from its start."), None);
        assert_eq!(of(BODY, "min_t and max_t belong to the range"), None);
    }
}
