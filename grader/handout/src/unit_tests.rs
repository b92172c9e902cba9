//! Removes the unit tests of crates that students only use from a handout: they are an eighth of
//! its source, and `cargo test` there runs the tests of the stages alone.

use base::GraderError;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A source file without the items for tests.
pub(super) struct WithoutTests {
    /// Its text.
    pub(super) text: String,
    /// The files of modules for tests that it named.
    pub(super) files: Vec<PathBuf>,
}

/// How the attribute of an item for tests begins, written without spaces. After `all(test,` stands
/// the system or the feature that the tests need, too.
const FOR_TESTS: [&str; 2] = ["cfg(test)", "cfg(all(test,"];

/// Removes the items of a file that are marked with `#[cfg(test)]` or `#[cfg(all(test, …))]`.
/// `path` is that of the file.
pub(super) fn remove(path: &Path, text: &str) -> Result<WithoutTests, GraderError> {
    let mut files = Vec::new();
    // Reading the tokens of all files of a handout takes a second.
    if !FOR_TESTS.iter().any(|start| text.contains(start)) {
        let text = text.to_string();
        return Ok(WithoutTests { text, files });
    }
    let mut removed = BTreeSet::new();
    let items = items(text).ok_or_else(|| GraderError::file("parse", path, "it is no Rust"))?;
    for item in items.into_iter().filter(|item| item.is_for_tests) {
        removed.extend(item.lines);
        let file = item.module.map(|name| format!("{name}.rs"));
        files.extend(file.map(|file| folder_of_modules(path).join(file)));
    }
    if removed.is_empty() {
        let text = text.to_string();
        return Ok(WithoutTests { text, files });
    }
    let mut kept: Vec<&str> = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let is_removed = removed.contains(&number);
        // Of the blank lines around an item one is enough, and none at the ends of the file.
        let is_second_blank = line.is_empty() && kept.last().is_none_or(|last| last.is_empty());
        if !is_removed && !is_second_blank {
            kept.push(line);
        }
    }
    while kept.last().is_some_and(|last| last.is_empty()) {
        kept.pop();
    }
    let text = kept.join("\n") + "\n";
    Ok(WithoutTests { text, files })
}

/// An item at the top level of a file.
struct Item {
    /// Its lines, attributes and documentation included.
    lines: RangeInclusive<usize>,
    is_for_tests: bool,
    /// The name of the module, if it is one whose contents are in another file.
    module: Option<String>,
}

/// The items at the top level of a file; `None` if it is no Rust.
fn items(text: &str) -> Option<Vec<Item>> {
    let mut items = Vec::new();
    let mut start = None;
    let mut is_for_tests = false;
    let mut words: Vec<String> = Vec::new();
    let mut tokens = TokenStream::from_str(text).ok()?.into_iter().peekable();
    while let Some(token) = tokens.next() {
        let first = *start.get_or_insert(token.span().start().line);
        let line = token.span().end().line;
        let is_end = match &token {
            TokenTree::Punct(punct) if punct.as_char() == '#' => {
                // `#![…]` is about the file.
                let is_inner =
                    |next: &TokenTree| matches!(next, TokenTree::Punct(p) if p.as_char() == '!');
                let is_of_file = tokens.next_if(is_inner).is_some();
                if let Some(TokenTree::Group(attribute)) = tokens.next() {
                    let text = attribute.stream().to_string();
                    let unspaced: String = text.split_whitespace().collect();
                    let is_of_tests = FOR_TESTS.iter().any(|start| unspaced.starts_with(start));
                    is_for_tests |= !is_of_file && is_of_tests;
                }
                if is_of_file {
                    start = None;
                }
                false
            }
            TokenTree::Punct(punct) => punct.as_char() == ';',
            TokenTree::Group(group) => {
                group.delimiter() == Delimiter::Brace && ends_with_brace(&words)
            }
            TokenTree::Ident(word) => {
                words.push(word.to_string());
                false
            }
            TokenTree::Literal(_) => false,
        };
        if is_end {
            let is_elsewhere = matches!(token, TokenTree::Punct(_));
            let mut names = words.iter().skip_while(|word| *word != "mod");
            items.push(Item {
                lines: first..=line,
                is_for_tests,
                module: names.nth(1).filter(|_| is_elsewhere).cloned(),
            });
            (start, is_for_tests) = (None, false);
            words.clear();
        }
    }
    start.is_none().then_some(items)
}

/// Whether an item that begins with these words ends with a block, and not with a semicolon.
fn ends_with_brace(words: &[String]) -> bool {
    let mut words = words.iter().map(String::as_str);
    match words.find(|word| *word != "pub") {
        Some("const") => matches!(words.next(), Some("fn" | "async" | "unsafe" | "extern")),
        Some("use" | "static" | "type") => false,
        _ => true,
    }
}

/// The folder of the modules that the file `path` names without their contents.
fn folder_of_modules(path: &Path) -> PathBuf {
    let is_root = ["lib.rs", "main.rs", "mod.rs"]
        .iter()
        .any(|root| path.ends_with(root));
    match is_root {
        true => path.parent().unwrap_or(Path::new("")).to_path_buf(),
        false => path.with_extension(""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "//! Docs.\n\nmod a;\n#[cfg(test)]\nmod tests;\n\nfn f() {}\n\n#[cfg(test)]\nuse x::y;\n\n\
                        /// Docs.\n#[cfg(test)]\nimpl A {\n    fn g() {}\n}\n\nfn h() {}\n\n#[cfg(test)]\nmod more {\n    fn i() {}\n}\n";

    #[test]
    fn items_for_tests_are_removed_with_their_files() {
        let without = remove(Path::new("a/src/b.rs"), FILE).unwrap();
        assert_eq!(
            without.text,
            "//! Docs.\n\nmod a;\n\nfn f() {}\n\nfn h() {}\n"
        );
        assert_eq!(without.files, [PathBuf::from("a/src/b/tests.rs")]);
        let of_root = remove(Path::new("a/src/lib.rs"), FILE).unwrap();
        assert_eq!(of_root.files, [PathBuf::from("a/src/tests.rs")]);
    }

    #[test]
    fn tests_of_one_system_or_feature_are_removed() {
        let given =
            "#[cfg(not(test))]\nfn f() {}\n\n#[cfg(all(unix, feature = \"test\"))]\nfn g() {}\n";
        for of in ["unix", "feature = \"submissions\""] {
            let with_tests =
                format!("{given}\n#[cfg(all(test, {of}))]\nmod tests {{\n    fn h() {{}}\n}}\n");
            let without = remove(Path::new("a.rs"), &with_tests).unwrap();
            assert_eq!(without.text, given);
        }
    }

    #[test]
    fn blocks_inside_of_items_do_not_end_them() {
        let given = "use a::{b, c};\n\nconst A: B = B { c: 1 };\n\nconst fn f() {}\n\n\
                     impl<const N: usize> D<N> {}\n\npub const F: fn() = g;\n";
        let with_test = format!("{given}\n#[cfg(test)]\nconst T: B = B {{ c: 2 }};\n");
        let without = remove(Path::new("a.rs"), &with_test).unwrap();
        assert_eq!(without.text, given);
    }

    #[test]
    fn a_file_without_tests_stays_as_it_is() {
        let text = "fn f() {}\n\n\n// Two blank lines.\n";
        let without = remove(Path::new("a.rs"), text).unwrap();
        assert_eq!((without.text.as_str(), without.files.len()), (text, 0));
        assert!(remove(Path::new("a.rs"), "#[cfg(test)]\nfn").is_err());
    }
}
