//! The tokens of a source file, without what may differ between two copies of one text: comments,
//! attributes, blanks, and, in [`Token::form`], names.

use base::fnv;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::str::FromStr;

/// A token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is. All names have one form, keywords and numbers their own.
    pub form: u64,
    /// What it is, names included.
    pub exact: u64,
    /// Its line, counted from 1.
    pub line: usize,
}

impl Token {
    /// What stands between two files: no passage goes over it.
    pub const END_OF_FILE: Token = Token {
        form: 0,
        exact: 0,
        line: 0,
    };
}

/// The form that every name has, so that renaming changes no form.
const NAME: &str = "a name";

/// Words that Rust gives a meaning: in the place of a name they make a different program.
const KEYWORDS: [&str; 30] = [
    "as", "break", "const", "continue", "else", "enum", "false", "fn", "for", "if", "impl", "in",
    "let", "loop", "match", "mod", "move", "mut", "pub", "ref", "return", "self", "static",
    "struct", "trait", "true", "type", "use", "where", "while",
];

/// The tokens of `text`; `None` if it is no Rust, such as text with a bracket that is never closed.
pub fn of(text: &str) -> Option<Vec<Token>> {
    let stream = TokenStream::from_str(text).ok()?;
    let mut tokens = Vec::new();
    // Not recursive: brackets may lie thousands deep in each other.
    let mut open = vec![(stream.into_iter().peekable(), None)];
    while let Some((stream, close)) = open.last_mut() {
        match stream.next() {
            None => {
                tokens.extend(*close);
                open.pop();
            }
            Some(TokenTree::Group(group)) => {
                let (start, end) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                tokens.push(token(start, start, group.span_open().start().line));
                let end = token(end, end, group.span_close().start().line);
                open.push((group.stream().into_iter().peekable(), Some(end)));
            }
            Some(TokenTree::Punct(mark)) if mark.as_char() == '#' => {
                let is_mark = |next: &TokenTree| matches!(next, TokenTree::Punct(mark) if mark.as_char() == '!');
                stream.next_if(is_mark);
                stream.next_if(|next| matches!(next, TokenTree::Group(_)));
            }
            Some(TokenTree::Punct(mark)) => {
                let text = mark.as_char().to_string();
                tokens.push(token(&text, &text, mark.span().start().line));
            }
            Some(TokenTree::Ident(name)) => {
                let text = name.to_string();
                let is_keyword = KEYWORDS.binary_search(&text.as_str()).is_ok();
                let form = if is_keyword { &text } else { NAME };
                tokens.push(token(form, &text, name.span().start().line));
            }
            Some(TokenTree::Literal(value)) => {
                let text = value.to_string();
                tokens.push(token(&text, &text, value.span().start().line));
            }
        }
    }
    // The places of all tokens of a thread are kept until this call.
    proc_macro2::extra::invalidate_current_thread_spans();
    Some(tokens)
}

fn token(form: &str, exact: &str, line: usize) -> Token {
    Token {
        form: hash(form.bytes()),
        exact: hash(exact.bytes()),
        line,
    }
}

/// A hash of numbers, mixed so that its size is random, too.
pub(super) fn hash(parts: impl IntoIterator<Item: Into<u64>>) -> u64 {
    let all = parts.into_iter().fold(fnv::START, fnv::add);
    let folded = all ^ (all >> 32);
    folded.wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forms(text: &str) -> Vec<u64> {
        let tokens = of(text).expect("Rust").into_iter();
        tokens.map(|token| token.form).collect()
    }

    #[test]
    fn keywords_are_sorted() {
        assert!(KEYWORDS.is_sorted());
    }

    #[test]
    fn comments_blanks_attributes_and_names_change_no_form() {
        let plain = "fn f(a: f64) -> f64 { a * 2.0 }";
        let other = "/// Doc.\n#[inline(always)]\nfn twice( x :f64)->f64{\n    // why\n x*2.0 }";
        assert_eq!(forms(plain), forms(other));
        assert_ne!(of(plain), of(other));
    }

    #[test]
    fn operators_numbers_and_keywords_are_kept() {
        let plain = forms("if a < 2.0 { return b; }");
        for other in [
            "if a > 2.0 { return b; }",
            "if a < 3.0 { return b; }",
            "while a < 2.0 { return b; }",
        ] {
            assert_ne!(plain, forms(other), "{other}");
        }
    }

    #[test]
    fn a_token_has_the_line_that_it_stands_in() {
        let lines: Vec<usize> = of("fn f()\n{\n  g\n}")
            .expect("Rust")
            .iter()
            .map(|token| token.line)
            .collect();
        assert_eq!(lines, [1, 1, 1, 1, 2, 3, 4]);
    }

    #[test]
    fn what_is_no_rust_has_no_tokens_and_deep_brackets_end_no_program() {
        assert_eq!(of("fn f( {"), None);
        let deep = format!("{}{}", "(".repeat(100_000), ")".repeat(100_000));
        assert_eq!(of(&deep).map(|tokens| tokens.len()), Some(200_000));
    }
}
