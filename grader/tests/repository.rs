//! Habits of the repository: subjects of commits, rights of workflows, the oldest compilers, links
//! of the documents.

use crate::sizes::{files, files_of_git, read};
use crate::student_loop::root;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

#[cfg(unix)]
#[test]
fn the_hook_takes_a_subject_with_a_scope_and_at_most_72_characters() {
    if files_of_git().is_empty() {
        return; // It asks git for the names of crates.
    }
    let message = tempfile::NamedTempFile::new().expect("a file");
    let accepts = |subject: &str| {
        std::fs::write(
            message.path(),
            format!("# A comment\n\n{subject}\n\nWhy.\n"),
        )
        .expect("it is ours");
        let output = std::process::Command::new(root().join(".ci/hooks/commit-msg"))
            .arg(message.path())
            .current_dir(root())
            // Of a language that the machine does not have, the shell warns.
            .env("LC_ALL", "C")
            .output()
            .expect("the hook runs");
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(stderr.is_empty(), output.status.success(), "{stderr}");
        output.status.success()
    };
    let long = |count: usize| format!("judge: {}", "é".repeat(count));
    for subject in [
        "judge: rays that start on an edge",
        "judge, submission: an example",
        ".ci: one step less",
        "Merge world",
        &long(65),
    ] {
        assert!(accepts(subject), "{subject}");
    }
    for subject in [
        "rays that start on an edge",
        "judge:",
        "judge : a blank",
        "no_such_crate: rays",
        "judge, no_such_crate: rays",
        &long(66),
    ] {
        assert!(!accepts(subject), "{subject}");
    }
}

/// The workflows of this repository, and those that `grader` writes for others.
fn workflows() -> Vec<PathBuf> {
    let folders = [
        ".github/workflows",
        "grader/authoring/src/term/new",
        "grader/export/templates/actions",
    ];
    let is_one = |path: &PathBuf| folders.iter().any(|folder| path.starts_with(folder));
    files(&[".yml"]).into_iter().filter(is_one).collect()
}

#[test]
fn workflows_have_few_rights_and_keep_no_credentials() {
    let workflows = workflows();
    assert!(workflows.len() >= 8, "{workflows:?}");
    for path in workflows {
        let (text, path) = (read(&path), path.display());
        assert!(text.contains("\npermissions:\n  contents: "), "{path}");
        for (at, _) in text.match_indices("actions/checkout@") {
            let step = text[at..].split("\n      - ").next().expect("the step");
            let keeps_none = step.contains("persist-credentials: false");
            assert!(keeps_none, "{path}: {step}");
        }
    }
}

/// Every manifest that names a compiler is one that this step builds with.
#[test]
fn the_oldest_compilers_are_tested() {
    let step = read(Path::new(".ci/steps/oldest"));
    let named: BTreeSet<PathBuf> = step
        .lines()
        .filter_map(|line| line.split_once("version_of ")?.1.split_once(')'))
        .map(|(file, _)| PathBuf::from(file))
        .collect();
    let names_one = |path: &PathBuf| read(path).contains("\nrust-version = ");
    let manifests = files(&["Cargo.toml"]).into_iter().filter(names_one);
    assert_eq!(named, manifests.collect());
    for caller in [".github/workflows/ci.yml", ".ci/nightly"] {
        let calls = read(Path::new(caller)).contains(".ci/steps/oldest");
        assert!(calls, "{caller}");
    }
}

/// The anchor of a heading, as GitHub makes it.
fn anchor(heading: &str) -> String {
    let is_kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    let lower = heading.trim().to_lowercase();
    let kept: String = lower.chars().filter(is_kept).collect();
    kept.replace(' ', "-")
}

/// The links of the documents, apart from the book, whose links `cargo test -p book` follows, and
/// from templates.
#[test]
fn links_of_documents_lead_to_files_and_headings() {
    assert_eq!(anchor("I want to add …"), "i-want-to-add-");
    let documents = files(&[".md"]).into_iter();
    let mut links = 0;
    for path in documents.filter(|path| path.iter().all(|folder| folder != "src")) {
        let (text, document) = (read(&path), path.display());
        let prose: String = text.split("```").step_by(2).collect();
        let targets = prose.split("](").skip(1).filter_map(|rest| {
            let target = rest.split(')').next()?;
            (!target.contains("://")).then_some(target)
        });
        for link in targets {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let file = match file {
                "" => path.clone(),
                _ => path.with_file_name(file),
            };
            assert!(root().join(&file).exists(), "{document} links to {link}");
            let is_there = |line: &str| anchor(line.trim_start_matches('#')) == heading;
            let is_found = heading.is_empty() || read(&file).lines().any(is_there);
            assert!(is_found, "{document}: no heading {link}");
            links += 1;
        }
    }
    assert!(links > 80, "only {links} links were found");
}
