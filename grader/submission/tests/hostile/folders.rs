//! Folders that are not what a submission should be. Reading them runs no code and always ends.

use base::Workspace;
use files::file_tree;
use grader::course::Course;
use std::fs::File;
use std::path::Path;
use std::process::Command;
use submission::read::Submission;

/// The number of folders in this file.
pub(crate) const COUNT: usize = 12;

const LIB: &str = "stages/intersect/src/lib.rs";

/// Makes a folder, changes it and reads it.
fn read(change: impl Fn(&Path)) -> Result<Submission, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let workspace = Workspace::above(&root).expect("this is the course");
    let course = Course::read(&workspace).expect("the course is readable");
    let folder = tempfile::tempdir().expect("there is a folder");
    file_tree::write(&folder.path().join(LIB), b"mod a;").expect("it is writable");
    change(folder.path());
    Submission::read(folder.path(), &course, workspace.root()).map_err(|e| e.to_string())
}

/// Replaces `path` by what `make` makes.
fn replace(path: &Path, make: impl Fn(&Path)) {
    let _ = std::fs::remove_file(path);
    let folder = path.parent().expect("it is in a folder");
    std::fs::create_dir_all(folder).expect("it can be created");
    make(path);
}

fn pipe(path: &Path) {
    let made = Command::new("mkfifo").arg(path).status();
    assert!(made.expect("mkfifo runs").success());
}

fn link(to: &'static str) -> impl Fn(&Path) {
    move |path| std::os::unix::fs::symlink(to, path).expect("a link can be made")
}

/// A file that has a size, but takes no space.
fn file_of(bytes: u64) -> impl Fn(&Path) {
    move |path| {
        let file = File::create(path).expect("a file can be made");
        file.set_len(bytes).expect("it can have holes");
    }
}

/// Makes what is at a path.
type Maker<'a> = &'a dyn Fn(&Path);

const TERABYTE: u64 = 1 << 40;

#[test]
fn sources_that_are_no_files_are_refused() {
    let makers: [(Maker, &str); 5] = [
        (&pipe, "is not a regular file"),
        (&link("/dev/zero"), "is a link to a file outside"),
        (&link("/etc/passwd"), "is a link to a file outside"),
        (&link("lib.rs"), "cannot read"),
        (
            &file_of(TERABYTE),
            "has 1099511627776 bytes: expected at most",
        ),
    ];
    for (make, why) in makers {
        let error = read(|folder| replace(&folder.join(LIB), make)).expect_err(why);
        assert!(error.contains(why), "{error}");
    }
}

#[test]
fn bytes_that_are_no_text_are_left_to_the_compiler() {
    let bytes = |path: &Path| std::fs::write(path, [0xff; 9]).expect("it is writable");
    let submission = read(|folder| replace(&folder.join(LIB), bytes)).expect("it is read");
    let note = submission.notes.first().expect("it is said");
    assert!(note.starts_with("no UTF-8 text"), "{note}");
}

#[test]
fn folders_that_are_links_or_endless_are_refused() {
    let module = "stages/intersect/src/a";
    let error = read(|folder| replace(&folder.join(module), link("/")));
    assert!(error.expect_err("a link").contains("is a link to a folder"));
    let error = read(|folder| replace(&folder.join(module), link("..")));
    assert!(error.expect_err("a link").contains("is a link to a folder"));
    let many = read(|folder| {
        for i in 0..600 {
            let path = folder.join(format!("{module}/{i}.rs"));
            file_tree::write(&path, b"").expect("it is writable");
        }
    });
    assert!(
        many.expect_err("many")
            .contains("more than 500 source files")
    );
}

#[test]
fn what_is_not_a_source_is_listed_and_not_read() {
    // Files of this name exist in the course, too, and are compared with it.
    let other = "stages/kit/src/lib.rs";
    let makers: [Maker; 3] = [&pipe, &link("/dev/zero"), &file_of(TERABYTE)];
    for make in makers {
        let read = read(|folder| replace(&folder.join(other), make)).expect("it is read");
        assert_eq!(read.ignored, [other]);
        assert_eq!(read.stages["intersect"].len(), 1);
    }
}
