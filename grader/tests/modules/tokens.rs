//! The tokens of a source file: what imports are made of, and which lines are code.

use std::ops::{Range, RangeInclusive};

/// A name, a literal or a mark.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Token {
    /// An identifier or a keyword.
    Name(String),
    /// A string, a character or a number.
    Literal,
    /// `::`
    Path,
    /// Any other mark, one character each.
    Mark(char),
}

/// The tokens of `text`, without comments and what is compiled for tests only.
pub(crate) fn of(text: &str) -> Vec<Token> {
    let (tokens, _) = all(text);
    let mut kept = Vec::with_capacity(tokens.len());
    let mut at = 0;
    for tests in items_of_tests(&tokens) {
        kept.extend_from_slice(&tokens[at..tests.start]);
        at = tests.end;
    }
    kept.extend_from_slice(&tokens[at..]);
    kept
}

/// All tokens of `text` but comments, and the lines of each.
pub(crate) fn all(text: &str) -> (Vec<Token>, Vec<RangeInclusive<usize>>) {
    let chars: Vec<char> = text.chars().collect();
    let (mut tokens, mut lines) = (Vec::new(), Vec::new());
    let (mut at, mut line) = (0, 0);
    while at < chars.len() {
        let (here, next) = (chars[at], chars.get(at + 1).copied());
        let (token, end) = match (here, next) {
            ('/', Some('/')) => (None, line_end(&chars, at)),
            ('/', Some('*')) => (None, comment_end(&chars, at)),
            ('"', _) => (Some(Token::Literal), string_end(&chars, at + 1)),
            ('r', Some('"' | '#')) if raw_string_end(&chars, at + 1).is_some() => {
                let end = raw_string_end(&chars, at + 1);
                (Some(Token::Literal), end.unwrap_or(chars.len()))
            }
            ('b', Some('"')) => (Some(Token::Literal), string_end(&chars, at + 2)),
            ('\'', _) => (Some(Token::Literal), quote_end(&chars, at)),
            (':', Some(':')) => (Some(Token::Path), at + 2),
            _ if here.is_alphanumeric() || here == '_' => {
                let is_part = |c: &&char| c.is_alphanumeric() || **c == '_';
                let word: String = chars[at..].iter().take_while(is_part).collect();
                let end = at + word.chars().count();
                let is_number = here.is_ascii_digit();
                let token = if is_number {
                    Token::Literal
                } else {
                    Token::Name(word)
                };
                (Some(token), end)
            }
            _ => ((!here.is_whitespace()).then_some(Token::Mark(here)), at + 1),
        };
        let end = end.min(chars.len());
        let last = line + chars[at..end].iter().filter(|c| **c == '\n').count();
        if let Some(token) = token {
            tokens.push(token);
            lines.push(line..=last);
        }
        (at, line) = (end, last);
    }
    (tokens, lines)
}

fn line_end(chars: &[char], at: usize) -> usize {
    let rest = chars[at..].iter().position(|c| *c == '\n');
    rest.map_or(chars.len(), |length| at + length)
}

/// The end of the comment, which may contain others, that starts at `at`.
fn comment_end(chars: &[char], mut at: usize) -> usize {
    let mut depth = 0;
    while at < chars.len() {
        match (chars[at], chars.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 2),
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    at
}

/// The end of the string whose first character is at `at`.
fn string_end(chars: &[char], mut at: usize) -> usize {
    while at < chars.len() {
        match chars[at] {
            '\\' => at += 2,
            '"' => return at + 1,
            _ => at += 1,
        }
    }
    at
}

/// The end of the raw string whose first `#` or quote is at `at`; `None` if there is none.
fn raw_string_end(chars: &[char], at: usize) -> Option<usize> {
    let hashes = chars[at..].iter().take_while(|c| **c == '#').count();
    if chars.get(at + hashes) != Some(&'"') {
        return None;
    }
    let start = at + hashes + 1;
    let is_end = |end: &usize| {
        let after = chars.get(end + 1..end + 1 + hashes);
        chars[*end] == '"' && after.is_some_and(|after| after.iter().all(|c| *c == '#'))
    };
    let end = (start..chars.len()).find(is_end)?;
    Some(end + 1 + hashes)
}

/// The end of the character literal at `at`, or of the quote of a lifetime.
fn quote_end(chars: &[char], at: usize) -> usize {
    match (chars.get(at + 1), chars.get(at + 2)) {
        (Some('\\'), _) => {
            let rest = chars.get(at + 3..).unwrap_or_default();
            let length = rest.iter().position(|c| *c == '\'').unwrap_or(rest.len());
            at + 3 + length + 1
        }
        (Some(_), Some('\'')) => at + 3,
        _ => at + 1,
    }
}

/// The places of the items that are compiled for tests only, with their attributes.
pub(crate) fn items_of_tests(tokens: &[Token]) -> Vec<Range<usize>> {
    let attributes = ["#[cfg(test)]", "#[cfg(all(test,"].map(|text| all(text).0);
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if attributes.iter().any(|it| tokens[at..].starts_with(it)) {
            // The attribute ends with the first `]` at its depth.
            let length = tokens[at..].iter().position(|it| *it == Token::Mark(']'));
            let end = item_end(tokens, at + length.map_or(0, |length| length + 1));
            found.push(at..end);
            at = end;
        } else {
            at += 1;
        }
    }
    found
}

/// The end of the item that starts at `at`: after its `;`, or after its braces.
pub(crate) fn item_end(tokens: &[Token], at: usize) -> usize {
    let mut depth = 0_usize;
    for (here, token) in tokens.iter().enumerate().skip(at) {
        match token {
            Token::Mark('{' | '(' | '[') => depth += 1,
            Token::Mark(mark @ ('}' | ')' | ']')) => {
                depth = depth.saturating_sub(1);
                if depth == 0 && *mark == '}' {
                    return here + 1;
                }
            }
            Token::Mark(';') if depth == 0 => return here + 1,
            _ => {}
        }
    }
    tokens.len()
}

/// The place of the `;` that ends the `use` at `at`.
pub(crate) fn use_end(tokens: &[Token], at: usize) -> usize {
    let rest = tokens[at..]
        .iter()
        .position(|token| *token == Token::Mark(';'));
    rest.map_or(tokens.len() - 1, |length| at + length)
}

#[test]
fn comments_literals_and_tests_are_no_tokens() {
    let text = "use a::b; // use c;\n/* x /* y */ z */ let s = \"use d;\"; let r = r#\"use \"e\"#;\n\
                let q = '\"'; let l: &'static str = x; #[cfg(test)] mod tests { use f; } mod g;";
    let names: Vec<String> = of(text)
        .into_iter()
        .filter_map(|token| match token {
            Token::Name(name) => Some(name),
            _ => None,
        })
        .collect();
    assert_eq!(
        names.join(" "),
        "use a b let s let r let q let l static str x mod g"
    );
}
