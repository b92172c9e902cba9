//! Finds the line of a function that a hint is about: the one whose names the hint mentions.

use std::collections::BTreeSet;

/// The line of `body`, counted from 0, that `clue` is certainly about: the only one that computes
/// or compares with every name of the function's code that the clue mentions. `None` if there is no
/// such line, or several. The first line, the signature, does not count.
pub fn of(body: &str, clue: &str) -> Option<usize> {
    let lines: Vec<(usize, BTreeSet<&str>)> = body
        .lines()
        .map(|line| line.split("//").next())
        .map(Option::unwrap_or_default)
        .enumerate()
        .skip(1)
        .filter(|(_, line)| line.contains(OPERATORS))
        .map(|(number, line)| (number, names(line).collect()))
        .collect();
    let occurs = |name: &&str| lines.iter().any(|(_, names)| names.contains(name));
    let mentioned: BTreeSet<&str> = names(clue).filter(occurs).collect();
    let mut meant = lines
        .iter()
        .filter(|(_, names)| !mentioned.is_empty() && mentioned.is_subset(names));
    let (line, _) = meant.next()?;
    meant.next().is_none().then_some(*line)
}

/// What a line has that computes or compares. Others only pass values on.
const OPERATORS: [char; 8] = ['<', '>', '=', '+', '-', '*', '/', '!'];

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

    /// The mistake is in the two comparisons; the last line mentions both weights, too.
    #[test]
    fn a_line_that_only_returns_what_the_hint_names_is_not_meant() {
        let body = "pub fn test() -> Option<Weights> {\n    if b1 < 0.0 || b1 > 1.0 {\n        return None;\n    }\n    if b2 < 0.0 || b2 > 1.0 {\n        return None;\n    }\n    Some(Weights { b1, b2 })\n}";
        assert_eq!(of(body, "b1 and b2 together are at most 1"), None);
        assert_eq!(of(body, "b2 alone may be 1"), Some(4));
    }

    #[test]
    fn it_is_none_where_no_line_stands_out() {
        assert_eq!(of(BODY, "Follow the loop from its start."), None);
        assert_eq!(of(BODY, "min_t and max_t belong to the range"), None);
    }
}
