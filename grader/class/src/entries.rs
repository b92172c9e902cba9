//! The entries of a class's folder: each is one submission.

use crate::hash;
use base::GraderError;
use std::collections::BTreeMap;
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
const ENDINGS: [&str; 4] = [".tar.gz", ".tgz", ".tar", ".zip"];

/// The longest part of a name in that of a student's page, in bytes: with a hash, an ending, and the
/// ending of a file that is being written, it is still a name.
const PAGE_NAME: usize = 160;

/// Lists the submissions in `class`, sorted by name. Hidden entries are left out. A file that is no
/// archive is listed, too: somebody handed it in, and reading it says what is wrong.
pub fn list(class: &Path) -> Result<Vec<Entry>, GraderError> {
    let failed = |e: std::io::Error| GraderError::file("read", class, e);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(class).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let is_link = entry.file_type().is_ok_and(|kind| kind.is_symlink());
        let name = entry.file_name();
        let problem = match name.to_str() {
            None => Some(NOT_UTF_8),
            Some(_) => is_link.then_some(LINK),
        };
        let name = name.to_string_lossy();
        if !name.starts_with('.') {
            files.push((name.into_owned(), problem));
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

/// Names the entries. Two that differ only by their ending keep it: `anna` and `anna.zip`.
fn named(files: Vec<(String, Option<&'static str>)>) -> Vec<Entry> {
    let mut times: BTreeMap<String, usize> = BTreeMap::new();
    for (file, _) in &files {
        *times.entry(stem(file).to_string()).or_default() += 1;
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

fn stem(file: &str) -> &str {
    let lower = file.to_ascii_lowercase();
    let ending = ENDINGS.iter().find(|ending| lower.ends_with(**ending));
    let length = ending.map_or(file.len(), |ending| file.len() - ending.len());
    if length == 0 { file } else { &file[..length] }
}

/// The file names of the students' pages, without `.html`, in the order of `names`. A name that is
/// no plain file name on every system is written with `_` and a part of its hash.
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
            match plain == *name && !plain.starts_with('.') && times[&plain.to_lowercase()] == 1 {
                true => plain,
                false => format!("_{plain}-{}", &hash::of([name])[..8]),
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

    #[test]
    fn an_archive_has_the_name_of_its_student() {
        let files = ["bo.tar.gz", "anna", "anna.zip", "Ceh.ZIP", ".zip", "v1.2"];
        let entries = named(files.map(|file| (file.to_string(), None)).to_vec());
        let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, [".zip", "Ceh", "anna", "anna.zip", "bo", "v1.2"]);
    }

    #[test]
    fn the_names_of_pages_are_plain_and_distinct() {
        let names = ["anna", "Anna", "../x", "Zoë", "<b>", ".", "a b", "a_b"];
        let pages = page_names(&names);
        assert_eq!(pages[3], "Zoë");
        assert_eq!(pages[7].len(), "_a_b-".len() + 8, "it collides with `a b`");
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
