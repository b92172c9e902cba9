//! The rendered book: `target/first-light/book`, the site that `cargo grader book` opens.
//!
//! A handout contains the site in one packed file, which is unpacked once. The full checkout builds
//! it with the program `book`, again if the text or its pictures changed. A folder that
//! `grader start` made beside a checkout has the site of the checkout, built at its first use.

use crate::build;
use crate::course::chapter;
use crate::course::packed;
use base::{GraderError, Workspace, errln, write_whole};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Component, Path, PathBuf};
use std::process::Command;

/// The packed site of a handout.
pub const PACK: &str = "stages/book/site.pack";

/// The folder of the chapters.
const TEXT: &str = "stages/book/src";

/// The code that renders the site, in the full checkout.
const CODE: &str = "stages/book/code";

/// The name of the site's folder among what the grader writes for students.
const NAME: &str = "book";

/// The file, among what the grader writes, that names the checkout beside which a folder was made.
const CHECKOUT: &str = "made-from";

/// The file in the site that says what it was made of.
const MADE_OF: &str = ".made-of";

/// What the site of the full checkout is made of, besides the tasks' pictures.
const SOURCES: [&str; 3] = [TEXT, CODE, "stages/book/theme"];

/// The folders of the text that the site has copies of.
const COPIED: [&str; 2] = ["figures", "mistakes"];

/// Files that the site is also made of.
const SOURCE_FILES: [&str; 3] = [
    "Cargo.lock",
    "grader/pictures/triangles.svg",
    "grader/pictures/world.svg",
];

/// The folder of the site, whether it exists or not.
pub fn folder(workspace: &Workspace) -> Result<PathBuf, GraderError> {
    workspace.for_students(NAME)
}

/// Unpacks or builds the site if it is not current. Returns its folder.
pub fn make_current(workspace: &Workspace) -> Result<PathBuf, GraderError> {
    if workspace.root().join(PACK).is_file() {
        return unpack(workspace);
    }
    let folder = folder(workspace)?;
    let made_of = hash_of_sources(workspace.root())?;
    if is_made_of(&folder, &made_of) {
        return Ok(folder);
    }
    if let Some(checkout) = checkout_of(workspace) {
        let site = make_current(&checkout)?;
        replace(&folder, &made_of, |new| copy_site(&site, new))?;
        return Ok(folder);
    }
    if !workspace.root().join(CODE).is_dir() {
        return Err(GraderError::new(format!(
            "this folder has no rendered book: {PACK} is missing. Restore it from the handout, or read the chapters in stages/book/src"
        )));
    }
    errln!("Rendering the book. The first time this compiles its program: some seconds ...");
    let program = build::build_program(workspace.root(), "book")?
        .map_err(|_| GraderError::new("the package book does not compile"))?;
    replace(&folder, &made_of, |new| {
        let status = Command::new(&program).arg("site").arg(new).status();
        match status.map_err(|e| GraderError::file("run", &program, e))? {
            status if status.success() => Ok(()),
            _ => Err(GraderError::new(
                "the book could not be rendered: see above",
            )),
        }
    })?;
    Ok(folder)
}

/// Makes `started`, which has no site, use that of the full checkout beside which it was made.
pub fn remember_checkout(started: &Workspace, checkout: &Workspace) -> Result<(), GraderError> {
    let file = started.for_students(CHECKOUT)?;
    let root = checkout.root().to_string_lossy();
    write_whole(&file, root.as_bytes())
}

/// The checkout beside which a folder was made, if it is still there and of the same version.
pub(crate) fn checkout_of(started: &Workspace) -> Option<Workspace> {
    let root = std::fs::read_to_string(started.outputs().join(CHECKOUT)).ok()?;
    let checkout = Workspace::above(Path::new(&root)).ok()?;
    checkout.root().join(CODE).is_dir().then_some(checkout)
}

/// Copies a site to the folder `new`.
fn copy_site(site: &Path, new: &Path) -> Result<(), GraderError> {
    for file in files_below(site)? {
        let to = new.join(file.strip_prefix(site).unwrap_or(&file));
        let parent = to.parent().unwrap_or(new);
        std::fs::create_dir_all(parent).map_err(|e| GraderError::file("create", parent, e))?;
        std::fs::copy(&file, &to).map_err(|e| GraderError::file("copy", &file, e))?;
    }
    Ok(())
}

/// Unpacks the site of a handout if it is not current, and says nothing if there is none to unpack.
/// For links: a report must not fail because of the book.
pub fn unpacked(workspace: &Workspace) -> Option<PathBuf> {
    match workspace.root().join(PACK).is_file() {
        true => unpack(workspace).ok(),
        false => folder(workspace).ok().filter(|folder| folder.is_dir()),
    }
}

/// The rendered page of the chapter whose Markdown is `chapter`, a path below the root; `None` if
/// that is no chapter, or if the book was not rendered.
pub fn page_of(workspace: &Workspace, chapter: &Path) -> Option<PathBuf> {
    let chapter = chapter.strip_prefix(TEXT).ok()?;
    let page = unpacked(workspace)?.join(chapter.with_extension("html"));
    page.is_file().then_some(page)
}

/// The file of a handout, below its root, that the file `path` of the site is a copy of; `None` for
/// pages and other files of which there is no original. The pack leaves such copies out.
pub fn original(path: &Path) -> Option<PathBuf> {
    if let Ok(picture) = path.strip_prefix("pictures") {
        return Some(Path::new("golden").join(picture));
    }
    let is_copied = COPIED.iter().any(|folder| path.starts_with(folder));
    is_copied.then(|| Path::new(TEXT).join(path))
}

/// Copies the files of the site that the pack leaves out from the handout to the folder `site`.
fn copy_originals(root: &Path, site: &Path) -> Result<(), GraderError> {
    let text = root.join(TEXT);
    let mut copies = Vec::new();
    for folder in COPIED {
        copies.extend(files_below(&text.join(folder))?.into_iter().map(|file| {
            let to = site.join(file.strip_prefix(&text).unwrap_or(&file));
            (file, to)
        }));
    }
    let golden = root.join("golden");
    copies.extend(task_pictures(root)?.into_iter().map(|file| {
        let picture = file.strip_prefix(&golden).unwrap_or(&file);
        let to = site.join("pictures").join(picture);
        (file, to)
    }));
    for (from, to) in copies {
        if !to.exists() {
            let parent = to.parent().unwrap_or(site);
            std::fs::create_dir_all(parent).map_err(|e| GraderError::file("create", parent, e))?;
            std::fs::copy(&from, &to).map_err(|e| GraderError::file("copy", &from, e))?;
        }
    }
    Ok(())
}

/// The pictures of the tasks among the goldens.
fn task_pictures(root: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let mut pictures = files_below(&root.join("golden"))?;
    pictures.retain(|file| file.ends_with("task.png"));
    Ok(pictures)
}

fn unpack(workspace: &Workspace) -> Result<PathBuf, GraderError> {
    let pack = workspace.root().join(PACK);
    let folder = folder(workspace)?;
    let bytes = std::fs::read(&pack).map_err(|e| GraderError::file("read", &pack, e))?;
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    let made_of = format!("{:016x}", hasher.finish());
    if is_made_of(&folder, &made_of) {
        return Ok(folder);
    }
    let files = packed::unpack(&bytes).map_err(|why| GraderError::file("unpack", &pack, why))?;
    replace(&folder, &made_of, |new| {
        for (path, contents) in &files {
            let is_inside = path
                .components()
                .all(|part| matches!(part, Component::Normal(_)));
            if !is_inside {
                let why = format!("it is damaged: {} is outside of it", path.display());
                return Err(GraderError::file("unpack", &pack, why));
            }
            let file = new.join(path);
            let parent = file.parent().unwrap_or(new);
            std::fs::create_dir_all(parent).map_err(|e| GraderError::file("create", parent, e))?;
            std::fs::write(&file, contents).map_err(|e| GraderError::file("write", &file, e))?;
        }
        copy_originals(workspace.root(), new)
    })?;
    Ok(folder)
}

/// Fills a new folder and puts it in the place of `folder`, so that an interrupted run leaves none
/// that is half full.
fn replace(
    folder: &Path,
    made_of: &str,
    fill: impl FnOnce(&Path) -> Result<(), GraderError>,
) -> Result<(), GraderError> {
    let temp = base::interrupt::temp_folder_in(base::folder_of(folder)?)?;
    // Links lead out of the site, so it is made at the depth where it will be.
    fill(temp.path())?;
    write_whole(&temp.path().join(MADE_OF), made_of.as_bytes())?;
    if folder.exists() {
        std::fs::remove_dir_all(folder).map_err(|e| GraderError::file("remove", folder, e))?;
    }
    std::fs::rename(temp.path(), folder).map_err(|e| GraderError::file("write", folder, e))
}

fn is_made_of(folder: &Path, made_of: &str) -> bool {
    std::fs::read_to_string(folder.join(MADE_OF)).is_ok_and(|text| text == made_of)
}

/// The hash of all that the site of the full checkout is made of.
fn hash_of_sources(root: &Path) -> Result<String, GraderError> {
    let mut files: Vec<PathBuf> = SOURCE_FILES.iter().map(|file| root.join(file)).collect();
    for folder in SOURCES {
        files.extend(files_below(&root.join(folder))?);
    }
    files.extend(task_pictures(root)?);
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in files.iter().filter(|file| file.is_file()) {
        let bytes = std::fs::read(file).map_err(|e| GraderError::file("read", file, e))?;
        (file.strip_prefix(root).unwrap_or(file), bytes).hash(&mut hasher);
    }
    Ok(format!("{:016x}", hasher.finish()))
}

/// The files below a folder; none if there is no such folder.
pub fn files_below(folder: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let failed = |e| GraderError::file("read", folder, e);
    let mut files = Vec::new();
    if !folder.is_dir() {
        return Ok(files);
    }
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        match path.is_dir() {
            true => files.extend(files_below(&path)?),
            false => files.push(path),
        }
    }
    Ok(files)
}

/// The page of a chapter in the site, with the anchor of a section: `part1/task3.html#mistakes` for
/// `part1.task3#mistakes`, `part1/README.html` for `part1`, `hard-cases.html` for `hard-cases`.
pub fn page(what: &str) -> String {
    let (name, anchor) = match what.split_once('#') {
        Some((name, anchor)) => (name, format!("#{anchor}")),
        None => (what, String::new()),
    };
    let is_part = name
        .strip_prefix("part")
        .is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()));
    let page = match chapter::page(name) {
        Some(page) => page,
        None if is_part => format!("{name}/README.html"),
        None => format!("{name}.html"),
    };
    format!("{page}{anchor}")
}

/// The names of the chapters of the site in `folder`, as [`page`] takes them.
pub fn chapters(folder: &Path) -> Result<Vec<String>, GraderError> {
    let mut names = Vec::new();
    for file in files_below(folder)? {
        let path = file.strip_prefix(folder).unwrap_or(&file);
        let Some(name) = path.to_str().and_then(|path| path.strip_suffix(".html")) else {
            continue;
        };
        let name = name.replace(std::path::MAIN_SEPARATOR, "/");
        let name = name.strip_suffix("/README").unwrap_or(&name);
        if !["index", "print"].contains(&name) {
            names.push(name.replace('/', "."));
        }
    }
    names.sort();
    Ok(names)
}

/// The address of a file, with the anchor of a section in its last part if there is one.
pub fn address(file: &Path) -> String {
    let path = file.to_string_lossy().replace('\\', "/");
    // What Windows writes before a path that it made absolute.
    let path = path.strip_prefix("//?/").unwrap_or(&path);
    let mut address = String::from(match path.starts_with('/') {
        true => "file://",
        false => "file:///",
    });
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z'
            | b'A'..=b'Z'
            | b'0'..=b'9'
            | b'/'
            | b'-'
            | b'_'
            | b'.'
            | b'~'
            | b':'
            | b'#' => {
                address.push(char::from(byte));
            }
            other => address.push_str(&format!("%{other:02X}")),
        }
    }
    address
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_have_pages() {
        for (what, expected) in [
            ("part1.task3", "part1/task3.html"),
            ("part1.task3#mistakes", "part1/task3.html#mistakes"),
            ("part2", "part2/README.html"),
            ("hard-cases", "hard-cases.html"),
        ] {
            assert_eq!(page(what), expected);
        }
    }

    #[test]
    fn addresses_have_no_spaces() {
        let file = Path::new("/home/a b/\u{e4}/x.html#y");
        assert_eq!(address(file), "file:///home/a%20b/%C3%A4/x.html#y");
        assert_eq!(
            address(Path::new(r"\\?\C:\a\x.html")),
            "file:///C:/a/x.html"
        );
    }

    fn workspace(files: &[(&str, &str)]) -> (tempfile::TempDir, Workspace) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(folder.path().join("stages/book")).unwrap();
        std::fs::write(folder.path().join("stages/course.toml"), "").unwrap();
        let files: Vec<_> = files
            .iter()
            .map(|(path, text)| (PathBuf::from(path), text.as_bytes().to_vec()))
            .collect();
        std::fs::write(folder.path().join(PACK), packed::pack(&files)).unwrap();
        let workspace = Workspace::above(folder.path()).unwrap();
        (folder, workspace)
    }

    #[test]
    fn a_handouts_book_is_unpacked_once_and_again_if_it_is_another() {
        let (root, workspace) = workspace(&[("part1/task1.html", "one"), ("index.html", "")]);
        let folder = make_current(&workspace).unwrap();
        let page = folder.join("part1/task1.html");
        assert_eq!(std::fs::read_to_string(&page).unwrap(), "one");
        assert_eq!(chapters(&folder).unwrap(), ["part1.task1"]);
        let markdown = Path::new("stages/book/src/part1/task1.md");
        assert_eq!(page_of(&workspace, markdown), Some(page.clone()));
        std::fs::write(&page, "kept").unwrap();
        make_current(&workspace).unwrap();
        assert_eq!(std::fs::read_to_string(&page).unwrap(), "kept");
        let other = packed::pack(&[("part1/task1.html".into(), b"two".to_vec())]);
        std::fs::write(root.path().join(PACK), other).unwrap();
        make_current(&workspace).unwrap();
        assert_eq!(std::fs::read_to_string(&page).unwrap(), "two");
        assert!(!folder.join("index.html").exists(), "left from before");
    }

    #[test]
    fn a_pack_that_leaves_its_folder_is_refused() {
        let (root, workspace) = workspace(&[("../../../out.html", "")]);
        let error = make_current(&workspace).unwrap_err().to_string();
        assert!(error.contains("is outside of it"), "{error}");
        assert!(!root.path().join("out.html").exists());
        assert_eq!(unpacked(&workspace), None);
    }

    #[test]
    fn without_a_book_the_error_says_where_to_read() {
        let (root, workspace) = workspace(&[]);
        std::fs::remove_file(root.path().join(PACK)).unwrap();
        let error = make_current(&workspace).unwrap_err().to_string();
        assert!(error.contains("stages/book/src"), "{error}");
    }
}
