//! Removes the crates and targets that a handout leaves out from manifests.
//!
//! Works line by line, so that the other lines keep their order and comments.

use std::path::{Path, PathBuf};

/// Removes the members in the folders `left_out` from the workspace's `Cargo.toml`.
pub fn without_members(text: &str, left_out: &[PathBuf]) -> String {
    let names = |line: &str, folder: &Path| {
        let folder = folder.to_string_lossy();
        let line = line.trim();
        // An entry of `members`, or of `[workspace.dependencies]`.
        line.trim_end_matches(',') == format!("\"{folder}\"")
            || line.contains(&format!("path = \"{folder}\""))
    };
    let kept = text
        .lines()
        .filter(|line| !left_out.iter().any(|folder| names(line, folder)));
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// Removes the tables `[profile.PROFILE.package.NAME]` of packages that the lock file `lock` does
/// not name: cargo warns of them at every command.
pub fn without_unused_profiles(text: &str, lock: &str) -> String {
    let is_unused = |table: &str| {
        let name = table
            .strip_prefix("[profile.")
            .and_then(|rest| rest.split_once(".package."))
            .and_then(|(_, name)| name.strip_suffix(']'));
        name.is_some_and(|name| name != "\"*\"" && !lock.contains(&format!("name = \"{name}\"\n")))
    };
    let mut dropping = false;
    let kept = text.lines().filter(|line| {
        if line.starts_with('[') {
            dropping = is_unused(line.trim_end());
        }
        !dropping
    });
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// Libraries that only tests and benches in separate folders use, never unit tests in `src`.
const FOR_TESTS: [&str; 3] = ["criterion", "cargo_metadata", "snapbox"];

/// Removes the `[[test]]`, `[[bench]]` and `[[example]]` tables from a crate's `Cargo.toml`, and
/// the libraries that only they use.
pub fn without_tests(text: &str) -> String {
    let mut dropping = false;
    let mut kept: Vec<&str> = Vec::new();
    for line in text.lines() {
        if line.starts_with('[') {
            dropping = ["[[test]]", "[[bench]]", "[[example]]"]
                .iter()
                .any(|table| line.starts_with(table));
        }
        if !dropping && !FOR_TESTS.iter().any(|name| line.starts_with(name)) {
            kept.push(line);
        }
    }
    while kept.last().is_some_and(|line| line.trim().is_empty()) {
        kept.pop();
    }
    kept.iter().flat_map(|line| [line, "\n"]).collect()
}

/// The `Cargo.toml` of a crate of which only the library is built: a file `src/bin/x.rs` or
/// `src/main.rs` that a student hands in would be a program otherwise, with rules of its own (cargo
/// refuses a program `build`, for example).
pub fn only_library(text: &str) -> String {
    text.replacen("[package]\n", "[package]\nautobins = false\n", 1)
}

/// Removes the development dependencies from a crate's `Cargo.toml` for which `is_used` is false.
pub fn without_unused_dev_dependencies(text: &str, is_used: impl Fn(&str) -> bool) -> String {
    let mut inside = false;
    let kept = text.lines().filter(|line| {
        if line.starts_with('[') {
            inside = line.trim_end() == "[dev-dependencies]";
        }
        let name = line.split(['.', ' ', '=']).next().unwrap_or_default();
        !inside || line.starts_with('[') || name.is_empty() || is_used(name)
    });
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// Sets the list of the folders that `cargo test` tests in the workspace's `Cargo.toml`, after its
/// members.
pub fn with_default_members(text: &str, folders: &[PathBuf]) -> String {
    let text = &without_default_members(text);
    let entries = folders.iter();
    let entries: String = entries
        .map(|folder| format!("    \"{}\",\n", folder.display()))
        .collect();
    let list = format!(
        "# What `cargo test` tests. For all other crates: `cargo test --workspace`.\ndefault-members = [\n{entries}]\n"
    );
    match text.split_once("\n]\n") {
        Some((members, rest)) => format!("{members}\n]\n{list}{rest}"),
        None => text.to_string(),
    }
}

/// Removes the list of default members, with its comment.
fn without_default_members(text: &str) -> String {
    let Some((before, list)) = text.split_once("default-members = [\n") else {
        return text.to_string();
    };
    let mut before: Vec<&str> = before.lines().collect();
    while before.last().is_some_and(|line| line.starts_with('#')) {
        before.pop();
    }
    let rest = list.split_once("]\n").map_or("", |(_, rest)| rest);
    let before: String = before.into_iter().flat_map(|line| [line, "\n"]).collect();
    before + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn development_dependencies_that_no_code_names_are_removed() {
        let text = "[dependencies]\na.workspace = true\n\n[dev-dependencies]\na-b.workspace = true\nc = \"1\"\n\n[lints]\nworkspace = true\n";
        let expected = "[dependencies]\na.workspace = true\n\n[dev-dependencies]\na-b.workspace = true\n\n[lints]\nworkspace = true\n";
        let is_used = |name: &str| name == "a-b";
        assert_eq!(without_unused_dev_dependencies(text, is_used), expected);
    }

    #[test]
    fn default_members_follow_the_members() {
        let text = "[workspace]\nmembers = [\n    \"a\",\n    \"b\",\n]\n\n[workspace.package]\n";
        let expected = "[workspace]\nmembers = [\n    \"a\",\n    \"b\",\n]\n# What `cargo test` tests. For all other crates: `cargo test --workspace`.\ndefault-members = [\n    \"b\",\n]\n\n[workspace.package]\n";
        let with = |text| with_default_members(text, &[PathBuf::from("b")]);
        assert_eq!(with(text), expected);
        assert_eq!(with(expected), expected);
    }

    #[test]
    fn profiles_of_packages_that_are_gone_are_removed() {
        let text = "[profile.dev.package.\"*\"]\ndebug = 0\n\n[profile.dev.package.gone]\nopt-level = 0\n\n[profile.dev.package.kept]\nopt-level = 0\n";
        let expected =
            "[profile.dev.package.\"*\"]\ndebug = 0\n\n[profile.dev.package.kept]\nopt-level = 0\n";
        let lock = "[[package]]\nname = \"kept\"\nversion = \"1.0.0\"\n";
        assert_eq!(without_unused_profiles(text, lock), expected);
    }

    #[test]
    fn a_member_is_removed_from_members_and_dependencies() {
        let text = "members = [\n    \"a\",\n    \"a/b\",\n]\n\n[workspace.dependencies]\na = { path = \"a\" }\nb = { path = \"a/b\" }\nc = \"1\"\n";
        let expected = "members = [\n    \"a\",\n]\n\n[workspace.dependencies]\na = { path = \"a\" }\nc = \"1\"\n";
        assert_eq!(without_members(text, &[PathBuf::from("a/b")]), expected);
    }

    #[test]
    fn only_tests_and_benches_are_removed() {
        let text = "[package]\nname = \"a\"\n\n[dev-dependencies]\ncriterion.workspace = true\n\n[[bench]]\nname = \"b\"\nharness = false\n\n[lints]\nworkspace = true\n\n[[test]]\nname = \"t\"\n";
        let expected =
            "[package]\nname = \"a\"\n\n[dev-dependencies]\n\n[lints]\nworkspace = true\n";
        assert_eq!(without_tests(text), expected);
    }
}
