//! A closed pipe ends no program with a panic: every program prints with the macros of `base`.

use std::path::{Path, PathBuf};

/// Crates whose programs run the code under test: their output is a pipe of the grader's, and what
/// the code under test prints is its own. And `damage`, of which only tests print something, what
/// cargo runs while it builds, and an example that only a nightly step calls.
const NO_PROGRAMS: [&str; 7] = [
    "grader/damage",
    "grader/handout/src/build_script.rs",
    "grader/harness",
    "grader/mutants",
    "grader/sandbox",
    "grader/worker",
    "scenes/examples",
];

/// The macros of the standard library, which panic if the output is a closed pipe.
const PANICKING: [&str; 4] = ["println!(", "print!(", "eprintln!(", "eprint!("];

/// The Rust files below `folder` that are compiled into libraries and programs, not into tests.
fn product_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder that can be read") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy();
        if path.is_dir() {
            let is_left_out = ["tests", "benches", "fuzz", "target"].contains(&&*name);
            if !is_left_out && !name.starts_with('.') {
                product_files(&path, files);
            }
        } else if name.ends_with(".rs") && name != "tests.rs" {
            files.push(path);
        }
    }
}

#[test]
fn every_program_prints_with_the_macros_of_this_crate() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["grader", "scenes", "stages"] {
        product_files(&root.join(folder), &mut files);
    }
    assert!(files.len() > 300, "too few files: {}", files.len());
    let mut found = Vec::new();
    for file in files {
        let path = file.strip_prefix(&root).expect("a file of the workspace");
        if NO_PROGRAMS.iter().any(|folder| path.starts_with(folder)) {
            continue;
        }
        let text = std::fs::read_to_string(&file).expect("Rust code is text");
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        for (number, line) in code.lines().enumerate() {
            let is_call = |name: &str| {
                let at = line.find(name);
                // Not the end of a longer name, nor code that is quoted.
                at.is_some_and(|at| {
                    !line[..at].ends_with(|c: char| c.is_alphanumeric() || c == '`')
                })
            };
            if !line.trim_start().starts_with("//") && PANICKING.iter().any(|name| is_call(name)) {
                found.push(format!(
                    "{}:{}: {}",
                    path.display(),
                    number + 1,
                    line.trim()
                ));
            }
        }
    }
    assert!(
        found.is_empty(),
        "`outln!`, `out!`, `errln!` and `err!` of `base` do not panic when nobody reads:\n{}",
        found.join("\n")
    );
}
