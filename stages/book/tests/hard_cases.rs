//! The chapter of hard cases lists every `Hard case N` of the code, and the test that holds it.

use book::chapter::Chapter;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The folders whose code may refer to a hard case.
const FOLDERS: [&str; 4] = ["stages", "scenes", "grader", "golden"];

/// A test, as the chapter names it: its name and its file.
type Tests = BTreeMap<u32, Vec<String>>;

fn root() -> PathBuf {
    let workspace = base::Workspace::above(book::folder());
    workspace.expect("the book is in the project").root().into()
}

/// The Rust files below a folder, in order.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    let below = paths.into_iter().flat_map(|path| match path.is_dir() {
        true if path.ends_with("target") => Vec::new(),
        true => sources(&path),
        false => vec![path],
    });
    below
        .filter(|path| path.extension().is_some_and(|of| of == "rs"))
        .collect()
}

/// The numbers in `Hard case 7`, `Hard cases 17, 18 and 19` or `Hard cases 14 to 16`, at the start
/// of a text that follows `Hard case`.
fn numbers(text: &str) -> Vec<u32> {
    let mut all: Vec<u32> = Vec::new();
    let mut is_range = false;
    for word in text.trim_start_matches('s').split_whitespace() {
        let digits = word.trim_end_matches(|letter: char| !letter.is_ascii_digit());
        match (word, digits.parse::<u32>()) {
            ("and", _) => {}
            ("to", _) => is_range = true,
            (_, Ok(number)) => {
                let first = if is_range {
                    all[all.len() - 1] + 1
                } else {
                    number
                };
                all.extend(first..=number);
                is_range = false;
                if digits.len() < word.len() && !word.ends_with(',') {
                    break;
                }
            }
            _ => break,
        }
    }
    all
}

/// The name of the function that begins after `fn ` at the start of `text`.
fn name(text: &str) -> &str {
    text.split(['(', '<']).next().unwrap_or_default().trim()
}

/// The tests of the hard cases in a source file.
fn tests_in(path: &str, source: &str, found: &mut Tests) {
    for (at, mark) in source.match_indices("Hard case") {
        let after = source[at + mark.len()..]
            .replace("\n///", " ")
            .replace("\n    ///", " ");
        let all = numbers(&after);
        if all.is_empty() {
            continue;
        }
        let line = source[..at].rfind('\n').map_or(0, |end| end + 1);
        let is_doc = source[line..].trim_start().starts_with("///");
        // A comment in a function belongs to that function, a doc comment to the next one.
        let function = match is_doc {
            true => source[at..].find("fn ").map(|start| at + start),
            false => source[..at].rfind("fn "),
        };
        let function =
            function.unwrap_or_else(|| panic!("{path}: no test at {}", &source[line..at]));
        let name = name(&source[function + 3..]);
        // The attributes of a function are in the lines directly above it.
        let mut attributes = source[..function]
            .lines()
            .rev()
            .map(str::trim)
            .skip_while(|line| line.is_empty())
            .take_while(|line| line.starts_with("#["));
        let is_test = attributes.any(|attribute| attribute == "#[test]");
        assert!(is_test, "{path}: `{name}` is no test");
        let test = format!("`{name}` in `{path}`");
        for number in all {
            let tests = found.entry(number).or_default();
            if !tests.contains(&test) {
                tests.push(test.clone());
            }
        }
    }
}

#[test]
fn every_hard_case_of_the_code_is_listed_with_its_tests() {
    let root = root();
    let this_file = Path::new("stages/book/tests/hard_cases.rs");
    let mut found = Tests::new();
    for path in FOLDERS
        .iter()
        .flat_map(|folder| sources(&root.join(folder)))
    {
        if path.ends_with(this_file) {
            continue;
        }
        let source = fs::read_to_string(&path).expect("a source file");
        let below = path.strip_prefix(&root).expect("it is below the root");
        tests_in(
            &below.to_string_lossy().replace('\\', "/"),
            &source,
            &mut found,
        );
    }
    let chapter = Chapter::read(Path::new("hard-cases.md")).expect("the chapter");
    let rows = chapter.text.lines().filter_map(|line| {
        let cells: Vec<&str> = line
            .strip_prefix("| ")?
            .strip_suffix(" |")?
            .split(" | ")
            .collect();
        let number: u32 = cells.first()?.parse().ok()?;
        Some((number, cells.last()?.to_string()))
    });
    let listed: Vec<(u32, String)> = rows.collect();
    let numbers: Vec<u32> = listed.iter().map(|(number, _)| *number).collect();
    let last = numbers.len() as u32;
    assert_eq!(
        numbers,
        (1..=last).collect::<Vec<_>>(),
        "the rows of hard-cases.md"
    );
    for (number, tests) in &listed {
        let expected = found
            .get(number)
            .map(|tests| tests.join(", "))
            .unwrap_or_else(|| panic!("no test says `Hard case {number}`"));
        assert_eq!(
            tests, &expected,
            "hard-cases.md, case {number}: the tests that name it"
        );
    }
    for (number, tests) in &found {
        let is_listed = (1..=last).contains(number);
        assert!(
            is_listed,
            "hard-cases.md has no case {number}, of {}",
            tests.join(", ")
        );
    }
}

#[test]
fn numbers_of_hard_cases_are_read() {
    for (text, expected) in [
        (" 7. Two triangles", &[7][..]),
        ("s 17, 18 and 19. At 5", &[17, 18, 19]),
        ("s 14 to 16. Without", &[14, 15, 16]),
        (" 48: `d` of any", &[48]),
        (" 90", &[90]),
        (" 82, and two more", &[82]),
    ] {
        assert_eq!(numbers(text), expected, "{text}");
    }
}
