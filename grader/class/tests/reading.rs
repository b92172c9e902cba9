//! What was handed in is read in a process with limits: whatever happens to that process is one row,
//! and the others are read.

use crate::git;
use base::Workspace;
use class::plan::{Plan, Settings, State};
use class::reading::Reader;
use class::reading::content;
use class::reading::intake::Revision;
use class::reading::process::ReadingLimits;
use grader::course::Course;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use submission::containment::Containment;

/// Less memory and output than for a real class, so that the tests are fast. No test meets its limits
/// of time.
const LIMITS: ReadingLimits = ReadingLimits {
    cpu_seconds: 500,
    elapsed: Duration::from_secs(5000),
    memory_mb: 256,
    output: 2 << 20,
};

const LIB: &str = "stages/intersect/src/lib.rs";

fn workspace() -> Workspace {
    Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("this is the course")
}

fn write(path: &Path, contents: &[u8]) {
    std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    std::fs::write(path, contents).expect("a file");
}

/// Runs a command with an input, and returns what it prints.
fn output(command: &mut Command, input: &str) -> String {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut stdin = child.stdin.take().expect("an input");
    stdin.write_all(input.as_bytes()).expect("it reads");
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{command:?}");
    String::from_utf8(output.stdout)
        .expect("UTF-8")
        .trim()
        .to_string()
}

fn git(folder: &Path, arguments: &[&str], input: &str) -> String {
    let dates =
        ["GIT_COMMITTER_DATE", "GIT_AUTHOR_DATE"].map(|name| (name, "2016-11-01T10:00:00Z"));
    output(git::command(folder).args(arguments).envs(dates), input)
}

/// The program `class` with another `git` before it: `lists` is what that one does where it is to list
/// files; everything else the real one does.
#[cfg(unix)]
fn with_git_that(folder: &Path, lists: &str) -> PathBuf {
    use std::os::unix::fs::PermissionsExt;
    let write = |path: PathBuf, script: String| {
        write(&path, format!("#!/bin/sh\n{script}\n").as_bytes());
        let rights = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(&path, rights).expect("rights");
        path
    };
    let script = format!(
        "case \" $* \" in *\" ls-tree \"*) {lists} ;; esac\nPATH=${{PATH#*:}} exec git \"$@\""
    );
    let git = write(folder.join("bin/git"), script);
    let bin = git.parent().expect("a folder").display();
    let program = env!("CARGO_BIN_EXE_class");
    let class = format!("PATH=\"{bin}:$PATH\" exec \"{program}\" \"$@\"");
    write(folder.join("class"), class)
}

/// A clone whose file was cut on its way.
fn cut_blob(folder: &Path) {
    write(&folder.join(LIB), &incompressible(300_000));
    git(folder, &["init", "--quiet"], "");
    git(folder, &["add", "--all"], "");
    git(folder, &["commit", "--quiet", "--message", "all"], "");
    let hash = git(folder, &["rev-parse", &format!("HEAD:{LIB}")], "");
    let object = folder
        .join(".git/objects")
        .join(&hash[..2])
        .join(&hash[2..]);
    let bytes = std::fs::read(&object).expect("the object");
    std::fs::remove_file(&object).expect("it is removed"); // it is read-only
    std::fs::write(&object, &bytes[..bytes.len() / 2]).expect("it is cut");
}

fn incompressible(length: usize) -> Vec<u8> {
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    (0..length).map(|_| next()).collect()
}

/// A small tar.gz with an entry of this kind that contains `megabytes` of a name.
fn long_name(path: &Path, kind: tar::EntryType, megabytes: u64) {
    let size = megabytes << 20;
    let mut header = tar::Header::new_gnu();
    header.set_entry_type(kind);
    header.set_size(size);
    header.set_path("././@LongLink").expect("a name");
    header.set_cksum();
    let file = std::fs::File::create(path).expect("a file");
    let mut gzip = flate2::write::GzEncoder::new(file, flate2::Compression::fast());
    gzip.write_all(header.as_bytes()).expect("it is written");
    std::io::copy(&mut std::io::repeat(b'a').take(size), &mut gzip).expect("it is written");
    gzip.finish().expect("it is written");
}

/// Folders inside each other, deeper than a path can name.
fn deep_folders(folder: &Path) {
    let src = folder.join("stages/intersect/src");
    write(&src.join("lib.rs"), b"");
    let script = "i=0; while [ $i -lt 1900 ]; do mkdir f && cd -P f || exit 1; i=$((i+1)); done";
    let mut shell = Command::new("sh");
    output(shell.args(["-c", script]).current_dir(src), "");
}

/// A class with one submission of each kind, and those that are as they should be.
fn class(folder: &Path) {
    for name in ["anna", "zoe"] {
        write(&folder.join(name).join(LIB), b"mod a;\n");
        git(&folder.join(name), &["init", "--quiet"], "");
        git(&folder.join(name), &["add", "--all"], "");
        git(
            &folder.join(name),
            &["commit", "--quiet", "--message", "all"],
            "",
        );
    }
    cut_blob(&folder.join("cut"));
}

/// Another class, of folders and archives.
fn archives(folder: &Path) {
    for name in ["anna", "zoe"] {
        write(&folder.join(name).join(LIB), b"mod a;\n");
    }
    deep_folders(&folder.join("deep"));
    let long = Path::new("stages/intersect/src")
        .join(["d".repeat(200), "e".repeat(200), "f".repeat(200)].join("/"));
    write(&folder.join("long").join(long).join("a.rs"), b"");
    write(&folder.join("none/stages/intersect/src/a.txt"), b"x");
    long_name(&folder.join("gnu.tgz"), tar::EntryType::GNULongName, 300);
    long_name(&folder.join("pax.tgz"), tar::EntryType::XHeader, 300);
    for i in 0..4 {
        let path = format!("large/stages/intersect/src/m{i}.rs");
        write(&folder.join(path), &[b' '; 1 << 20]);
    }
    write(
        &folder.join("\u{1b}[2J\u{202e}name.zip"),
        b"PK\x03\x04 and nothing more",
    );
    #[cfg(target_os = "linux")]
    {
        use std::os::unix::ffi::OsStrExt;
        write(&folder.join(OsStr::from_bytes(b"caf\xe9.zip")), b"x");
    }
}

/// Reads the class in `folder`. Returns what is said about each, by its name.
fn read(folder: &Path, containment: Containment, before: Option<&str>) -> BTreeMap<String, String> {
    let program = Path::new(env!("CARGO_BIN_EXE_class"));
    read_by(program, folder, containment, before, LIMITS)
}

/// The same, with this program instead of `class`, and these limits.
fn read_by(
    program: &Path,
    folder: &Path,
    containment: Containment,
    before: Option<&str>,
    limits: ReadingLimits,
) -> BTreeMap<String, String> {
    let workspace = workspace();
    let course = Course::read(&workspace).expect("a course");
    let reader = Reader::new(program, &workspace, containment, limits);
    let settings = Settings {
        what: "part1".into(),
        seed: 7,
        limits: String::new(),
        revision: before.map(|time| Revision::before(time).expect("a time")),
        course: BTreeMap::new(),
    };
    let plan = Plan::make(folder, &course, &reader, settings, false, |_, _| {}).expect("a plan");
    let submissions = plan.submissions.into_iter();
    let said = submissions.map(|planned| {
        let said = match planned.state {
            State::Unit { .. } => "read".to_string(),
            State::TooLarge(why) => format!("too large: {}", why.raw()),
            State::Unreadable(why) => format!("unreadable: {}", why.raw()),
            State::NoClone(why) => format!("no clone: {}", why.raw()),
            State::NotRead(why) => format!("not read: {}", why.raw()),
        };
        (planned.name.line(), said)
    });
    said.collect()
}

fn assert_said(said: &BTreeMap<String, String>, expected: &[(&str, &str)]) {
    for (name, expected) in expected {
        let said = said
            .get(*name)
            .unwrap_or_else(|| panic!("no {name}: {said:?}"));
        assert!(said.starts_with(expected), "{name}: {said}");
    }
}

fn clones_are_read(containment: Containment) {
    let folder = tempfile::tempdir().expect("a folder");
    class(folder.path());
    let said = read(folder.path(), containment, Some("2016-11-20"));
    assert_said(
        &said,
        &[
            ("anna", "read"),
            (
                "cut",
                "unreadable: is an incomplete clone: the contents of stages/intersect/src/lib.rs are missing or cut",
            ),
            ("zoe", "read"),
        ],
    );
}

/// A clone can make git list files without end. A `git` that only prints, or that dies as the system
/// lets it die at its limit, stands for that.
#[cfg(unix)]
#[test]
fn git_is_read_within_limits() {
    let folder = tempfile::tempdir().expect("a folder");
    class(&folder.path().join("class"));
    // Of its memory the reading process needs 64 MB for the list and, for a moment, 128 for a
    // thread.
    let limits = ReadingLimits {
        memory_mb: 1024,
        ..LIMITS
    };
    let limit = limits.cpu_seconds;
    for (number, lists, expected) in [
        (
            1,
            "exec yes '100644 blob 0 a.rs'".to_string(),
            "too large: has a list of files of more than 32 MB",
        ),
        (
            2,
            format!("[ \"$(ulimit -t)\" != {limit} ] || kill -XCPU $$"),
            "too large: is a clone that git cannot read within the limits",
        ),
        (
            3,
            "kill -KILL $$".to_string(),
            "not read: cannot read it: the system killed git",
        ),
        (4, ":".to_string(), "read"),
    ] {
        let program = with_git_that(&folder.path().join(number.to_string()), &lists);
        let class = folder.path().join("class");
        let said = read_by(
            &program,
            &class,
            Containment::None,
            Some("2016-11-20"),
            limits,
        );
        assert_said(&said, &[("anna", expected), ("zoe", expected)]);
    }
}

fn archives_are_read(containment: Containment) {
    let folder = tempfile::tempdir().expect("a folder");
    archives(folder.path());
    let said = read(folder.path(), containment, None);
    assert_said(
        &said,
        &[
            ("anna", "read"),
            (
                "deep",
                "unreadable: cannot be used: stages/intersect/src contains folders inside each other",
            ),
            (
                "gnu",
                "too large: is a tar file that cannot be unpacked within the limit of memory",
            ),
            ("large", "too large: has more than 2 MB of source files"),
            (
                "long",
                "unreadable: cannot be used: stages/intersect/src contains a path of more than 512 bytes",
            ),
            // Pages and tables name no folder of the machine.
            (
                "none",
                "unreadable: cannot be used: its folder contains no stage",
            ),
            (
                "pax",
                "too large: is a tar file that cannot be unpacked within the limit of memory",
            ),
            (
                "\\u{1b}[2J\\u{202e}name",
                "unreadable: is a damaged zip file: it ends too early",
            ),
            ("zoe", "read"),
        ],
    );
    #[cfg(target_os = "linux")]
    assert_said(
        &said,
        &[("caf\u{fffd}", "unreadable: has a name that is not UTF-8")],
    );
}

#[cfg(unix)]
#[test]
fn a_clone_stops_only_itself() {
    clones_are_read(Containment::None);
}

#[cfg(unix)]
#[test]
fn an_archive_or_a_folder_stops_only_itself() {
    archives_are_read(Containment::None);
}

/// Where nothing can be read, what was handed in is not to blame.
#[cfg(unix)]
#[test]
fn a_machine_that_cannot_read_its_own_course_reads_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    write(&folder.path().join("anna").join(LIB), b"mod a;\n");
    let little = ReadingLimits {
        memory_mb: 12,
        output: 10,
        ..LIMITS
    };
    for limits in [
        ReadingLimits {
            output: 10,
            ..LIMITS
        },
        little,
    ] {
        let program = Path::new(env!("CARGO_BIN_EXE_class"));
        let said = read_by(program, folder.path(), Containment::None, None, limits);
        assert_said(&said, &[("anna", "not read: ")]);
    }
}

/// As in the commands of the book: `grader class ../submissions`.
#[cfg(unix)]
#[test]
fn a_class_is_named_from_the_current_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    write(&folder.path().join("anna").join(LIB), b"mod a;\n");
    let here = std::env::current_dir().expect("a folder");
    let up: PathBuf = here.ancestors().skip(1).map(|_| "..").collect();
    let folder = folder.path().canonicalize().expect("a folder");
    let relative = up.join(folder.strip_prefix("/").expect("it begins at the root"));
    let said = read(&relative, Containment::None, None);
    assert_said(&said, &[("anna", "read")]);
}

/// In the sandbox, reading is limited in the same way, and can write nothing but its temporary folder.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "slow: builds the launcher"]
fn the_sandbox_reads_a_class_in_the_same_way() {
    let containment = Containment::choose(&workspace(), false).expect("a sandbox");
    clones_are_read(containment.clone());
    archives_are_read(containment);
}

/// When the course changes, so does which given files it does not take: nobody handed in others.
#[test]
fn files_that_the_course_does_not_take_make_another_unit_and_no_other_submission() {
    let course = Course::read(&workspace()).expect("the course is sound");
    let read = |files: &[&str]| {
        let folder = tempfile::tempdir().expect("a folder");
        for file in files {
            write(&folder.path().join(file), b"// mine\n");
        }
        content::read(folder.path(), &course, &workspace(), None).expect("it is read")
    };
    let [plain, with_more] = [&[LIB][..], &[LIB, "stages/intersect/Cargo.toml"]].map(read);
    assert_eq!(plain.files, with_more.files);
    assert_ne!(plain.hash, with_more.hash);
}
