//! Finds code in a stage that could reach what is not the stage's, before it is compiled.
//!
//! It reads tokens, not text, so comments and strings do not matter. It need not find everything:
//! what a macro hides, the compiler's lint against `unsafe` or the sandbox still stops. But whoever
//! writes such code without bad intent gets a sentence with the place.

mod table;

pub use table::table;

use files::file_tree::Files;

/// Returns a sentence for each place in the files of `stage` that has no business there.
pub fn forbidden(stage: &str, files: &Files) -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in files {
        let tokens = tokens(&String::from_utf8_lossy(text));
        for (line, what, why) in places(&tokens) {
            found.push(format!(
                "stages/{stage}/src/{}:{line}: `{what}` {why}",
                path.display()
            ));
        }
    }
    found
}

const READS_FILES: &str =
    "reads another file while the stage is compiled: write its contents into the source file";
const READS_ENVIRONMENT: &str =
    "reads the environment of the person who grades: a stage depends on its arguments only";
const NO_UNSAFE: &str =
    "is not allowed in a stage: nothing in the tasks needs code that the compiler cannot check";
const LINKS: &str =
    "changes how the program is linked or started: a stage is a library that is only called";
const OTHER_FILE: &str =
    "names another file as the source of a module: put it where `mod` expects it";
const OUTLIVES: &str =
    "refers to a reference of another lifetime: no function of a stage needs such an argument";
const HIDDEN: &str =
    "is a name for the compiler that an argument of a macro decides: write the name itself";
const ALIAS: &str =
    "gets another name: what reads files or the environment has to be called by its own";
const UNSTABLE: &str = "needs another compiler: stages are compiled by a stable one";

/// Macros, by their names in front of a `!`.
const MACROS: [(&str, &str); 8] = [
    ("include", READS_FILES),
    ("include_bytes", READS_FILES),
    ("include_str", READS_FILES),
    ("env", READS_ENVIRONMENT),
    ("option_env", READS_ENVIRONMENT),
    ("asm", NO_UNSAFE),
    ("global_asm", NO_UNSAFE),
    ("naked_asm", NO_UNSAFE),
];

/// Words that are forbidden anywhere.
const WORDS: [(&str, &str); 5] = [
    ("unsafe", NO_UNSAFE),
    ("extern", LINKS),
    ("include_bytes", READS_FILES),
    ("include_str", READS_FILES),
    ("option_env", READS_ENVIRONMENT),
];

/// Words that are forbidden in attributes.
const ATTRIBUTES: [(&str, &str); 15] = [
    ("path", OTHER_FILE),
    ("debugger_visualizer", READS_FILES),
    ("crate_type", LINKS),
    ("export_name", LINKS),
    ("global_allocator", LINKS),
    ("link", LINKS),
    ("link_name", LINKS),
    ("link_section", LINKS),
    ("naked", NO_UNSAFE),
    ("no_main", LINKS),
    ("no_mangle", LINKS),
    ("panic_handler", LINKS),
    ("proc_macro", LINKS),
    ("start", LINKS),
    ("used", LINKS),
];

/// A word or a character of Rust code, and its line, counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Token {
    line: usize,
    text: String,
}

/// The forbidden tokens: line, text, reason.
fn places(tokens: &[Token]) -> Vec<(usize, &str, &'static str)> {
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text.as_str());
    let reason = |list: &[(&str, &'static str)], word: &str| {
        let found = list.iter().find(|(name, _)| *name == word);
        found.map(|(_, why)| *why)
    };
    let mut found = Vec::new();
    // The depth of brackets inside an attribute.
    let mut depth = 0_usize;
    let mut in_use = false;
    for (i, token) in tokens.iter().enumerate() {
        let word = token.text.as_str();
        let opens = word == "[" && (i > 0 && text(i - 1) == "#" || is_inner(tokens, i));
        match word {
            "[" if opens || depth > 0 => depth += 1,
            "]" => depth = depth.saturating_sub(1),
            _ => {}
        }
        // Not `!=`.
        let is_macro = text(i + 1) == "!" && text(i + 2) != "=";
        let of_macro = reason(&MACROS, word).filter(|_| is_macro);
        let of_attribute = reason(&ATTRIBUTES, word).filter(|_| depth > 0);
        let unstable = word == "feature" && i > 0 && is_inner(tokens, i - 1);
        let unstable = unstable.then_some(UNSTABLE);
        let of_lifetimes = outlives(&tokens[i..]).then_some(OUTLIVES);
        let hidden = is_hidden(tokens, i, depth > 0).then_some(HIDDEN);
        // Not the `use<'a>` of a type.
        in_use = word == "use" && text(i + 1) != "<" || in_use && word != ";";
        let is_in_path = in_use || i > 0 && text(i - 1) == ":";
        let is_renamed = is_in_path && text(i + 1) == "as" && reason(&MACROS, word).is_some();
        let renamed = (is_renamed || in_use && word == "$").then_some(ALIAS);
        let why = of_macro
            .or(reason(&WORDS, word))
            .or(of_lifetimes)
            .or(of_attribute)
            .or(unstable)
            .or(hidden)
            .or(renamed);
        if let Some(why) = why {
            found.push((token.line, word, why));
        }
    }
    found
}

/// Whether these tokens begin with a reference with a lifetime to a reference with another one.
fn outlives(tokens: &[Token]) -> bool {
    let mut words = tokens.iter().map(|token| token.text.as_str());
    let mut reference = || {
        let is_reference = words.next()? == "&";
        words
            .next()
            .filter(|word| is_reference && word.starts_with('\''))
    };
    let (outer, inner) = (reference(), reference());
    outer.is_some() && inner.is_some() && outer != inner
}

/// Whether at token `i` an argument of a macro becomes an attribute, its name, or the name of a
/// macro: `#[$name = "file"]`, `#$attribute`, `$name!("file")`. The values of attributes are no
/// names.
fn is_hidden(tokens: &[Token], i: usize, in_attribute: bool) -> bool {
    let text = |i: usize| tokens.get(i).map_or("", |token| token.text.as_str());
    let before = if i > 0 { text(i - 1) } else { "" };
    let is_followed_by = |mark| text(i + 2) == mark && text(i + 3) != "=";
    match text(i) {
        "$" if in_attribute => before != "=",
        // The `#` before `[$name = "file"]` may be an argument, too.
        "$" => before == "#" || before == "[" && is_followed_by("=") || is_followed_by("!"),
        "#" => !matches!(text(i + 1), "[" | "!" | "$"),
        _ => false,
    }
}

/// Whether token `i` is the bracket of an attribute `#![...]`.
fn is_inner(tokens: &[Token], i: usize) -> bool {
    let start = i.checked_sub(2).and_then(|start| tokens.get(start..=i));
    start.is_some_and(|start| {
        let mut texts = start.iter().map(|token| token.text.as_str());
        texts.by_ref().eq(["#", "!", "["])
    })
}

/// The tokens of Rust code without comments, strings and characters. Code that is no
/// Rust gives some tokens, too.
fn tokens(code: &str) -> Vec<Token> {
    let mut scanner = Scanner::new(code);
    let mut tokens = Vec::new();
    while let Some(token) = scanner.next() {
        tokens.push(token);
    }
    tokens
}

#[derive(Clone)]
struct Scanner<'a> {
    rest: &'a str,
    line: usize,
    /// The bytes of all strings and characters so far, with their marks.
    quoted: usize,
    /// The bytes of all comments so far that the compiler reads as attributes.
    documented: usize,
}

impl<'a> Scanner<'a> {
    fn new(code: &'a str) -> Scanner<'a> {
        let mut scanner = Scanner {
            rest: code,
            line: 1,
            quoted: 0,
            documented: 0,
        };
        if is_shebang(code) {
            // A quotation mark in it begins no string.
            scanner.skip_past("\n");
        }
        scanner
    }

    /// Skips a literal by `skip`, and counts its bytes.
    fn skip_quoted(&mut self, skip: impl FnOnce(&mut Scanner<'a>)) {
        let before = self.rest.len();
        skip(self);
        self.quoted += before - self.rest.len();
    }

    /// Skips `bytes` bytes, which end between two characters.
    fn skip(&mut self, bytes: usize) {
        let (skipped, rest) = self.rest.split_at(bytes.min(self.rest.len()));
        self.line += skipped.matches('\n').count();
        self.rest = rest;
    }

    /// Skips to the end of the first `end`, or of the code.
    fn skip_past(&mut self, end: &str) {
        let bytes = self.rest.find(end).map(|start| start + end.len());
        self.skip(bytes.unwrap_or(self.rest.len()));
    }

    /// Skips an item, such as a module.
    fn skip_item(&mut self) {
        let mut depth = 0_usize;
        while let Some(token) = self.next() {
            match token.text.as_str() {
                "{" => depth += 1,
                "}" => depth = depth.saturating_sub(1),
                ";" => {}
                _ => continue,
            }
            if depth == 0 {
                return;
            }
        }
    }

    fn next(&mut self) -> Option<Token> {
        loop {
            let first = self.rest.chars().next()?;
            if is_space(first) {
                self.skip(first.len_utf8());
            } else if let Some(comment) = ["//", "/*"].iter().find(|it| self.rest.starts_with(**it))
            {
                let is_doc = matches!(self.rest.as_bytes().get(2), Some(b'/' | b'!' | b'*'));
                let before = self.rest.len();
                match *comment {
                    "//" => self.skip_past("\n"),
                    _ => self.skip_comment(),
                }
                self.documented += if is_doc { before - self.rest.len() } else { 0 };
            } else if first == '"' {
                self.skip_quoted(Scanner::skip_string);
            } else if let Some(lifetime) = lifetime(self.rest) {
                let (line, text) = (self.line, lifetime.to_string());
                self.skip(text.len());
                return Some(Token { line, text });
            } else if first == '\'' {
                self.skip_quoted(Scanner::skip_character);
            } else if is_part_of_word(first) {
                let length = self.rest.find(|c| !is_part_of_word(c));
                let (word, after) = self.rest.split_at(length.unwrap_or(self.rest.len()));
                let line = self.line;
                if let ("r" | "br" | "cr", Some(hashes)) = (word, raw_string(after)) {
                    self.skip_quoted(|scanner| {
                        scanner.skip(word.len() + hashes + 1);
                        scanner.skip_past(&format!("\"{}", "#".repeat(hashes)));
                    });
                } else if word == "r" && after.starts_with('#') {
                    // A raw identifier: the word that follows.
                    self.skip(2);
                } else {
                    let text = word.to_string();
                    self.skip(text.len());
                    return Some(Token { line, text });
                }
            } else {
                let line = self.line;
                self.skip(first.len_utf8());
                return Some(Token {
                    line,
                    text: first.into(),
                });
            }
        }
    }

    /// Skips a comment, with those inside it.
    fn skip_comment(&mut self) {
        let mut depth = 0;
        while !self.rest.is_empty() {
            if self.rest.starts_with("/*") {
                depth += 1;
                self.skip(2);
            } else if self.rest.starts_with("*/") {
                depth -= 1;
                self.skip(2);
            } else {
                self.skip(self.rest.chars().next().map_or(1, char::len_utf8));
            }
            if depth == 0 {
                return;
            }
        }
    }

    /// Skips a string, which is not raw.
    fn skip_string(&mut self) {
        let mut escaped = false;
        let end = self.rest.char_indices().skip(1).find(|&(_, c)| {
            let ends = c == '"' && !escaped;
            escaped = c == '\\' && !escaped;
            ends
        });
        self.skip(end.map_or(self.rest.len(), |(i, _)| i + 1));
    }

    /// Skips a character, or a single quotation mark.
    fn skip_character(&mut self) {
        let mut chars = self.rest.char_indices().skip(1);
        let length = match (chars.next(), chars.next()) {
            // `'\''` and `'\\'`: the second character is escaped.
            (Some((_, '\\')), Some((i, c))) => {
                let after = i + c.len_utf8();
                let end = self.rest[after..].find('\'');
                end.map_or(self.rest.len(), |end| after + end + 1)
            }
            (Some(_), Some((i, '\''))) => i + 1,
            _ => 1,
        };
        self.skip(length);
    }
}

/// Whether the first line is for the system's shell, as the compiler reads it: `#!` that begins no
/// attribute.
fn is_shebang(code: &str) -> bool {
    let rest = code.strip_prefix('\u{feff}').unwrap_or(code);
    let rest = rest
        .strip_prefix("#!")
        .map(|rest| rest.trim_start_matches(is_space));
    rest.is_some_and(|rest| !rest.starts_with('['))
}

/// Whether the compiler reads a character as space: also marks of direction.
fn is_space(c: char) -> bool {
    c.is_whitespace() || matches!(c, '\u{200e}' | '\u{200f}')
}

/// The lifetime at the beginning of `text`, with its quotation mark; `None` if it is a character.
fn lifetime(text: &str) -> Option<&str> {
    let name = text.strip_prefix('\'')?;
    let length = name.find(|c| !is_part_of_word(c)).unwrap_or(name.len());
    let is_character = name[length..].starts_with('\'');
    (length > 0 && !is_character).then(|| &text[..=length])
}

/// The number of `#` before the quotation mark, if `text` goes on as a raw string does after its
/// `r`.
fn raw_string(text: &str) -> Option<usize> {
    let hashes = text.len() - text.trim_start_matches('#').len();
    text[hashes..].starts_with('"').then_some(hashes)
}

fn is_part_of_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn found(code: &str) -> Vec<String> {
        let files = Files::from([(PathBuf::from("a.rs"), code.as_bytes().to_vec())]);
        let found = forbidden("bvh", &files).into_iter();
        let short = found.map(|sentence| {
            let place = sentence.split("` ").next().unwrap_or_default();
            place.replace("stages/bvh/src/", "")
        });
        short.collect()
    }

    #[test]
    fn forbidden_code_is_found_with_its_line() {
        for (code, place) in [
            ("\nfn f() { unsafe { g() } }", "a.rs:2: `unsafe"),
            (
                "const A: &str = include_str ! (\"x\");",
                "a.rs:1: `include_str",
            ),
            ("m!(include_bytes)", "a.rs:1: `include_bytes"),
            ("/* \n */ include!(\"x\");", "a.rs:2: `include"),
            ("#[path = \"/etc/x\"]\nmod a;", "a.rs:1: `path"),
            ("#[cfg_attr(all(), path = \"x\")] mod a;", "a.rs:1: `path"),
            ("#[r#path = \"x\"] mod a;", "a.rs:1: `path"),
            ("static S: &str = env!(\"HOME\");", "a.rs:1: `env"),
            ("#[no_mangle] fn f() {}", "a.rs:1: `no_mangle"),
            ("extern \"C\" {}", "a.rs:1: `extern"),
            ("#![feature(asm)]", "a.rs:1: `feature"),
            ("let c = '\"'; global_asm!(\"\");", "a.rs:1: `global_asm"),
            ("r##\"a\"#\"##; '\\''; asm!()", "a.rs:1: `asm"),
            ("fn f<'a>(x: &'a u8) { env!(\"A\") }", "a.rs:1: `env"),
            ("fn f<'a, 'b>(_: &'a &'b ()) {}", "a.rs:1: `&"),
            (
                "#!/bin/sh \"\nstatic S: &str = env!(\"A\"); // \"",
                "a.rs:2: `env",
            ),
            ("#![doc = \"]\"] extern crate a;", "a.rs:1: `extern"),
            (
                "macro_rules! m { ($a:ident) => { #[$a = \"x\"] mod x; } }",
                "a.rs:1: `$",
            ),
            (
                "macro_rules! m { ($a:meta) => { #[$a] mod x; } }",
                "a.rs:1: `$",
            ),
            ("#[cfg_attr(all(), $a)] mod x;", "a.rs:1: `$"),
            (
                "macro_rules! m { ($a:tt) => { # $a mod x; } }",
                "a.rs:1: `$",
            ),
            (
                "macro_rules! m { ($h:tt $a:ident) => { $h[$a = \"x\"] mod x; } }",
                "a.rs:1: `$",
            ),
            ("m!(# x)", "a.rs:1: `#"),
            (
                "macro_rules! m { ($f:ident) => { $f!(\"x\"); } } m!(include);",
                "a.rs:1: `$",
            ),
            ("use std::include as inc;", "a.rs:1: `include"),
            ("use std::{fmt, env as e};", "a.rs:1: `env"),
            (
                "pub use core::prelude::v1::{self as v, include as i};",
                "a.rs:1: `include",
            ),
            (
                "macro_rules! m { ($f:ident) => { use std::$f as f; } }",
                "a.rs:1: `$",
            ),
            ("m!(std::include as inc);", "a.rs:1: `include"),
            ("include\u{200e}!(\"x\");", "a.rs:1: `include"),
            ("#\u{200f}[path = \"x\"] mod a;", "a.rs:1: `path"),
        ] {
            assert_eq!(found(code), [place], "{code}");
        }
    }

    #[test]
    fn honest_code_is_not_found() {
        for code in [
            "// unsafe include_str!(\"x\")",
            "/* env!(\"A\") /* unsafe */ extern */",
            "let s = \"unsafe \\\" extern\"; let r = r#\"unsafe \" env!()\"#;",
            "let path = paths[path].start; let include = env.used; include != 3",
            "#[cfg(feature = \"x\")] #[derive(Clone)] #[inline(always)] fn f() {}",
            "fn f<'a>(a: &'a &'a u8, b: &'a [&'static u8]) { 'x: loop { break 'x } a & b & c }",
            "let c = ['\\u{1F600}', '\\n', 'x', '\\\\']; let l: &'static str;",
            "macro_rules! m { ($a:ident, $($b:expr),*) => { #[doc = $a] fn $a() { $($b != 1);* } } }",
            "macro_rules! m { ($v:expr, $i:expr) => { $v[$i] == $i; $v[$i + 1] = 0; [$i == 0] } }",
            "use std::env::args; fn f(include: bool) -> impl Sized + use<> { include as u8 }",
            "#[doc = \"[path]\"] struct A { path: [u8; 3] }",
        ] {
            assert_eq!(found(code), [""; 0], "{code}");
        }
    }

    #[test]
    fn what_is_no_rust_ends() {
        for code in [
            "\"",
            "'",
            "/*",
            "r#\"",
            "'\\",
            "r#",
            "#![",
            "\u{feff}é'é",
            "b'",
        ] {
            found(code);
        }
    }
}
