//! What the scores of a class depend on besides the submissions: the course.

use crate::hash::{self, Hasher};
use base::GraderError;
use base::Workspace;
use files::file_tree;
use files::members;
use grader::course::Course;
use judge::Tier;
use std::collections::BTreeMap;
use std::path::Path;

/// The hashes of the parts of a course that scores depend on, by their names for people.
pub type CourseHash = BTreeMap<String, String>;

/// The parts: their names, and where their files begin. The first that fits counts.
const PARTS: [(&str, &[&str]); 4] = [
    (
        "the cases and rules in stages/course.toml",
        &["stages/course.toml"],
    ),
    ("the goldens and known mistakes", &["golden"]),
    ("the reference's stages", &["stages", "scenes"]),
    ("the grader", &["grader"]),
];

/// The name of what is in none of the [`PARTS`].
const LIBRARIES: &str = "the versions of the libraries";

/// Crates whose code decides scores, beside those that they depend on.
const DECIDING: [&str; 2] = ["worker", "submission"];

/// The list of tasks and cases.
const COURSE: &str = "stages/course.toml";

/// What the list says about the questions and how they are judged. Titles, conventions, dates and
/// points do not count: points are computed when tables are made.
fn without_points(mut course: Course) -> String {
    course.conventions.clear();
    course.term = None;
    for part in &mut course.parts {
        part.title.clear();
        for task in &mut part.tasks {
            task.title.clear();
            // Whether examples are read is not a matter of points.
            task.examples = task.examples.min(1.0).ceil();
            for case in &mut task.cases {
                (case.tier, case.points) = (Tier::Core, 0.0);
            }
        }
    }
    format!("{course:?}")
}

/// Computes the hashes. Text for people, such as the book, and tests do not count: a class is not
/// graded again because of them.
pub fn of(workspace: &Workspace) -> Result<CourseHash, GraderError> {
    let root = workspace.root();
    let members = members::read(root)?;
    let deciding = members::with_dependencies(&members, &DECIDING);
    let mut parts: BTreeMap<&str, Hasher> = BTreeMap::new();
    for path in file_tree::workspace_paths(root)? {
        let counts = match members::containing_member(&members, &path) {
            Some(owner) => {
                let inside = path.strip_prefix(&owner.folder).unwrap_or(&path);
                let is_test = members::TEST_FOLDERS
                    .iter()
                    .any(|test| inside.starts_with(test));
                !is_test && (owner.name == GOLDENS || deciding.contains(owner.name.as_str()))
            }
            None => [COURSE, "Cargo.toml", "Cargo.lock"]
                .iter()
                .any(|file| path == Path::new(file)),
        };
        if counts {
            let hasher = parts.entry(part_of(&path)).or_default();
            hasher.part(path.to_string_lossy().as_bytes());
            match path == Path::new(COURSE) {
                true => hasher.part(without_points(Course::read(workspace)?)),
                false => hasher.part(file_tree::read(root, &path)?),
            };
        }
    }
    let parts = parts.into_iter();
    Ok(parts
        .map(|(name, hasher)| (name.to_string(), hasher.finish()))
        .collect())
}

/// The crate of the goldens.
const GOLDENS: &str = "golden";

fn part_of(path: &Path) -> &'static str {
    let part = PARTS
        .iter()
        .find(|(_, starts)| starts.iter().any(|start| path.starts_with(start)));
    part.map_or(LIBRARIES, |(name, _)| name)
}

/// One hash of the whole course.
pub fn whole(course: &CourseHash) -> String {
    hash::of(course.iter().flat_map(|(name, hash)| [name, hash]))
}

/// The parts in which two courses differ.
pub fn differences<'a>(a: &'a CourseHash, b: &'a CourseHash) -> Vec<&'a str> {
    let names: std::collections::BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    let differ = names
        .into_iter()
        .filter(|name| a.get(*name) != b.get(*name));
    differ.map(String::as_str).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = include_str!("../../../stages/course.toml");

    fn hashed(text: &str) -> String {
        without_points(Course::parse(text).expect("a course"))
    }

    /// Of such changes no submission is compiled or run again: the keys of its units stay.
    #[test]
    fn points_words_and_dates_ask_no_other_question() {
        let case = "{ name = \"range\", tier = \"core\", points = 1.5 }";
        let other_points = LIST.replacen(
            case,
            "{ name = \"range\", tier = \"robust\", points = 4.5 }",
            1,
        );
        let other_words = LIST.replacen("title = \"", "title = \"The ", 1);
        let term = "\n[term]\nname = \"G\"\nwhen = \"S\"\nlate = { percent_per_day = 10 }\ndates = [{ part = 1, due = 2027-02-15 }]\n";
        for same in [other_points, other_words, format!("{LIST}{term}")] {
            assert_ne!(same, LIST);
            assert_eq!(hashed(&same), hashed(LIST));
        }
        let less = LIST.replacen(&format!("    {case},\n"), "", 1);
        assert_ne!(hashed(&less), hashed(LIST));
    }
}
