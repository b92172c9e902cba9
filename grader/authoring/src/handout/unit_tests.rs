//! Removes the unit tests of crates that students only use from a handout: they are an eighth of
//! its source, and `cargo test` there runs the tests of the stages alone.

use base::GraderError;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::{Item, Meta};

/// A source file without the items for tests.
pub(super) struct WithoutTests {
    /// Its text.
    pub(super) text: String,
    /// The files of modules for tests that it named.
    pub(super) files: Vec<PathBuf>,
}

/// Removes the items of a file that are marked with `#[cfg(test)]`; `path` is the file's.
pub(super) fn remove(path: &Path, text: &str) -> Result<WithoutTests, GraderError> {
    let mut files = Vec::new();
    // Parsing all files of a handout takes a second.
    if !text.contains("cfg(test)") {
        let text = text.to_string();
        return Ok(WithoutTests { text, files });
    }
    let file = syn::parse_file(text).map_err(|e| GraderError::file("parse", path, e))?;
    let mut removed = BTreeSet::new();
    for item in file.items.iter().filter(|item| is_for_tests(item)) {
        let span = item.span();
        removed.extend(span.start().line..=span.end().line);
        if let Item::Mod(module) = item
            && module.content.is_none()
        {
            files.push(folder_of_modules(path).join(format!("{}.rs", module.ident)));
        }
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

fn is_for_tests(item: &Item) -> bool {
    let attributes = match item {
        Item::Mod(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Const(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        _ => return false,
    };
    attributes.iter().any(|attribute| {
        let Meta::List(list) = &attribute.meta else {
            return false;
        };
        list.path.is_ident("cfg") && list.tokens.to_string() == "test"
    })
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
    fn a_file_without_tests_stays_as_it_is() {
        let text = "fn f() {}\n\n\n// Two blank lines.\n";
        let without = remove(Path::new("a.rs"), text).unwrap();
        assert_eq!((without.text.as_str(), without.files.len()), (text, 0));
        assert!(remove(Path::new("a.rs"), "#[cfg(test)]\nfn").is_err());
    }
}
