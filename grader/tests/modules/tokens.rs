//! The tokens of a source file that imports are made of.

/// A name or a mark.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Token {
    /// An identifier or a keyword.
    Name(String),
    /// `::`
    Path,
    /// Any other mark, one character each.
    Mark(char),
}

/// The tokens of `text`, without comments, literals and what is compiled for tests only.
pub(crate) fn of(text: &str) -> Vec<Token> {
    without_tests(all(text))
}

fn all(text: &str) -> Vec<Token> {
    let chars: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        let (here, next) = (chars[at], chars.get(at + 1).copied());
        at = match (here, next) {
            ('/', Some('/')) => line_end(&chars, at),
            ('/', Some('*')) => comment_end(&chars, at),
            ('"', _) => string_end(&chars, at + 1),
            ('r', Some('"' | '#')) if raw_string_end(&chars, at + 1).is_some() => {
                raw_string_end(&chars, at + 1).unwrap_or(chars.len())
            }
            ('b', Some('"')) => string_end(&chars, at + 2),
            ('\'', _) => quote_end(&chars, at),
            (':', Some(':')) => {
                tokens.push(Token::Path);
                at + 2
            }
            _ if here.is_alphabetic() || here == '_' => {
                let is_part = |c: &char| c.is_alphanumeric() || *c == '_';
                let name: String = chars[at..].iter().copied().take_while(is_part).collect();
                let length = name.chars().count();
                tokens.push(Token::Name(name));
                at + length
            }
            _ if here.is_ascii_digit() => {
                let is_part = |c: &&char| c.is_alphanumeric() || **c == '_';
                at + chars[at..].iter().take_while(is_part).count()
            }
            _ => {
                if !here.is_whitespace() {
                    tokens.push(Token::Mark(here));
                }
                at + 1
            }
        };
    }
    tokens
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

/// The tokens without items after `#[cfg(test)]`.
fn without_tests(tokens: Vec<Token>) -> Vec<Token> {
    let attribute = all("#[cfg(test)]");
    let mut kept = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at..].starts_with(&attribute) {
            at = item_end(&tokens, at + attribute.len());
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    kept
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
