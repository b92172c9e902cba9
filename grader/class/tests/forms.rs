//! The forms in which submissions arrive, and those that are refused.

use crate::git;
use class::reading::Unreadable;
use class::reading::intake::{self, Revision};
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

const STAGES: [&str; 2] = ["raygen", "intersect"];

/// The file that a submission has.
pub(crate) const LIB: &str = "stages/intersect/src/lib.rs";

pub(crate) type Files<'a> = &'a [(&'a str, &'a [u8])];

pub(crate) fn write(folder: &Path, files: Files) {
    for (name, contents) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        std::fs::write(path, contents).expect("a file");
    }
}

pub(crate) fn zip(files: Files) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, contents) in files {
        zip.start_file(*name, SimpleFileOptions::default())
            .expect("an entry");
        zip.write_all(contents).expect("its contents");
    }
    zip.finish().expect("a zip").into_inner()
}

pub(crate) fn tar(files: Files) -> Vec<u8> {
    let mut tar = tar::Builder::new(Vec::new());
    for (name, contents) in files {
        let mut header = tar::Header::new_ustar();
        header.set_size(contents.len() as u64);
        header.set_mode(0o644);
        // Not `set_path`, which refuses what a hostile archive contains.
        header.as_old_mut().name[..name.len()].copy_from_slice(name.as_bytes());
        header.set_cksum();
        tar.append(&header, *contents).expect("an entry");
    }
    tar.into_inner().expect("a tar")
}

pub(crate) fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    gzip.write_all(bytes).expect("compressed");
    gzip.finish().expect("compressed")
}

/// Opens a file with these bytes.
fn open(bytes: &[u8]) -> Result<(String, Vec<String>), Unreadable> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("anna.zip");
    std::fs::write(&path, bytes).expect("a file");
    open_path(&path, None)
}

/// Opens a submission and returns the text of its file, and the notes.
fn open_path(
    path: &Path,
    revision: Option<&Revision>,
) -> Result<(String, Vec<String>), Unreadable> {
    let opened = intake::open(path, &STAGES, revision)?;
    let text = std::fs::read_to_string(opened.root.join(LIB)).expect("the file was unpacked");
    Ok((text, opened.notes))
}

#[test]
fn archives_of_all_kinds_are_read() {
    let files: Files = &[(LIB, b"mod a;"), ("README.md", b"x")];
    let tar = tar(files);
    for bytes in [zip(files), gzip(&tar), tar] {
        let opened = open(&bytes).expect("it is read");
        assert_eq!(opened, ("mod a;".to_string(), Vec::new()));
    }
}

#[test]
fn a_project_that_lies_deeper_is_found() {
    let deep = format!("Anna Example/project-main/{LIB}");
    let (_, notes) =
        open(&zip(&[(&deep, b"x"), ("__MACOSX/._project-main", b"x")])).expect("it is read");
    assert_eq!(
        notes,
        ["its files are in the folder Anna Example/project-main"]
    );
    // A course system's folder with what the student zipped, which contains an archive again.
    let inner = gzip(&tar(&[(LIB, b"x")]));
    let outer = zip(&[
        ("submission/homework.tgz", &inner),
        ("submission/comments.txt", b"x"),
    ]);
    let (_, notes) = open(&outer).expect("it is read");
    assert_eq!(notes, ["its files are in the archive homework.tgz"]);
    // A program on Windows wrote the paths.
    let (text, _) =
        open(&zip(&[("fl\\stages\\intersect\\src\\lib.rs", b"mod w;")])).expect("it is read");
    assert_eq!(text, "mod w;");
}

#[test]
fn what_is_no_submission_is_said() {
    let two = zip(&[
        ("a/stages/raygen/src/lib.rs", b"x"),
        ("b/stages/raygen/src/lib.rs", b"x"),
    ]);
    let whole = zip(&[(LIB, &[b'x'; 4000])]);
    for (bytes, expected) in [
        (Vec::new(), "is empty, a file of 0 bytes"),
        (
            b"%PDF-1.7".to_vec(),
            "is a file of the form PDF, which is not read",
        ),
        (
            b"Rar!\x1a\x07\x01\0 and more".to_vec(),
            "is a file of the form RAR, which is not read: ask for a zip",
        ),
        (
            b"7z\xbc\xaf\x27\x1c and more".to_vec(),
            "is a file of the form 7z, which is not read",
        ),
        (
            b"dear teacher".to_vec(),
            "is neither a folder nor a zip, tar or tar.gz file",
        ),
        (
            zip(&[("report.pdf", b"x"), ("notes/a.txt", b"x")]),
            "contains no stage: expected stages/<stage>/src, where <stage> is raygen or intersect; found notes, report.pdf",
        ),
        (zip(&[]), "contains no stage"),
        (
            two,
            "contains two projects, a and b: remove the one that does not count",
        ),
        (
            whole[..whole.len() / 2].to_vec(),
            "is a damaged zip file: it ends too early, as after an upload that was cut. Ask for it again",
        ),
        (
            gzip(&tar(&[(LIB, &[b'x'; 4000])]))[..60].to_vec(),
            "is a damaged tar file: it ends too early, as after an upload",
        ),
        (
            tar(&[(LIB, &[b'x'; 4000])])[..700].to_vec(),
            "is a damaged tar file: it was cut or changed on its way",
        ),
        (
            b"PK\x05\x06\0\0\0\0\x01\0\x01\0\x40\0\0\0\xff\xff\0\0\0\0".to_vec(),
            "is a damaged zip file: its list of files cannot be read",
        ),
        (
            zip(&[("homework/Homework.RAR", b"Rar!\x1a\x07\x01\0 and more")]),
            "contains no stage, but Homework.RAR, a file of the form RAR, which is not read: ask for a zip",
        ),
    ] {
        match open(&bytes) {
            Err(Unreadable::Damaged(why)) => assert!(why.contains(expected), "{why}"),
            other => panic!("{other:?}, expected {expected}"),
        }
    }
}

#[test]
fn paths_that_lead_out_are_refused() {
    for name in [
        "../evil.rs",
        "stages/../../evil.rs",
        "/tmp/evil.rs",
        "C:\\evil.rs",
        "..\\evil.rs",
    ] {
        for bytes in [
            zip(&[(LIB, b"x"), (name, b"x")]),
            tar(&[(LIB, b"x"), (name, b"x")]),
        ] {
            match open(&bytes) {
                Err(Unreadable::Damaged(why)) => assert!(why.contains("refused"), "{name}: {why}"),
                other => panic!("{name}: {other:?}"),
            }
        }
    }
}

#[test]
fn links_in_archives_are_not_made() {
    let mut tar = tar::Builder::new(Vec::new());
    let mut header = tar::Header::new_gnu();
    header.set_entry_type(tar::EntryType::Symlink);
    header.set_size(0);
    tar.append_link(&mut header, "stages/intersect", "/etc")
        .expect("a link");
    let mut header = tar::Header::new_gnu();
    header.set_size(1);
    tar.append_data(&mut header, LIB, b"x".as_slice())
        .expect("a file");
    let (_, notes) = open(&tar.into_inner().expect("a tar")).expect("it is read");
    assert_eq!(notes, ["links were left out: stages/intersect"]);
}

#[test]
fn bombs_are_refused_and_forgotten_files_are_not() {
    let zeros = vec![0; 70 << 20];
    for bytes in [
        zip(&[(LIB, b"x"), ("stages/intersect/src/bomb.rs", &zeros)]),
        gzip(&tar(&[
            (LIB, b"x"),
            ("stages/intersect/src/bomb.rs", &zeros),
        ])),
    ] {
        assert!(bytes.len() < 1 << 20);
        match open(&bytes) {
            Err(Unreadable::TooLarge(why)) => assert!(why.contains("more than 64 MB"), "{why}"),
            other => panic!("{other:?}"),
        }
    }
    // Build output and pictures are only left out.
    let (_, notes) = open(&zip(&[
        (LIB, b"x"),
        ("target/release/worker", &zeros),
        ("a.exr", &zeros),
    ]))
    .expect("it is read");
    assert_eq!(notes, ["large files were left out: a.exr"]);
}

/// Runs git in `folder` as a student whose clock says `time`.
fn git(folder: &Path, time: &str, arguments: &[&str]) {
    let output = git::command(folder)
        .args(arguments)
        .envs([("GIT_COMMITTER_DATE", time), ("GIT_AUTHOR_DATE", time)])
        .output()
        .expect("git runs");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// A clone with a commit on the 19th and one on the 21st of November 2016, and other files beside.
fn clone(folder: &Path) {
    git(folder, "", &["init", "-q"]);
    for (text, time) in [
        ("in time", "2016-11-19T10:00:00Z"),
        ("late", "2016-11-21T10:00:00Z"),
    ] {
        write(folder, &[(LIB, text.as_bytes())]);
        git(folder, time, &["add", "-A"]);
        git(folder, time, &["commit", "-qm", text]);
    }
    git(folder, "", &["tag", "late-one"]);
    write(folder, &[(LIB, b"not committed")]);
}

/// A clone says when its commit was made, and whether the times can be right; what is no clone is a
/// question to the teacher.
#[test]
fn a_clone_says_when_it_was_committed() {
    let folder = tempfile::tempdir().expect("a folder");
    clone(folder.path());
    let read = |revision: &str| {
        let opened = intake::open(
            folder.path(),
            &STAGES,
            Some(&Revision::Commit(revision.into())),
        );
        opened.expect("a clone").commit.expect("its times")
    };
    let late = read("main");
    assert_eq!(
        (late.author, late.committer),
        (1_479_722_400, 1_479_722_400)
    );
    assert_eq!(late.doubt, None);
    // Its committer set the clock back, to before the deadline.
    git(
        folder.path(),
        "2016-11-18T10:00:00Z",
        &["commit", "-qam", "forged"],
    );
    let doubt = read("main").doubt.expect("it cannot be");
    assert_eq!(doubt, "committed before the commit that it follows");
    assert!(read("main~1").doubt.is_none());
    // A clone that calls itself shallow, and is not.
    let head = std::fs::read(folder.path().join(".git/refs/heads/main")).expect("a commit");
    let shallow = folder.path().join(".git/shallow");
    std::fs::write(&shallow, head).expect("a file");
    assert_eq!(read("main").doubt.as_ref(), Some(&doubt));
    std::fs::remove_file(shallow).expect("a file");
    // A clock that is wrong is no reason to be late for years.
    git(
        folder.path(),
        "2090-11-18T10:00:00Z",
        &["commit", "-q", "--allow-empty", "-m", "wrong clock"],
    );
    let doubt = read("main").doubt.expect("it cannot be");
    assert_eq!(doubt, "committed in the future");

    let other = tempfile::tempdir().expect("a folder");
    write(other.path(), &[(LIB, b"text")]);
    let revision = Revision::before("2016-11-20").expect("a time");
    match intake::open(other.path(), &STAGES, Some(&revision)) {
        Err(Unreadable::NoClone(why)) => assert!(why.contains("no git clone"), "{why}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_commit_that_counts_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    clone(folder.path());
    let text = |revision: Option<Revision>| {
        open_path(folder.path(), revision.as_ref()).map(|(text, _)| text)
    };
    let before = |time| Some(Revision::before(time).expect("a time"));
    assert_eq!(text(None), Ok("not committed".to_string()));
    let notes = |revision: Option<Revision>| {
        let opened = open_path(folder.path(), revision.as_ref());
        opened.expect("a clone").1.join("; ")
    };
    let changed = |are: &str| format!("changes that are in no commit are {are}: {LIB}");
    assert_eq!(notes(None), changed("graded"));
    let late = || Some(Revision::Commit("late-one".into()));
    assert_eq!(notes(late()), changed("not graded"));
    // As a clone on Windows has it.
    write(folder.path(), &[(LIB, b"late\r")]);
    assert_eq!([notes(None), notes(late())], ["", ""]);
    assert_eq!(
        text(before("2016-11-20T00:00:00Z")),
        Ok("in time".to_string())
    );
    assert_eq!(text(before("2016-11-22T00:00:00Z")), Ok("late".to_string()));
    assert_eq!(
        text(Some(Revision::Commit("late-one".into()))),
        Ok("late".to_string())
    );
    assert_eq!(
        text(Some(Revision::Commit("main~1".into()))),
        Ok("in time".to_string())
    );
    for (revision, expected) in [
        (
            before("2016-11-18T00:00:00Z"),
            "has no commit before 2016-11-18T00:00:00Z: its first commit is later",
        ),
        (
            Some(Revision::Commit("--help".into())),
            "has no commit, tag or branch --help",
        ),
    ] {
        match text(revision) {
            Err(Unreadable::Damaged(why)) => assert!(why.contains(expected), "{why}"),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_clone_without_files_is_called_so() {
    let folder = tempfile::tempdir().expect("a folder");
    clone(folder.path());
    std::fs::remove_dir_all(folder.path().join("stages")).expect("they are removed");
    for of_clone in [folder.path().to_path_buf(), folder.path().join(".git")] {
        let why = format!("{:?}", open_path(&of_clone, None));
        let expected = "it is the history of a git clone without its files";
        assert!(why.contains(expected), "{why}");
    }
}

/// What cannot be read because of the machine is not the fault of what was handed in.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fails_is_the_machines_fault() {
    // The system returns an error of input and output for the first byte of this file.
    let file = Path::new("/proc/self/mem");
    let read = intake::open(file, &STAGES, None);
    assert!(matches!(read, Err(Unreadable::Machine(_))), "{read:?}");
}

/// Settings of a clone may name programs, and its objects may be somebody else's.
#[cfg(unix)]
#[test]
fn a_clone_runs_nothing_and_reads_only_its_own_objects() {
    let folder = tempfile::tempdir().expect("a folder");
    let clone_folder = folder.path().join("clone");
    std::fs::create_dir(&clone_folder).expect("a folder");
    clone(&clone_folder);
    let ran = folder.path().join("ran");
    let program = format!("touch {}", ran.display());
    for setting in [
        "core.fsmonitor",
        "core.sshCommand",
        "core.pager",
        "core.alternateRefsCommand",
    ] {
        git(&clone_folder, "", &["config", setting, &program]);
    }
    let revision = Revision::Commit("main".into());
    let read = || open_path(&clone_folder, Some(&revision));
    assert!(read().is_ok());
    assert!(!ran.exists(), "a setting of the clone was run");

    let other = folder.path().join("other");
    std::fs::create_dir_all(other.join("objects")).expect("a folder");
    let alternates = clone_folder.join(".git/objects/info/alternates");
    write(
        &PathBuf::new(),
        &[(alternates.to_str().expect("UTF-8"), b"/somewhere/else")],
    );
    let refused = |read: Result<_, Unreadable>| match read {
        Err(Unreadable::Damaged(why)) => assert!(why.contains("refused"), "{why}"),
        other => panic!("{other:?}"),
    };
    refused(read());
    std::fs::remove_file(alternates).expect("it is removed");
    std::os::unix::fs::symlink(other.join("objects"), clone_folder.join(".git/objects/aa"))
        .expect("a link");
    refused(read());
}
