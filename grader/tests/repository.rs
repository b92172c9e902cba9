//! Habits of the repository: subjects of commits, rights of workflows, the oldest compilers.

use crate::student_loop::root;
use std::fs;
use std::path::PathBuf;

#[cfg(unix)]
#[test]
fn the_hook_takes_a_subject_with_a_scope_and_at_most_72_characters() {
    let message = tempfile::NamedTempFile::new().expect("a file");
    let accepts = |subject: &str| {
        fs::write(
            message.path(),
            format!("# A comment\n\n{subject}\n\nWhy.\n"),
        )
        .expect("it is ours");
        let output = std::process::Command::new(root().join(".ci/hooks/commit-msg"))
            .arg(message.path())
            .current_dir(root())
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
fn workflows() -> Vec<(PathBuf, String)> {
    let folders = [
        ".github/workflows",
        "grader/authoring/src/term/new",
        "grader/export/templates/actions",
    ];
    let files = folders.iter().flat_map(|folder| {
        let entries = fs::read_dir(root().join(folder)).expect("a folder");
        entries.map(|entry| entry.expect("an entry").path())
    });
    let workflows = files.filter(|path| path.extension().is_some_and(|end| end == "yml"));
    workflows
        .map(|path| (path.clone(), fs::read_to_string(&path).expect("text")))
        .collect()
}

#[test]
fn workflows_have_few_rights_and_keep_no_credentials() {
    let workflows = workflows();
    assert!(workflows.len() >= 8, "{workflows:?}");
    for (path, text) in workflows {
        let path = path.display();
        assert!(text.contains("\npermissions:\n  contents: "), "{path}");
        for (at, _) in text.match_indices("actions/checkout@") {
            let step = text[at..].split("\n      - ").next().expect("the step");
            assert!(
                step.contains("persist-credentials: false"),
                "{path}: {step}"
            );
        }
    }
}

/// Every manifest that names a compiler is one that this step builds with.
#[test]
fn the_oldest_compilers_are_tested() {
    let read = |file: &str| fs::read_to_string(root().join(file)).expect("a file");
    let step = read(".ci/steps/oldest");
    let named = step
        .lines()
        .filter_map(|line| line.split_once("version_of ")?.1.split_once(".toml)"));
    let mut named: Vec<String> = named.map(|(file, _)| format!("{file}.toml")).collect();
    named.sort();
    let command = ["grep", "-l", "^rust-version = ", "--", "*Cargo.toml"];
    let found = std::process::Command::new("git")
        .args(command)
        .current_dir(root())
        .output();
    let found = String::from_utf8(found.expect("git searches").stdout).expect("paths are text");
    assert_eq!(named, found.lines().collect::<Vec<_>>());
    assert!(read(".github/workflows/ci.yml").contains(".ci/steps/oldest"));
    assert!(read(".ci/nightly").contains(".ci/steps/oldest"));
}

/// The anchor of a heading, as GitHub makes it.
fn anchor(heading: &str) -> String {
    let is_kept = |c: &char| c.is_alphanumeric() || [' ', '-', '_'].contains(c);
    let kept = heading
        .trim()
        .to_lowercase()
        .chars()
        .filter(is_kept)
        .collect::<String>();
    kept.replace(' ', "-")
}

/// The links of the documents, apart from the book, whose links `cargo test -p book` follows, and
/// from templates.
#[test]
fn links_of_documents_lead_to_files_and_headings() {
    assert_eq!(anchor("I want to add …"), "i-want-to-add-");
    let command = [
        "ls-files",
        "--cached",
        "--others",
        "--exclude-standard",
        "--",
        "*.md",
    ];
    let listed = std::process::Command::new("git")
        .args(command)
        .current_dir(root())
        .output();
    let listed = String::from_utf8(listed.expect("git lists the files").stdout);
    let listed = listed.expect("paths are text");
    let read = |path: &PathBuf| fs::read_to_string(path).unwrap_or_default();
    let mut links = 0;
    for document in listed.lines().filter(|path| !path.contains("/src/")) {
        let path = root().join(document);
        let text = read(&path);
        let prose: String = text.split("```").step_by(2).collect();
        let targets = prose
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next());
        for link in targets.filter(|link| !link.contains("://")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let file = match file {
                "" => path.clone(),
                _ => path.with_file_name(file),
            };
            assert!(file.exists(), "{document} links to {link}");
            let lines = read(&file);
            let mut headings = lines.lines().filter(|line| line.starts_with('#'));
            let is_there = |line: &str| anchor(line.trim_start_matches('#')) == heading;
            assert!(
                heading.is_empty() || headings.any(is_there),
                "{document}: no heading {link}"
            );
            links += 1;
        }
    }
    assert!(links > 80, "only {links} links were found");
}
