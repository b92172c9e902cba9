//! Which of a submission's other files are as the student was given them.

use files::manifest;
use grader::course::given::{self, GivenFiles};
use std::path::{Path, PathBuf};

/// Files of which every project has its own, or that cargo and the grader write.
const OF_THE_PROJECT: [&str; 4] = ["README.md", "Cargo.lock", "report.json", given::LIST];

/// Files that differ from the course's own in every handout, if the handout has no list.
const DIFFERS_IN_HANDOUTS: &str = "Cargo.toml";

/// Where files lie that decide points, if the handout has no list. The grader itself is not among
/// them: handouts contain it without its unit tests.
const DECIDING: [&str; 4] = [
    "stages/kit",
    "scenes/meshes",
    "stages/course.toml",
    "golden",
];

/// Larger files are not compared: no given file is as large.
const MAX_SIZE: u64 = 16 << 20;

/// The files that the student of a submission was given.
#[derive(Clone, Debug)]
pub(crate) struct Given<'a> {
    /// The list that its handout came with. Students can edit it, but only to hide from a person
    /// what is not graded.
    list: Option<GivenFiles>,
    /// The course's own workspace.
    trusted: &'a Path,
}

impl Given<'_> {
    /// Reads what the submission in `top`, with the folder `stages`, was given of the course in
    /// `trusted`.
    pub(crate) fn of<'a>(top: &Path, stages: &Path, trusted: &'a Path) -> Given<'a> {
        let above_stages = stages.parent().filter(|_| stages != top);
        let list = match above_stages {
            Some(folder) => GivenFiles::read(folder),
            None => GivenFiles::read_from(&top.join(list_in_stages())),
        };
        Given { list, trusted }
    }

    /// Whether the file `path` counts as unchanged: as the handout's list says, or because it equals
    /// the course's own file `name`, apart from the solutions and tests that handouts do not
    /// contain, or because `name` differs in every project.
    pub(crate) fn is_unchanged(&self, path: &Path, name: &Path) -> bool {
        let is = |other: &str| name == Path::new(other);
        if OF_THE_PROJECT.iter().any(|other| is(other)) {
            return true;
        }
        // A pipe or a device may never end.
        let is_small = |path: &Path| {
            let kind = path.symlink_metadata();
            kind.is_ok_and(|kind| kind.is_file() && kind.len() <= MAX_SIZE)
        };
        let Some(theirs) = is_small(path).then(|| std::fs::read(path).ok()).flatten() else {
            return false;
        };
        let known = self.list.as_ref();
        if let Some(is_original) = known.and_then(|list| list.is_original(name, &theirs)) {
            return is_original;
        }
        if is(DIFFERS_IN_HANDOUTS) {
            return true;
        }
        let Ok(ours) = std::fs::read(self.trusted.join(name)) else {
            return false;
        };
        let ours = String::from_utf8_lossy(&ours);
        let theirs = String::from_utf8_lossy(&theirs);
        theirs == ours
            || name.ends_with("Cargo.toml") && for_students(&theirs) == for_students(&ours)
            || is_carved(&theirs, &ours)
            || is_without_tests(&theirs, &ours)
    }

    /// Whether the points of a student's own run depend on the file `name`.
    pub(crate) fn decides(&self, name: &Path) -> bool {
        match &self.list {
            Some(list) => list.decides(name) || name.ends_with("build.rs"),
            None => {
                let is_deciding = DECIDING.iter().any(|start| name.starts_with(start));
                let is_manifest = name.starts_with("stages") && name.ends_with("Cargo.toml");
                (is_deciding || is_manifest) && self.trusted.join(name).is_file()
            }
        }
    }
}

/// The path of the list below the folder `stages`.
fn list_in_stages() -> PathBuf {
    let names = Path::new(given::LIST).iter().skip(1);
    names.collect()
}

/// What a crate's `Cargo.toml` says apart from tests and what only they need. Handouts leave out
/// some of it.
fn for_students(text: &str) -> Vec<String> {
    let text = manifest::without_tests(text);
    let text = manifest::without_unused_dev_dependencies(&text, |_| false);
    let lines = text.lines().map(str::trim_end);
    let kept = lines.filter(|line| !line.is_empty() && *line != "[dev-dependencies]");
    kept.map(str::to_owned).collect()
}

/// Whether `theirs` may be what carving left of `ours`, a file with solutions: each line of it is
/// also in `ours`, perhaps in a stub or with other line breaks.
fn is_carved(theirs: &str, ours: &str) -> bool {
    let without_spaces =
        |text: &str| -> String { text.chars().filter(|c| !c.is_whitespace()).collect() };
    let all_of_ours = without_spaces(&ours.replace("// STUB:", ""));
    ours.contains("// BEGIN SOLUTION(")
        && theirs
            .lines()
            .all(|line| all_of_ours.contains(&without_spaces(line)))
}

/// Whether `theirs` is `ours` without the unit tests at its end, which handouts do not contain.
fn is_without_tests(theirs: &str, ours: &str) -> bool {
    let rest = ours.strip_prefix(theirs.trim_end());
    rest.is_some_and(|rest| rest.trim_start().starts_with("#[cfg(test)]"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::file_tree;

    #[test]
    fn the_list_of_the_handout_says_what_was_changed() {
        let folder = tempfile::tempdir().unwrap();
        let write = |path: &str, text: &str| {
            let path = folder.path().join(path);
            file_tree::write(&path, text.as_bytes()).unwrap();
            path
        };
        let kit = Path::new("stages/kit/src/lib.rs");
        let viewer = Path::new("stages/viewer/src/main.rs");
        let mut list = GivenFiles::default();
        list.add(kit, b"fn f() {}\n", true);
        list.add(viewer, b"fn main() {}\n", false);
        write(given::LIST, &list.to_text());
        let at = |path: &Path, text: &str| write(&path.to_string_lossy(), text);
        // The course has another version now: the handout's counts.
        let stages = folder.path().join("stages");
        let nowhere = Path::new("/nowhere");
        let whole = Given::of(folder.path(), &stages, nowhere);
        let only_stages = Given::of(&stages, &stages, nowhere);
        for given in [whole, only_stages] {
            assert!(given.is_unchanged(&at(kit, "fn f() {}\r\n"), kit));
            assert!(!given.is_unchanged(&at(kit, "fn g() {}\n"), kit));
            assert!(!given.is_unchanged(&at(viewer, "fn g() {}\n"), viewer));
            assert!(given.decides(kit) && !given.decides(viewer));
            assert!(!given.decides(Path::new("stages/kit/src/mine.rs")));
        }
    }

    #[test]
    fn without_a_list_the_course_says_it() {
        let trusted = tempfile::tempdir().unwrap();
        let kit = Path::new("stages/kit/src/lib.rs");
        let ours = "fn f() {}\n\n#[cfg(test)]\nmod tests {}\n";
        file_tree::write(&trusted.path().join(kit), ours.as_bytes()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(kit);
        let given = Given::of(folder.path(), &folder.path().join("stages"), trusted.path());
        // Handouts have no unit tests.
        let texts = [
            (ours, true),
            ("fn f() {}\n", true),
            ("fn g() {}\n", false),
            ("fn", false),
        ];
        for (text, is_unchanged) in texts {
            file_tree::write(&path, text.as_bytes()).unwrap();
            assert_eq!(given.is_unchanged(&path, kit), is_unchanged, "{text}");
        }
        assert!(given.decides(kit));
        assert!(!given.decides(Path::new("stages/kit/src/mine.rs")));
    }

    /// Handouts leave out tests and the libraries that only these need.
    #[test]
    fn a_manifest_without_tests_is_unchanged() {
        let ours = "[package]\nname = \"raygen\"\n\n[dependencies]\nkit.workspace = true\n\n\
            [dev-dependencies]\nproptest.workspace = true\n\n[[bench]]\nname = \"rays\"\n";
        let carved = "[package]\nname = \"raygen\"\n\n[dependencies]\nkit.workspace = true\n";
        let changed = "[package]\nname = \"raygen\"\n\n[dependencies]\nkit.workspace = true\nrand = \"0.9\"\n";
        let manifest = Path::new("stages/raygen/Cargo.toml");
        let trusted = tempfile::tempdir().unwrap();
        file_tree::write(&trusted.path().join(manifest), ours.as_bytes()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(manifest);
        let given = Given::of(folder.path(), &folder.path().join("stages"), trusted.path());
        for (text, is_unchanged) in [(ours, true), (carved, true), (changed, false)] {
            file_tree::write(&path, text.as_bytes()).unwrap();
            assert_eq!(given.is_unchanged(&path, manifest), is_unchanged, "{text}");
        }
    }
}
