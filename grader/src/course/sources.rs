//! The source files of a stage: which functions of a task are still holes, and which file to open.

use crate::course::{Course, Task};
use base::GraderError;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// A Rust file of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// The path below the workspace's root folder, with `/` between its parts.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// The place where a task is written.
#[derive(Clone, Default, Debug, PartialEq, Eq)]
pub struct Place {
    /// The key of the task.
    pub key: String,
    /// Its title.
    pub title: String,
    /// The file to open: the first with an open function of the task, else the one with its first
    /// function.
    pub file: Option<String>,
    /// The functions of the task that still have a hole, or that still are the slow start which
    /// the course provides.
    pub open: Vec<String>,
    /// Whether any of its stage's files has a hole of the task, in a listed function or not.
    pub has_hole: bool,
}

/// The paths of all Rust files of `stage` in the workspace `root`, sorted.
pub fn paths(root: &Path, stage: &str) -> Result<Vec<PathBuf>, GraderError> {
    below(&root.join("stages").join(stage).join("src"))
}

/// The Rust files below `folder`, sorted by path.
pub fn below(folder: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let mut files = all_below(folder)?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    Ok(files)
}

/// All files below `folder`, sorted by path. Left out are those whose names start with a dot (of
/// editors and systems), what is no file, and links to folders, which may lead anywhere; `folder`
/// itself may be one.
pub(crate) fn all_below(folder: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let failed = |e| GraderError::file("read", &folder, e);
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            if entry.file_name().as_encoded_bytes().starts_with(b".") {
                continue;
            }
            let path = entry.path();
            if entry.file_type().map_err(failed)?.is_dir() {
                folders.push(path);
            } else if path.is_file() {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Reads all Rust files of `stage` in the workspace `root`, sorted by path. Bytes that are not
/// UTF-8 are replaced: the compiler reports them.
pub fn read(root: &Path, stage: &str) -> Result<Vec<SourceFile>, GraderError> {
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).map_err(|e| GraderError::file("read", &path, e))?;
        Ok(SourceFile {
            path: with_slashes(path.strip_prefix(root).unwrap_or(&path)),
            text: String::from_utf8_lossy(&bytes).into_owned(),
        })
    };
    paths(root, stage)?.into_iter().map(read).collect()
}

/// What `bytes` are instead of text in UTF-8, and what to do; `None` if they are such text.
pub fn why_no_text(bytes: &[u8]) -> Option<&'static str> {
    // Without a byte order mark, every second byte of a program in UTF-16 is zero.
    let zeros = bytes.iter().filter(|byte| **byte == 0).count();
    let is_utf16 = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    if is_utf16 || zeros * 3 > bytes.len() {
        return Some("UTF-16 text, which the compiler does not read (save it as UTF-8)");
    }
    let is_text = std::str::from_utf8(bytes).is_ok();
    (!is_text).then_some("no UTF-8 text, so the compiler does not read it (save it as UTF-8)")
}

/// A sentence for each Rust file of `stage` in the workspace `root` that is not text in UTF-8.
pub(crate) fn files_without_text(root: &Path, stage: &str) -> Vec<String> {
    let said = paths(root, stage)
        .unwrap_or_default()
        .into_iter()
        .filter_map(|path| {
            let why = why_no_text(&std::fs::read(&path).ok()?)?;
            let name = with_slashes(path.strip_prefix(root).unwrap_or(&path));
            Some(format!("{name} is {why}"))
        });
    said.collect()
}

/// Reads the Rust files of all stages of `course` in the workspace `root`.
pub fn read_all<'a>(
    root: &Path,
    course: &'a Course,
) -> Result<BTreeMap<&'a str, Vec<SourceFile>>, GraderError> {
    let stages = course.stages().into_iter();
    stages
        .map(|stage| Ok((stage, read(root, stage)?)))
        .collect()
}

/// The place of `task`, whose stage has these files.
pub fn place(task: &Task, files: &[SourceFile]) -> Place {
    let is_open_in = |name: &str, file: &SourceFile| {
        body(&file.text, name).is_some_and(|body| has_hole(body, &task.key) || has_todo(body))
    };
    let is_open = |name: &&String| files.iter().any(|file| is_open_in(name, file));
    let has_open = |file: &&SourceFile| task.holes.iter().any(|name| is_open_in(name, file));
    // A file may have a gap of the task that is not graded, too.
    let has_first = |file: &&SourceFile| {
        let mut first = task.holes.first().into_iter();
        first.any(|name| defines_function(&file.text, name))
    };
    let file = files.iter().find(has_open);
    Place {
        key: task.key.clone(),
        title: task.title.clone(),
        file: file
            .or_else(|| files.iter().find(has_first))
            .map(|file| file.path.clone()),
        open: task.holes.iter().filter(is_open).cloned().collect(),
        has_hole: files.iter().any(|file| has_hole(&file.text, &task.key)),
    }
}

/// A number that changes with the files' paths and texts.
pub fn fingerprint(files: &[SourceFile]) -> String {
    let mut hasher = DefaultHasher::new();
    for file in files {
        (&file.path, &file.text).hash(&mut hasher);
    }
    format!("{:016x}", hasher.finish())
}

/// Whether `text` contains the public function `name`.
pub fn defines_function(text: &str, name: &str) -> bool {
    start_of(text, name).is_some()
}

/// Whether the code in `text` has a `hole!` or an `untouched!` of the task `key`.
pub fn has_hole(text: &str, key: &str) -> bool {
    holes(text, key).next().is_some()
}

/// The code in front of the key in each `hole!` or `untouched!` of the task `key`. Comments do not
/// count: the full course has the stubs of its handouts in comments.
pub fn holes<'a>(text: &'a str, key: &str) -> impl Iterator<Item = &'a str> {
    let quoted = format!("\"{key}\"");
    let places: Vec<usize> = text.match_indices(&quoted).map(|(at, _)| at).collect();
    let before = places.into_iter().map(|at| &text[..at]);
    before.filter(|before| {
        let line = before.rsplit('\n').next().unwrap_or_default();
        let macros = ["hole!(", "untouched!("];
        let is_macro = macros.iter().any(|name| before.trim_end().ends_with(name));
        is_macro && !line.trim_start().starts_with("//")
    })
}

/// Whether the code in `text` has a `todo!` or an `unimplemented!`, which the standard library has
/// for what is not written yet.
fn has_todo(text: &str) -> bool {
    let macros = ["todo!(", "unimplemented!("];
    text.lines().any(|line| {
        let code = line.split("//").next().unwrap_or_default();
        macros.iter().any(|name| code.contains(name))
    })
}

/// The text of the public function `name` from its `pub fn` to the end of its body.
pub(crate) fn body<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let rest = &text[start_of(text, name)?..];
    // As rustfmt writes it, the end of a function that is in no block is a brace on its own.
    let end = rest.find("\n}").map_or(rest.len(), |end| end + 2);
    Some(&rest[..end])
}

/// The line on which the public function `name` begins, from 1 on.
pub fn line_of_function(text: &str, name: &str) -> Option<usize> {
    Some(text[..start_of(text, name)?].lines().count() + 1)
}

/// Where the public function `name` begins.
fn start_of(text: &str, name: &str) -> Option<usize> {
    ["(", "<"]
        .iter()
        .find_map(|next| text.find(&format!("pub fn {name}{next}")))
}

/// A path with `/` between its parts, as in messages and commands.
pub fn with_slashes(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;

    fn task() -> Task {
        let course =
            Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid");
        let mut tasks = course.tasks().filter(|task| task.key == "part1.task3");
        tasks.next().expect("the course has triangles").clone()
    }

    fn file(text: &str) -> SourceFile {
        SourceFile {
            path: "stages/intersect/src/triangle.rs".into(),
            text: text.into(),
        }
    }

    /// Emacs locks a file with a link to nothing; a link may lead to a folder above.
    #[cfg(unix)]
    #[test]
    fn files_of_editors_and_links_to_folders_are_no_sources() {
        let folder = tempfile::tempdir().unwrap();
        let src = folder.path();
        let link = std::os::unix::fs::symlink::<&str, PathBuf>;
        std::fs::create_dir(src.join("shapes")).unwrap();
        for file in ["lib.rs", "shapes/sphere.rs", "._lib.rs", "notes.txt"] {
            std::fs::write(src.join(file), "").unwrap();
        }
        link("nobody@nowhere", src.join(".#lib.rs")).unwrap();
        link("nothing", src.join("gone.rs")).unwrap();
        link("shapes/sphere.rs", src.join("ball.rs")).unwrap();
        for name in ["a", "b", "shapes/up"] {
            link("..", src.join(name)).unwrap();
        }
        let found = below(src).unwrap();
        let expected = ["ball.rs", "lib.rs", "shapes/sphere.rs"].map(|file| src.join(file));
        assert_eq!(found, expected);
    }

    #[test]
    fn functions_with_a_hole_are_open() {
        let text = "pub fn test_triangle(a: u8) -> u8 {\n    a\n}\n\npub fn intersect_triangle(a: u8) -> u8 {\n    kit::hole!(\n        \"part1.task3\",\n        a\n    )\n}\n";
        let place = place(&task(), &[file("//! Map.\n"), file(text)]);
        assert_eq!(place.open, ["intersect_triangle"]);
        let text = text.replace(
            "    a\n",
            "    let b = a; // todo!()\n    todo!(\"the range\")\n",
        );
        let place = super::place(&task(), &[file(&text)]);
        assert_eq!(place.open, ["test_triangle", "intersect_triangle"]);
        assert_eq!(
            place.file.as_deref(),
            Some("stages/intersect/src/triangle.rs")
        );
    }

    #[test]
    fn a_gap_that_is_not_graded_is_not_where_a_task_goes_on() {
        let extra = SourceFile {
            path: "stages/intersect/src/curve.rs".into(),
            text: "pub fn curve() {\n    kit::hole!(\"part1.task3\")\n}\n".into(),
        };
        let place = place(&task(), &[extra, file("pub fn test_triangle() {}\n")]);
        assert_eq!(
            place.file.as_deref(),
            Some("stages/intersect/src/triangle.rs")
        );
        assert!(place.has_hole && place.open.is_empty());
    }

    #[test]
    fn a_stub_in_a_comment_and_a_hole_of_another_task_are_no_holes() {
        let text = "pub fn test_triangle(a: u8) -> u8 {\n    // STUB: kit::hole!(\"part1.task3\", a)\n    kit::hole!(\"part1.task4\", a)\n}\n";
        assert!(!has_hole(text, "part1.task3"));
        assert!(has_hole(text, "part1.task4"));
        assert!(has_hole("kit::untouched!(\"part2.task1\");", "part2.task1"));
        assert_eq!(place(&task(), &[file(text)]).open, [""; 0]);
    }

    #[test]
    fn the_fingerprint_changes_with_any_text() {
        assert_ne!(fingerprint(&[file("a")]), fingerprint(&[file("b")]));
        assert_eq!(fingerprint(&[file("a")]), fingerprint(&[file("a")]));
    }
}
