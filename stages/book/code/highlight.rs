//! Code with its keywords, strings and comments marked, as HTML.

use crate::page::escaped;

const KEYWORDS: [&str; 36] = [
    "as", "async", "await", "break", "const", "continue", "crate", "dyn", "else", "enum", "false",
    "fn", "for", "if", "impl", "in", "let", "loop", "match", "mod", "move", "mut", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "type", "unsafe", "use",
    "where", "while",
];

/// The types of the language that begin with a small letter.
const PRIMITIVES: [&str; 16] = [
    "bool", "char", "f32", "f64", "i8", "i16", "i32", "i64", "i128", "isize", "str", "u8", "u16",
    "u32", "u64", "usize",
];

/// The HTML of `code`. Of other languages than Rust and the shell nothing is marked.
pub(crate) fn html(code: &str, language: &str) -> String {
    let token = match language {
        "rust" => rust_token,
        "sh" => shell_token,
        _ => return escaped(code),
    };
    let mut html = String::new();
    let mut rest = code;
    let mut before = None;
    while let Some(first) = rest.chars().next() {
        let (length, class) = token(rest, before);
        let (text, after) = rest.split_at(length.clamp(first.len_utf8(), rest.len()));
        match class {
            "" => html += &escaped(text),
            class => html += &format!("<span class=\"{class}\">{}</span>", escaped(text)),
        }
        before = text.chars().last();
        rest = after;
    }
    html
}

/// The length of the first token of `rest`, and the class of its element; `""` is for what is not
/// marked.
fn rust_token(rest: &str, _before: Option<char>) -> (usize, &'static str) {
    let mut chars = rest.chars();
    let (first, second, third) = (chars.next(), chars.next(), chars.next());
    match (first.unwrap_or(' '), second.unwrap_or(' ')) {
        ('/', '/') => (line(rest), "comment"),
        ('/', '*') => (until(rest, 2, "*/"), "comment"),
        ('"', _) => (quoted(rest, '"'), "string"),
        ('\'', '\\') => (quoted(rest, '\''), "string"),
        ('\'', _) if third == Some('\'') => (quoted(rest, '\''), "string"),
        ('\'', _) => (1 + word(&rest[1..]), "type"),
        ('#', '[' | '!') => (until(rest, 1, "]"), "comment"),
        ('0'..='9', _) => (number(rest), "number"),
        (first, _) if first == '_' || first.is_alphabetic() => {
            let length = word(rest);
            let class = match (&rest[..length], rest[length..].chars().next()) {
                (name, _) if KEYWORDS.contains(&name) => "keyword",
                (name, _) if PRIMITIVES.contains(&name) || first.is_uppercase() => "type",
                (_, Some('(' | '!')) => "function",
                _ => "",
            };
            (length, class)
        }
        (first, _) => (first.len_utf8(), ""),
    }
}

/// The same for a shell: comments begin after a blank.
fn shell_token(rest: &str, before: Option<char>) -> (usize, &'static str) {
    match rest.as_bytes()[0] {
        b'#' if before.is_none_or(char::is_whitespace) => (line(rest), "comment"),
        b'"' => (quoted(rest, '"'), "string"),
        b'\'' => (quoted(rest, '\''), "string"),
        _ => (1, ""),
    }
}

fn line(rest: &str) -> usize {
    rest.find('\n').unwrap_or(rest.len())
}

/// The bytes up to the end of `end`, which is searched after `start` bytes.
fn until(rest: &str, start: usize, end: &str) -> usize {
    let found = rest[start..].find(end);
    found.map_or(rest.len(), |at| start + at + end.len())
}

fn word(rest: &str) -> usize {
    rest.find(|c: char| c != '_' && !c.is_alphanumeric())
        .unwrap_or(rest.len())
}

/// The bytes of a number: `1e-3_f64`, but of `0..n` and `1.max(n)` only the first digit.
fn number(rest: &str) -> usize {
    let mut length = word(rest);
    let fraction = rest[length..].strip_prefix('.');
    if fraction.is_some_and(|f| f.starts_with(|c: char| c.is_ascii_digit())) {
        length += 1 + word(&rest[length + 1..]);
    }
    if rest[..length].ends_with(['e', 'E']) && rest[length..].starts_with(['-', '+']) {
        length += 1 + word(&rest[length + 1..]);
    }
    length
}

/// The bytes of a string or a character, in which a backslash protects what follows.
fn quoted(rest: &str, quote: char) -> usize {
    let mut is_protected = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            c if c == quote && !is_protected => return at + 1,
            _ => is_protected = c == '\\' && !is_protected,
        }
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The marked pieces, with their classes.
    fn marked(code: &str, language: &str) -> Vec<String> {
        let html = html(code, language);
        let pieces = html.split("<span class=\"").skip(1);
        let piece = |piece: &str| {
            piece
                .split("</span>")
                .next()
                .unwrap_or_default()
                .replace("\">", " ")
        };
        pieces.map(piece).collect()
    }

    #[test]
    fn tokens_of_rust_have_their_classes() {
        let code = "let x = a.dot(b) * 1.5e-3; // half\nfn f<'a>(s: &'a Vec3) -> f64 { g(\"\\\"\", '\\'', 'x', 0..n) }";
        let expected = [
            "keyword let",
            "function dot",
            "number 1.5e-3",
            "comment // half",
            "keyword fn",
            "type 'a",
            "type 'a",
            "type Vec3",
            "type f64",
            "function g",
            "string &quot;\\&quot;&quot;",
            "string '\\''",
            "string 'x'",
            "number 0",
        ];
        assert_eq!(marked(code, "rust"), expected);
    }

    #[test]
    fn comments_of_a_shell_begin_after_a_blank() {
        assert_eq!(
            marked("cargo grader book part1#mistakes  # opens", "sh"),
            ["comment # opens"]
        );
        assert_eq!(marked("# let", "text"), [""; 0]);
    }

    #[test]
    fn code_is_escaped_and_whole() {
        for code in [
            "a < b && c > \"<d>\"",
            "'",
            "\"open",
            "/* open",
            "1.",
            "é'é",
            "#!",
        ] {
            for language in ["rust", "sh", "text"] {
                let html = html(code, language);
                let mut text = String::new();
                for part in html.split("<span class=\"") {
                    text += part
                        .split_once("\">")
                        .filter(|_| html != *part)
                        .map_or(part, |(_, t)| t);
                }
                let text = text.replace("</span>", "");
                assert_eq!(text, escaped(code), "{language}");
            }
        }
    }
}
