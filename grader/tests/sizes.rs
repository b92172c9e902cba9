//! What grows with every mistake that somebody finds has a bound.

use std::fs;
use std::path::{Path, PathBuf};

/// The most lines of one task's list of mistakes, and of all lists together.
const MOST_LINES: usize = 1_700;
const MOST_LINES_OF_ALL: usize = 20_000;

/// The files below `folder` that end in `.txt` or `.toml`, apart from the correct variants.
fn lists(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder can be read");
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() && !path.ends_with("variants") {
            files.extend(lists(&path));
        } else if path
            .extension()
            .is_some_and(|end| end == "txt" || end == "toml")
        {
            files.push(path);
        }
    }
    files
}

/// A mistake that is another form of a known one is nested under it; a slip that `grader mutants
/// --families` makes by itself needs no entry.
#[test]
fn lists_of_mistakes_stay_short() {
    let mut all = 0;
    for list in lists(&Path::new(env!("CARGO_MANIFEST_DIR")).join("mutants")) {
        let text = fs::read_to_string(&list).expect("the list is text");
        let lines = text.lines().count();
        assert!(
            lines <= MOST_LINES,
            "{} has {lines} lines, more than {MOST_LINES}: nest forms, merge what has one hint",
            list.display()
        );
        all += lines;
    }
    assert!(
        (5_000..MOST_LINES_OF_ALL).contains(&all),
        "all lists of mistakes have {all} lines, and may have {MOST_LINES_OF_ALL}"
    );
}
