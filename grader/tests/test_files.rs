//! No test is left out: cargo runs what it finds by itself only where a manifest does not name its
//! targets.

use crate::sizes::files;
use crate::student_loop::root;
use cargo_metadata::{MetadataCommand, Package, TargetKind};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn packages() -> Vec<Package> {
    let metadata = MetadataCommand::new().no_deps().exec();
    metadata.expect("cargo metadata runs").packages
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The Rust files in the folder of the file `path` and below.
fn files_beside(path: &Path) -> Vec<PathBuf> {
    let [path, root] = [path, &root()].map(|path| path.canonicalize().expect("it exists"));
    let folder = path.parent().expect("a folder");
    let all = files(&[".rs"]).into_iter().map(|file| root.join(file));
    let beside: Vec<PathBuf> = all.filter(|file| file.starts_with(folder)).collect();
    assert!(beside.contains(&path), "{} is not listed", path.display());
    beside
}

/// The modules that the file `path` names.
fn modules(path: &Path) -> BTreeSet<String> {
    let text = read(path);
    let names = text.lines().filter_map(|line| line.strip_prefix("mod "));
    names
        .map(|name| name.trim_end_matches(';').to_string())
        .collect()
}

#[test]
fn every_test_file_is_a_module_of_the_program_that_runs_them() {
    let mut checked = 0;
    for package in packages() {
        let targets: Vec<PathBuf> = package
            .targets
            .iter()
            .filter(|target| target.kind == [TargetKind::Test])
            .map(|target| PathBuf::from(target.src_path.as_std_path()))
            .collect();
        let Some(main) = targets.iter().find(|path| path.ends_with("tests/main.rs")) else {
            continue;
        };
        let named = modules(main);
        for file in fs::read_dir(main.parent().expect("a folder")).expect("it can be read") {
            let path = file.expect("a file").path();
            let is_code = path.extension().is_some_and(|extension| extension == "rs")
                || path.join("mod.rs").exists()
                || path.join("main.rs").exists();
            if !is_code || targets.contains(&path) {
                continue;
            }
            let name = path.file_stem().expect("a name").to_string_lossy();
            assert!(
                named.contains(&*name),
                "{} is not run: add `mod {name};` to {}",
                path.display(),
                main.display()
            );
            checked += 1;
        }
    }
    assert!(checked > 25, "only {checked} files were found");
}

/// Unit tests of a library that has none would be compiled with all of it, and run nothing.
#[test]
fn a_library_that_is_not_tested_has_no_unit_tests() {
    for package in packages() {
        let libraries = package.targets.iter().filter(|t| t.is_lib() && !t.test);
        for library in libraries {
            for file in files_beside(library.src_path.as_std_path()) {
                let has_test = read(&file).contains("#[test]");
                assert!(!has_test, "{} has a test that never runs", file.display());
            }
        }
    }
}

/// Rustdoc reads all of a library to find its examples.
#[test]
fn a_library_whose_examples_are_not_tested_has_none() {
    for package in packages() {
        let libraries = package.targets.iter().filter(|t| t.is_lib() && !t.doctest);
        for library in libraries {
            for file in files_beside(library.src_path.as_std_path()) {
                let text = read(&file);
                let comments = text.lines().map(str::trim_start).filter_map(|line| {
                    line.strip_prefix("///")
                        .or_else(|| line.strip_prefix("//!"))
                });
                let fences = comments.filter_map(|line| line.trim_start().strip_prefix("```"));
                for language in fences.step_by(2) {
                    assert_eq!(
                        language,
                        "text",
                        "{} has an example that never runs",
                        file.display()
                    );
                }
            }
        }
    }
}

/// A program of some lines has no tests, and is not linked a second time for them.
#[test]
fn a_program_that_is_not_tested_has_no_tests() {
    for package in packages() {
        for target in &package.targets {
            if target.kind != [TargetKind::Bin] || target.test {
                continue;
            }
            let path = target.src_path.as_std_path();
            assert!(
                modules(path).is_empty() && !read(path).contains("#[test]"),
                "{} has tests or modules: remove `test = false` from {}",
                path.display(),
                package.manifest_path
            );
        }
    }
}
