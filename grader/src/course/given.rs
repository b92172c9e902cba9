//! The given files of a handout: everything that students do not write. A list of their hashes says
//! which of them were changed since.
//!
//! A student's own run uses the files as they lie there; grading uses the course's own. So a change
//! of a given file that decides points must be told in both places. The course's full checkout has
//! no list: what is changed there is changed on purpose.

use base::{GraderError, Workspace, fnv};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The path of the list in a handout. It is in the folder that is handed in, if only one is.
pub const LIST: &str = "stages/given.txt";

/// The beginning of the list.
const HEADER: &str = "\
# The given files of this handout, with their hashes. `!` marks those that decide points: if one of
# them differs, `cargo grader` says so, because grading uses the original. An instructor who changes
# given files of a handout on purpose removes this list.
";

/// What is known of a given file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Given {
    /// The hash of its original text.
    hash: u64,
    /// Whether the points of a student's own run depend on it.
    decides: bool,
}

/// The list of the given files of a handout, by their paths in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GivenFiles(BTreeMap<PathBuf, Given>);

impl GivenFiles {
    /// Adds a file. `decides` says whether the points of a student's own run depend on it.
    pub fn add(&mut self, path: &Path, contents: &[u8], decides: bool) {
        let hash = hash(contents);
        self.0.insert(path.to_path_buf(), Given { hash, decides });
    }

    /// The text of the list.
    pub fn to_text(&self) -> String {
        let mut text = HEADER.to_string();
        for (path, given) in &self.0 {
            let names: Vec<_> = path.iter().map(|name| name.to_string_lossy()).collect();
            let mark = if given.decides { '!' } else { ' ' };
            let _ = writeln!(text, "{:012x} {mark} {}", given.hash, names.join("/"));
        }
        text
    }

    /// Reads a list. Lines in another form are left out: a damaged list finds fewer changes, and is
    /// no reason not to grade.
    pub fn parse(text: &str) -> GivenFiles {
        let files = text.lines().filter_map(|line| {
            let mut columns = line.splitn(2, ' ');
            // Older handouts have all 64 bits.
            let hash = u64::from_str_radix(columns.next()?, 16).ok()? & LOW_BITS;
            let rest = columns.next()?;
            let decides = rest.starts_with('!');
            let path = rest.get(2..).filter(|path| !path.is_empty())?;
            Some((PathBuf::from(path), Given { hash, decides }))
        });
        GivenFiles(files.collect())
    }

    /// Reads the list of the handout or submission in `folder`; `None` if it has none.
    pub fn read(folder: &Path) -> Option<GivenFiles> {
        GivenFiles::read_from(&folder.join(LIST))
    }

    /// Reads the list in the file `path`; `None` if there is none.
    pub fn read_from(path: &Path) -> Option<GivenFiles> {
        let is_file = path.symlink_metadata().is_ok_and(|kind| kind.is_file());
        let text = is_file.then(|| std::fs::read_to_string(path))?;
        Some(GivenFiles::parse(&text.ok()?))
    }

    /// Whether `contents` is the original text of the file `path`; `None` if the list does not
    /// contain the file.
    pub fn is_original(&self, path: &Path, contents: &[u8]) -> Option<bool> {
        let given = self.0.get(path)?;
        Some(given.hash == hash(contents))
    }

    /// Whether the file `path` is in the list, and the points of a student's own run depend on it.
    pub fn decides(&self, path: &Path) -> bool {
        self.0.get(path).is_some_and(|given| given.decides)
    }
}

/// The given files of `workspace` that decide points and are not as they were handed out, each with
/// what became of it. Empty in the course's full checkout.
pub fn changed(workspace: &Workspace) -> Result<Vec<String>, GraderError> {
    let root = workspace.root();
    let Some(given) = GivenFiles::read(root).filter(|_| !workspace.is_full()) else {
        return Ok(Vec::new());
    };
    let mut changed = Vec::new();
    for (path, _) in given.0.iter().filter(|(_, given)| given.decides) {
        let full = root.join(path);
        match std::fs::read(&full) {
            Ok(contents) if given.is_original(path, &contents) == Some(true) => {}
            Ok(_) => changed.push(path.display().to_string()),
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => {
                changed.push(format!("{} (missing)", path.display()));
            }
            Err(e) => return Err(GraderError::file("read", &full, e)),
        }
        // Cargo runs a build script whether or not the manifest names it.
        let script = path.with_file_name("build.rs");
        let is_manifest = path.ends_with("Cargo.toml");
        if is_manifest && !given.0.contains_key(&script) && root.join(&script).exists() {
            changed.push(format!("{} (added)", script.display()));
        }
    }
    Ok(changed)
}

/// How many files [`sentence`] names.
const NAMED: usize = 3;

/// The sentence about the files of [`changed`]; `None` if there are none.
pub fn sentence(changed: &[String]) -> Option<String> {
    let named = changed.get(..NAMED).unwrap_or(changed).join(", ");
    let more = match changed.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let (files, differ, originals) = match changed.len() {
        0 => return None,
        1 => ("Given file", "differs", "original"),
        _ => ("Given files", "differ", "originals"),
    };
    let crates = match changed.iter().any(|path| path.ends_with("Cargo.toml")) {
        true => " What you hand in cannot use crates that you added: it would not compile.",
        false => "",
    };
    Some(format!(
        "{files} {named}{more} {differ} from the handout. You are graded with the {originals}: README.md says how to restore them.{crates}"
    ))
}

/// Enough to find changes in a thousand files, in a list that stays small.
const LOW_BITS: u64 = (1 << 48) - 1;

/// The low bits of the hash of a text, with any line ends: git and editors may change those.
fn hash(contents: &[u8]) -> u64 {
    let mut hash = fnv::START;
    let mut bytes = contents.iter().peekable();
    while let Some(byte) = bytes.next() {
        if *byte != b'\r' || bytes.peek() != Some(&&b'\n') {
            hash = fnv::add(hash, *byte);
        }
    }
    hash & LOW_BITS
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A handout with three given files.
    fn handout() -> (tempfile::TempDir, Workspace) {
        let folder = tempfile::tempdir().unwrap();
        let mut given = GivenFiles::default();
        for (path, text, decides) in [
            ("stages/course.toml", "points = 1\n", true),
            ("stages/kit/Cargo.toml", "[package]\n", true),
            ("stages/viewer/src/main.rs", "fn main() {}\n", false),
        ] {
            let full = folder.path().join(path);
            std::fs::create_dir_all(full.parent().unwrap()).unwrap();
            std::fs::write(full, text).unwrap();
            given.add(Path::new(path), text.as_bytes(), decides);
        }
        std::fs::write(folder.path().join(LIST), given.to_text()).unwrap();
        let workspace = Workspace::above(folder.path()).unwrap();
        (folder, workspace)
    }

    #[test]
    fn the_hash_is_fnv_1a_without_carriage_returns_at_line_ends() {
        assert_eq!(hash(b"foobar"), 0x4171_f739_67e8);
        assert_eq!(hash(b"a\r\nb\r\n"), hash(b"a\nb\n"));
        assert_ne!(hash(b"a\rb"), hash(b"ab"));
    }

    #[test]
    fn the_list_is_read_as_it_was_written() {
        let (folder, _) = handout();
        let given = GivenFiles::read(folder.path()).unwrap();
        assert_eq!(given.0.len(), 3);
        assert_eq!(GivenFiles::parse(&given.to_text()), given);
        let windows = given.to_text().replace('\n', "\r\n");
        assert_eq!(GivenFiles::parse(&windows), given);
        assert!(given.decides(Path::new("stages/course.toml")));
        assert!(!given.decides(Path::new("stages/viewer/src/main.rs")));
    }

    #[test]
    fn changes_that_decide_points_are_found() {
        let (folder, workspace) = handout();
        let write =
            |path: &str, text: &str| std::fs::write(folder.path().join(path), text).unwrap();
        write("stages/course.toml", "points = 1\r\n");
        write("stages/viewer/src/main.rs", "fn main() { f() }\n");
        assert_eq!(changed(&workspace).unwrap(), [""; 0]);
        write("stages/course.toml", "points = 100\n");
        write("stages/kit/build.rs", "fn main() {}\n");
        let expected = ["stages/course.toml", "stages/kit/build.rs (added)"];
        assert_eq!(changed(&workspace).unwrap(), expected);
        std::fs::remove_file(folder.path().join("stages/kit/Cargo.toml")).unwrap();
        assert_eq!(
            changed(&workspace).unwrap()[1],
            "stages/kit/Cargo.toml (missing)"
        );
    }

    #[test]
    fn the_full_checkout_may_be_changed() {
        let (folder, workspace) = handout();
        std::fs::write(folder.path().join("stages/course.toml"), "points = 2\n").unwrap();
        assert_eq!(changed(&workspace).unwrap().len(), 1);
        std::fs::create_dir(folder.path().join("golden")).unwrap();
        std::fs::write(folder.path().join("golden/Cargo.toml"), "").unwrap();
        assert_eq!(changed(&workspace).unwrap(), [""; 0]);
    }

    #[test]
    fn the_sentence_names_three_files() {
        let files = |count: usize| vec!["a.rs".to_string(); count];
        assert_eq!(sentence(&[]), None);
        let one = sentence(&files(1)).unwrap();
        assert!(one.starts_with("Given file a.rs differs"), "{one}");
        let many = sentence(&files(5)).unwrap();
        assert!(
            many.contains("a.rs, a.rs, a.rs and 2 more differ"),
            "{many}"
        );
    }
}
