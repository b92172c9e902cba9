//! Removes what a handout, or a folder to build submissions in, leaves out from manifests.
//!
//! Works line by line, so that the other lines keep their order and comments.

use crate::members::Member;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Leaves the crates `kept` alone in the workspace's `Cargo.toml`: lists the folders of these
/// `members`, which globs name in the course, and removes the paths of the others.
pub fn with_members(text: &str, members: &[Member], kept: &BTreeSet<&str>) -> String {
    let is_kept = |member: &&Member| kept.contains(member.name.as_str());
    let removed: Vec<String> = members
        .iter()
        .filter(|member| !is_kept(member))
        .map(|member| format!("path = \"{}\"", member.folder.display()))
        .collect();
    let with_lists = text
        .lines()
        .filter(|line| !removed.iter().any(|path| line.contains(path)))
        .flat_map(|line| [line, "\n"])
        .collect::<String>();
    let folders = members.iter().filter(is_kept);
    let entries: String = folders.map(|member| entry(&member.folder)).collect();
    let (before, after) = around_list(&with_lists, "members");
    let text = format!("{before}members = [\n{entries}]\n{after}");
    without_default_members(&text)
}

/// An entry of a list of folders.
fn entry(folder: &Path) -> String {
    format!("    \"{}\",\n", folder.display())
}

/// The text before the list `name`, which starts a line, and the text after the list. If there is
/// no such list, all of the text is before it.
fn around_list<'a>(text: &'a str, name: &str) -> (&'a str, &'a str) {
    let start = format!("\n{name} = [");
    let Some(at) = text.find(&start).map(|at| at + 1) else {
        return (text, "");
    };
    let list = &text[at..];
    let end = list.find("]\n").map_or(list.len(), |end| end + 2);
    (&text[..at], &list[end..])
}

/// Removes the rules `NAME.SETTING = VALUE` of `[profile.PROFILE.package]` about packages that the
/// lock file `lock` does not name: cargo warns of them at every command.
pub fn without_unused_profiles(text: &str, lock: &str) -> String {
    let mut inside = false;
    let kept = text.lines().filter(|line| {
        if line.starts_with('[') {
            inside = line.starts_with("[profile.") && line.trim_end().ends_with(".package]");
        }
        let name = line.split_once('.').map(|(name, _)| name);
        let is_of_package = |name: &str| {
            let is_name = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
            !name.is_empty() && name.chars().all(is_name)
        };
        let package = name.filter(|name| inside && is_of_package(name));
        package.is_none_or(|name| lock.contains(&format!("name = \"{name}\"\n")))
    });
    kept.flat_map(|line| [line, "\n"]).collect()
}

/// Libraries that only tests and benches in separate folders use, never unit tests in `src`.
const FOR_TESTS: [&str; 2] = ["cargo_metadata", "snapbox"];

/// Removes the `[[test]]`, `[[bench]]` and `[[example]]` tables from a crate's `Cargo.toml`, the
/// libraries that only they use, and `autotests` with its comment.
pub fn without_tests(text: &str) -> String {
    let mut dropping = false;
    let mut kept: Vec<&str> = Vec::new();
    for line in text.lines() {
        if line.starts_with('[') {
            dropping = ["[[test]]", "[[bench]]", "[[example]]"]
                .iter()
                .any(|table| line.starts_with(table));
        }
        if line.starts_with("autotests") {
            kept.pop_if(|line| line.starts_with('#'));
        } else if !dropping && !FOR_TESTS.iter().any(|name| line.starts_with(name)) {
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
/// refuses a program `build`, for example). It has no build script, which is for tests.
pub fn only_library(text: &str) -> String {
    let without = text.replace(BUILD_SCRIPT, "");
    without.replacen("[package]\n", "[package]\nautobins = false\n", 1)
}

/// The line of a stage's `Cargo.toml` in a handout with the build script of all stages.
const BUILD_SCRIPT: &str = "build = \"../open_tasks.rs\"\n";

/// Adds the build script of a handout, which says which worked examples `cargo test` ignores, to
/// the `Cargo.toml` of a stage.
pub fn with_build_script(text: &str) -> String {
    let without = text.replace(BUILD_SCRIPT, "");
    without.replacen("[package]\n", &format!("[package]\n{BUILD_SCRIPT}"), 1)
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
    let entries: String = folders.iter().map(|folder| entry(folder)).collect();
    let (_, after) = around_list(text, "members");
    let before = &text[..text.len() - after.len()];
    format!(
        "{before}# What `cargo test` tests. For all other crates: `cargo test --workspace`.\ndefault-members = [\n{entries}]\n{after}"
    )
}

/// Removes the list of default members, with its comment.
fn without_default_members(text: &str) -> String {
    let (before, after) = around_list(text, "default-members");
    if after.is_empty() {
        return text.to_string();
    }
    let mut before: Vec<&str> = before.lines().collect();
    while before.last().is_some_and(|line| line.starts_with('#')) {
        before.pop();
    }
    let before: String = before.into_iter().flat_map(|line| [line, "\n"]).collect();
    before + after
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
    fn a_build_script_is_added_once_and_left_out_of_a_library() {
        let text = "[package]\nname = \"a\"\n";
        let with = with_build_script(text);
        assert_eq!(
            with,
            "[package]\nbuild = \"../open_tasks.rs\"\nname = \"a\"\n"
        );
        assert_eq!(with_build_script(&with), with);
        assert_eq!(
            only_library(&with),
            "[package]\nautobins = false\nname = \"a\"\n"
        );
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
        let text = "[profile.dev.package]\n\"*\".debug = 0\n# why. here\ngone.opt-level = 0\nkept.opt-level = 0\n\n[profile.dev]\nopt-level = 1\n";
        let expected = "[profile.dev.package]\n\"*\".debug = 0\n# why. here\nkept.opt-level = 0\n\n[profile.dev]\nopt-level = 1\n";
        let lock = "[[package]]\nname = \"kept\"\nversion = \"1.0.0\"\n";
        assert_eq!(without_unused_profiles(text, lock), expected);
    }

    #[test]
    fn the_crates_that_are_kept_are_listed_and_the_others_have_no_path() {
        let member = |name: &str, folder: &str| Member {
            name: name.into(),
            folder: folder.into(),
            imports: Vec::new(),
            test_imports: Vec::new(),
        };
        let members = [member("a", "a"), member("b", "a/b"), member("c", "c")];
        let text = "[workspace]\nmembers = [\"a\", \"a/[!x]*\", \"c\"]\n# Not b.\ndefault-members = [\n    \"a\",\n]\n\n[workspace.dependencies]\na = { path = \"a\" }\nb = { path = \"a/b\" }\nd = \"1\"\n";
        let expected = "[workspace]\nmembers = [\n    \"a\",\n    \"c\",\n]\n\n[workspace.dependencies]\na = { path = \"a\" }\nd = \"1\"\n";
        assert_eq!(
            with_members(text, &members, &BTreeSet::from(["a", "c"])),
            expected
        );
    }

    #[test]
    fn only_tests_and_benches_are_removed() {
        let text = "[package]\nname = \"a\"\n# One program.\nautotests = false\n\n[dev-dependencies]\nsnapbox.workspace = true\n\n[[bench]]\nname = \"b\"\nharness = false\n\n[lints]\nworkspace = true\n\n[[test]]\nname = \"t\"\n";
        let expected =
            "[package]\nname = \"a\"\n\n[dev-dependencies]\n\n[lints]\nworkspace = true\n";
        assert_eq!(without_tests(text), expected);
    }
}
