//! The entries of a class's folder: each is one submission.

use crate::hash;
use base::GraderError;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// One submission, as it lies in the folder of the class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The student's name in all tables: the entry's name, without the ending of an archive.
    pub name: String,
    /// The name of the folder or file in the folder of the class.
    pub file: String,
    /// Why it cannot be opened, if that is known.
    pub problem: Option<&'static str>,
}

/// What is wrong with a name that is not UTF-8.
const NOT_UTF_8: &str = "has a name that is not UTF-8: rename it";

/// What is wrong with a link: on a shared folder somebody could point it at the course's solutions.
const LINK: &str =
    "is a link, which may lead to files that nobody handed in: put a copy of them here";

/// The endings of archives, which are not part of a student's name.
const ENDINGS: [&str; 6] = [".tar.gz", ".tgz", ".tar", ".zip", ".rar", ".7z"];

/// The longest part of a name in that of a student's page, in bytes: with a hash, an ending, and the
/// ending of a file that is being written, it is still a name.
const PAGE_NAME: usize = 160;

/// Hidden entries that systems and programs make. Any other was handed in, and has a row.
const SYSTEM_FILES: [&str; 8] = [
    ".DS_Store",
    ".Spotlight-V100",
    ".Trashes",
    ".directory",
    ".fseventsd",
    ".git",
    ".gitignore",
    ".localized",
];

/// What the names of others begin with.
const SYSTEM_PREFIXES: [&str; 3] = ["._", ".nfs", ".Trash-"];

/// Lists the submissions in `class`, sorted by name, without what systems made. A file that is no
/// archive is listed, too: somebody handed it in, and reading it says what is wrong.
pub fn list(class: &Path) -> Result<Vec<Entry>, GraderError> {
    let failed = |e: std::io::Error| GraderError::file("read", class, e);
    let mut found = Vec::new();
    for entry in std::fs::read_dir(class).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let is_link = entry.file_type().is_ok_and(|kind| kind.is_symlink());
        let name = entry.file_name();
        found.push((name.to_str().is_none(), name, is_link));
    }
    found.sort();
    let mut files: Vec<(String, Option<&'static str>)> = Vec::new();
    for (is_no_text, name, is_link) in found {
        let problem = match is_no_text {
            true => Some(NOT_UTF_8),
            false => is_link.then_some(LINK),
        };
        let mut name = name.to_string_lossy().into_owned();
        // A name that is no UTF-8 may look like another one.
        while is_no_text && files.iter().any(|(other, _)| *other == name) {
            name.push('\'');
        }
        if !is_made_by_a_system(&name) {
            files.push((name, problem));
        }
    }
    if files.is_empty() {
        return Err(GraderError::new(format!(
            "{} is empty. Expected one folder, zip or tar file per submission",
            class.display()
        )));
    }
    Ok(named(files))
}

/// Names the entries. Two that differ only by their ending keep it: `anna` and `anna.zip`. So does
/// one whose name would be another file's: `anna.zip.zip` beside `anna.zip`. A name is a key of
/// results and marks, so no two entries have the same.
fn named(files: Vec<(String, Option<&'static str>)>) -> Vec<Entry> {
    let mut times: BTreeMap<String, usize> = BTreeMap::new();
    for (file, _) in &files {
        let names = BTreeSet::from([stem(file), file]);
        for name in names {
            *times.entry(name.to_string()).or_default() += 1;
        }
    }
    let mut entries: Vec<Entry> = files
        .into_iter()
        .map(|(file, problem)| Entry {
            problem,
            name: match times[stem(&file)] {
                1 => stem(&file).to_string(),
                _ => file.clone(),
            },
            file,
        })
        .collect();
    entries.sort_by(|a, b| a.name.cmp(&b.name));
    entries
}

fn is_made_by_a_system(name: &str) -> bool {
    let mut starts = SYSTEM_PREFIXES.iter();
    SYSTEM_FILES.contains(&name) || starts.any(|start| name.starts_with(start))
}

fn stem(file: &str) -> &str {
    let lower = file.to_ascii_lowercase();
    let ending = ENDINGS.iter().find(|ending| lower.ends_with(**ending));
    let length = ending.map_or(file.len(), |ending| file.len() - ending.len());
    if length == 0 { file } else { &file[..length] }
}

/// How much of a name's hash is in that of its page. A student chooses the name, and must not be
/// able to find one with the page of somebody else.
const PAGE_HASH: usize = 24;

/// The file names of the students' pages, without `.html`, in the order of `names`. A name that is
/// no plain file name on every system is written with `_` and a part of its hash, and so is one
/// that looks like that.
pub fn page_names(names: &[&str]) -> Vec<String> {
    let plain = |name: &str| -> String {
        let places = name.char_indices();
        let kept = places.take_while(|(at, _)| *at < PAGE_NAME);
        kept.map(|(_, c)| match c.is_alphanumeric() || "-_.".contains(c) {
            true => c,
            false => '_',
        })
        .collect()
    };
    let mut times: BTreeMap<String, usize> = BTreeMap::new();
    for name in names {
        // Some file systems ignore case.
        *times.entry(plain(name).to_lowercase()).or_default() += 1;
    }
    names
        .iter()
        .map(|name| {
            let plain = plain(name);
            let is_own = plain == *name && times[&plain.to_lowercase()] == 1;
            match is_own && !plain.starts_with(['.', '_']) {
                true => plain,
                false => format!("_{plain}-{}", &hash::of([name])[..PAGE_HASH]),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_link_is_an_entry_that_cannot_be_opened() {
        let class = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(class.path().join("anna")).expect("a folder");
        std::os::unix::fs::symlink("anna", class.path().join("bo")).expect("a link");
        let problems: Vec<_> = list(class.path())
            .expect("it can be listed")
            .into_iter()
            .map(|entry| entry.problem)
            .collect();
        assert_eq!(problems, [None, Some(LINK)]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn names_that_are_no_text_are_told_apart() {
        use std::os::unix::ffi::OsStrExt;
        let class = tempfile::tempdir().expect("a folder");
        for name in [b"n\xfe".as_slice(), b"n\xff", "n\u{fffd}".as_bytes()] {
            let path = class.path().join(std::ffi::OsStr::from_bytes(name));
            std::fs::create_dir(path).expect("a folder");
        }
        let entries = list(class.path()).expect("it can be listed").into_iter();
        let said: Vec<_> = entries.map(|entry| (entry.name, entry.problem)).collect();
        let name = |marks: &str| format!("n\u{fffd}{marks}");
        assert_eq!(
            said,
            [
                (name(""), None),
                (name("'"), Some(NOT_UTF_8)),
                (name("''"), Some(NOT_UTF_8)),
            ]
        );
    }

    #[test]
    fn a_hidden_entry_is_a_submission_unless_a_system_made_it() {
        let class = tempfile::tempdir().expect("a folder");
        for file in [".DS_Store", "._anna.zip", ".git", ".x", ".y.zip"] {
            std::fs::write(class.path().join(file), "").expect("a file");
        }
        let entries = list(class.path()).expect("it can be listed").into_iter();
        let names: Vec<String> = entries.map(|entry| entry.name).collect();
        assert_eq!(names, [".x", ".y"]);
    }

    #[test]
    fn an_archive_has_the_name_of_its_student() {
        let files = ["bo.tar.gz", "anna", "anna.zip", "Ceh.ZIP", ".zip", "v1.2"];
        let names = [".zip", "Ceh", "anna", "anna.zip", "bo", "v1.2"];
        assert_eq!(names_of(&files), names);
    }

    #[test]
    fn no_archive_has_the_name_of_somebody_elses() {
        let files = ["anna", "anna.zip", "anna.zip.zip", "bo.zip.tar", "bo.zip"];
        let names = ["anna", "anna.zip", "anna.zip.zip", "bo", "bo.zip.tar"];
        assert_eq!(names_of(&files), names);
    }

    /// The names of the entries of these files, sorted.
    fn names_of(files: &[&str]) -> Vec<String> {
        let files = files.iter().map(|file| ((*file).to_string(), None));
        let entries = named(files.collect()).into_iter();
        entries.map(|entry| entry.name).collect()
    }

    #[test]
    fn the_names_of_pages_are_plain_and_distinct() {
        let as_page = page_names(&["<b>"]).remove(0);
        let names = [
            "anna", "Anna", "../x", "Zoë", "<b>", ".", "a b", "a_b", &as_page,
        ];
        let pages = page_names(&names);
        assert_eq!(pages[3], "Zoë");
        let collides = "_a_b-".len() + PAGE_HASH;
        assert_eq!(pages[7].len(), collides, "it collides with `a b`");
        let longest = ["𠀀".repeat(63), "a".repeat(255), "é".repeat(127)];
        for page in page_names(&longest.each_ref().map(String::as_str)) {
            assert!(page.len() < 200, "{page}");
        }
        let mut distinct: Vec<String> = pages.iter().map(|page| page.to_lowercase()).collect();
        distinct.sort();
        distinct.dedup();
        assert_eq!(distinct.len(), names.len());
        for page in &pages {
            assert!(
                !page.contains(['/', '<', ' ']) && !page.starts_with('.'),
                "{page}"
            );
        }
    }
}
