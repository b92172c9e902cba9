//! What a student handed in: the source files of stages, and nothing else.

use crate::file_tree::{self, Files};
use grader::course::Course;
use grader::error::GraderError;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A submission as it was read. None of its code has run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Submission {
    /// For each stage that was handed in, its files by their paths below `src/`.
    pub stages: BTreeMap<String, Files>,
    /// Files that it may not bring and that differ from the course's, by their paths in the submission.
    pub ignored: Vec<PathBuf>,
    /// Places that reach for files elsewhere, which a person should look at.
    pub reaches_out: Vec<String>,
}

/// A source file larger than this is no source file.
const LARGEST_FILE: u64 = 1 << 20;

/// Nor are more of them than this one stage.
const MOST_FILES: usize = 500;

/// And more than this below one folder are not a project.
const MOST_ENTRIES: usize = 50_000;

/// Files of a project that differ from the course's own without anybody's doing.
const USUAL: [&str; 4] = ["README.md", "Cargo.lock", "Cargo.toml", "report.json"];

/// Folders that are not looked into.
const PASSED_OVER: [&str; 2] = ["target", ".git"];

impl Submission {
    /// Reads the stages of `course` from `folder`: a whole project, or its folder `stages` alone. `trusted` is the
    /// course's own workspace.
    pub fn read(folder: &Path, course: &Course, trusted: &Path) -> Result<Submission, GraderError> {
        if folder.is_file() {
            return Err(GraderError::new(format!(
                "{} is a file. A submission is a folder with stages/<stage>/src in it: unpack it first",
                folder.display()
            )));
        }
        let failed = |e: std::io::Error| GraderError::file("open", folder, e);
        let top = folder.canonicalize().map_err(failed)?;
        let stages_folder = if is_there(&top.join("stages"))? {
            top.join("stages")
        } else {
            top.clone()
        };
        let mut submission = Submission::default();
        let stages = course.stages();
        for stage in &stages {
            let src = stages_folder.join(stage).join("src");
            if is_there(&src)? {
                let files = sources(&top, &src)?;
                submission.reaches_out.extend(reaches_out(stage, &files));
                if !files.is_empty() {
                    submission.stages.insert((*stage).to_string(), files);
                }
            }
        }
        if submission.stages.is_empty() {
            return Err(GraderError::new(format!(
                "{} holds no stage: looked for stages/<stage>/src, where <stage> is {}. Is it the right folder?",
                folder.display(),
                stages.join(" or ")
            )));
        }
        let taken = |path: &Path| {
            let below = path.strip_prefix(&stages_folder).ok();
            let mut names = below
                .into_iter()
                .flat_map(Path::iter)
                .map(|name| name.to_string_lossy());
            names.next().is_some_and(|stage| stages.contains(&&*stage))
                && names.next().is_some_and(|src| src == "src")
                && path.extension().is_some_and(|extension| extension == "rs")
        };
        let mut entries = 0;
        walk(&top, &mut entries, &mut |path| {
            let name = path.strip_prefix(&top).unwrap_or(path);
            let in_the_course = if stages_folder == top {
                Path::new("stages").join(name)
            } else {
                name.to_path_buf()
            };
            if !taken(path) && !is_the_courses(path, &in_the_course, trusted) {
                submission.ignored.push(name.to_path_buf());
            }
        })?;
        submission.ignored.sort();
        Ok(submission)
    }
}

/// Whether there is something at `path`. What cannot be looked at is an error: it must not be taken for missing.
fn is_there(path: &Path) -> Result<bool, GraderError> {
    match path.metadata() {
        Ok(_) => Ok(true),
        // A link that leads nowhere is there.
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(path.is_symlink()),
        Err(e) => Err(GraderError::file("read", path, e)),
    }
}

/// The Rust files below `src`, which is inside `top`.
fn sources(top: &Path, src: &Path) -> Result<Files, GraderError> {
    let mut files = Files::new();
    let mut folders = vec![src.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let failed = |e: std::io::Error| GraderError::file("read", &folder, e);
        let real = folder.canonicalize().map_err(failed)?;
        if folder.symlink_metadata().map_err(failed)?.is_symlink() || !real.starts_with(top) {
            return Err(GraderError::new(format!(
                "{} is a link to a folder. A submission must hold its files itself",
                folder.display()
            )));
        }
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let below = path.strip_prefix(src).unwrap_or(&path).to_path_buf();
                files.insert(below, source(top, &path)?);
                if files.len() > MOST_FILES {
                    return Err(GraderError::new(format!(
                        "{} holds more than {MOST_FILES} source files: that is no stage",
                        src.display()
                    )));
                }
            }
        }
    }
    Ok(files)
}

/// One source file, checked before it is read.
fn source(top: &Path, path: &Path) -> Result<Vec<u8>, GraderError> {
    let refused = |why: String| GraderError::new(format!("{} {why}", path.display()));
    let real = path
        .canonicalize()
        .map_err(|e| GraderError::file("read", path, e))?;
    if !real.starts_with(top) {
        return Err(refused(
            "is a link to a file outside the submission: put the file itself in its place".into(),
        ));
    }
    let about = real
        .metadata()
        .map_err(|e| GraderError::file("read", path, e))?;
    if !about.is_file() {
        return Err(refused(
            "is no plain file: put a text file in its place".into(),
        ));
    }
    if about.len() > LARGEST_FILE {
        return Err(refused(format!(
            "has {} bytes, and no source file has more than {LARGEST_FILE}",
            about.len()
        )));
    }
    if path.to_str().is_none() {
        return Err(refused("has a name that is not UTF-8: rename it".into()));
    }
    let contents = file_tree::read(top, &real)?;
    if std::str::from_utf8(&contents).is_err() {
        return Err(refused("is not UTF-8 text: save it as UTF-8".into()));
    }
    Ok(contents)
}

/// Calls `file` for everything below `folder` that is not a folder, or one that cannot be read. Links are not followed.
fn walk(
    folder: &Path,
    entries: &mut usize,
    file: &mut impl FnMut(&Path),
) -> Result<(), GraderError> {
    let failed = |e: std::io::Error| GraderError::file("read", folder, e);
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        *entries += 1;
        if *entries > MOST_ENTRIES {
            return Err(GraderError::new(format!(
                "{} holds more than {MOST_ENTRIES} files: that is no project. Is it the right folder?",
                folder.display()
            )));
        }
        let is_folder = entry.file_type().map_err(failed)?.is_dir();
        if !is_folder {
            file(&entry.path());
        } else if !PASSED_OVER.iter().any(|name| entry.file_name() == *name) {
            match std::fs::read_dir(entry.path()) {
                Ok(_) => walk(&entry.path(), entries, file)?,
                // Stages have been read by now: this is nothing that is needed.
                Err(_) => file(&entry.path()),
            }
        }
    }
    Ok(())
}

/// Whether the file `path` says what the course's own file `name` says, or is one that every handout has its own of.
fn is_the_courses(path: &Path, name: &Path, trusted: &Path) -> bool {
    if USUAL.iter().any(|usual| name == Path::new(usual)) {
        return true;
    }
    let (Ok(theirs), Ok(ours)) = (std::fs::read(path), std::fs::read(trusted.join(name))) else {
        return false;
    };
    let carved = || {
        String::from_utf8(ours.clone()).map(|text| crate::packages::manifest::without_tests(&text))
    };
    theirs == ours
        || name.ends_with("Cargo.toml") && carved().is_ok_and(|carved| theirs == carved.as_bytes())
        || is_carved(
            &String::from_utf8_lossy(&theirs),
            &String::from_utf8_lossy(&ours),
        )
}

/// Whether `theirs` is what carving left of `ours`, a file with solutions: all that it says stands there, too, if only in
/// a stub, and perhaps on other lines.
fn is_carved(theirs: &str, ours: &str) -> bool {
    let dense = |text: &str| -> String { text.chars().filter(|c| !c.is_whitespace()).collect() };
    let all_of_ours = dense(&ours.replace("// STUB:", ""));
    ours.contains("// BEGIN SOLUTION(")
        && theirs
            .lines()
            .all(|line| all_of_ours.contains(&dense(line)))
}

/// Lines that reach for files outside their own module tree. Only a person can say whether that is harmless.
fn reaches_out(stage: &str, files: &Files) -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in files {
        for (number, line) in (1..).zip(String::from_utf8_lossy(text).lines()) {
            let dense: String = line.chars().filter(|c| !c.is_whitespace()).collect();
            let reach = [
                "include!",
                "include_str!",
                "include_bytes!",
                "[path=",
                "env!(",
                "std::fs",
                "std::process",
            ]
            .into_iter()
            .find(|word| dense.contains(word));
            if let Some(word) = reach {
                found.push(format!(
                    "stages/{stage}/src/{}:{number}: `{word}`",
                    path.display()
                ));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const COURSE: &str = r#"
        conventions = []
        [[part]]
        number = 1
        title = "A part"
        [[part.task]]
        key = "part1.task1"
        title = "A task"
        stage = "intersect"
        holes = ["f"]
        cases = [{ name = "a", tier = "core", points = 1 }]
    "#;

    /// A submission with the given files, read.
    fn read(files: &[(&str, &[u8])]) -> (tempfile::TempDir, Result<Submission, String>) {
        let folder = tempfile::tempdir().unwrap();
        for (path, contents) in files {
            file_tree::write(&folder.path().join(path), contents).unwrap();
        }
        let read = reread(&folder);
        (folder, read)
    }

    fn reread(folder: &tempfile::TempDir) -> Result<Submission, String> {
        let course = Course::parse(COURSE).unwrap();
        let read = Submission::read(folder.path(), &course, Path::new("/nowhere"));
        read.map_err(|e| e.to_string())
    }

    #[test]
    fn a_project_and_its_folder_of_stages_are_the_same_submission() {
        let (_a, whole) = read(&[
            ("stages/intersect/src/lib.rs", b"mod m;"),
            ("stages/intersect/src/m/n.rs", b""),
        ]);
        let (_b, stages) = read(&[
            ("intersect/src/lib.rs", b"mod m;"),
            ("intersect/src/m/n.rs", b""),
        ]);
        let whole = whole.unwrap();
        assert_eq!(whole, stages.unwrap());
        let names: Vec<_> = whole.stages["intersect"].keys().cloned().collect();
        assert_eq!(names, [PathBuf::from("lib.rs"), PathBuf::from("m/n.rs")]);
    }

    #[test]
    fn everything_but_source_files_is_named_and_left() {
        let (_folder, submission) = read(&[
            ("stages/intersect/src/lib.rs", b""),
            ("stages/intersect/src/data.bin", b"x"),
            ("stages/intersect/build.rs", b"x"),
            ("stages/intersect/Cargo.toml", b"x"),
            ("stages/kit/src/lib.rs", b"x"),
            (".cargo/config.toml", b"x"),
            ("target/debug/x", b"x"),
            ("README.md", b"x"),
        ]);
        let ignored = submission.unwrap().ignored;
        let expected = [
            ".cargo/config.toml",
            "stages/intersect/Cargo.toml",
            "stages/intersect/build.rs",
            "stages/intersect/src/data.bin",
            "stages/kit/src/lib.rs",
        ];
        assert_eq!(ignored, expected.map(PathBuf::from));
    }

    #[test]
    fn what_a_handout_was_given_is_not_named() {
        let trusted = tempfile::tempdir().unwrap();
        let theirs = "fn f() {\n    kit::hole!(\"part6.task1\")\n}\n";
        let ours = "fn f() {\n    // BEGIN SOLUTION(part6.task1)\n    g(1);\n    // STUB: kit::hole!(\n    // STUB: \"part6.task1\")\n    // END SOLUTION(part6.task1)\n}\n";
        let path = Path::new("stages/simd/src/lib.rs");
        file_tree::write(&trusted.path().join(path), ours.as_bytes()).unwrap();
        let (folder, _) = read(&[("stages/intersect/src/lib.rs", b"")]);
        let ignored = |text: &str| {
            file_tree::write(&folder.path().join(path), text.as_bytes()).unwrap();
            let course = Course::parse(COURSE).unwrap();
            let read = Submission::read(folder.path(), &course, trusted.path());
            read.unwrap().ignored
        };
        assert!(ignored(theirs).is_empty());
        assert_eq!(
            ignored(&theirs.replace("hole", "whole")),
            [path.to_path_buf()]
        );
    }

    #[test]
    fn code_that_reaches_for_files_is_pointed_out() {
        let code = b"fn f() {}\nconst A: &str = include_str! (\"../../x\");\n";
        let (_folder, submission) = read(&[("stages/intersect/src/lib.rs", code)]);
        let expected = ["stages/intersect/src/lib.rs:2: `include_str!`"];
        assert_eq!(submission.unwrap().reaches_out, expected);
    }

    #[test]
    fn what_cannot_be_a_submission_is_refused_in_a_sentence() {
        let lib = "stages/intersect/src/lib.rs";
        let large = vec![b' '; LARGEST_FILE as usize + 1];
        for (files, why) in [
            (
                &[("README.md", b"x".as_slice())],
                "holds no stage: looked for stages/<stage>/src, where <stage> is intersect.",
            ),
            (
                &[(lib, b"\xff\xfe".as_slice())],
                "lib.rs is not UTF-8 text: save it as UTF-8",
            ),
            (&[(lib, large.as_slice())], "no source file has more than"),
        ] {
            let (_folder, submission) = read(files);
            let error = submission.unwrap_err();
            assert!(error.contains(why), "{error}");
        }
    }

    /// Also as the superuser, who may read everything: a link that leads to itself cannot be read by anybody.
    #[cfg(unix)]
    #[test]
    fn what_cannot_be_read_is_not_taken_for_missing() {
        let folder = tempfile::tempdir().unwrap();
        let stages = folder.path().join("stages");
        std::os::unix::fs::symlink(&stages, &stages).unwrap();
        let error = reread(&folder).unwrap_err();
        assert!(error.contains("cannot read"), "{error}");
        assert!(error.contains("stages"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn folders_that_may_not_be_read() {
        use std::os::unix::fs::PermissionsExt;
        let (folder, _) = read(&[
            ("stages/intersect/src/lib.rs", b""),
            ("notes/private/x", b""),
        ]);
        let forbid = |name: &str, mode: u32| {
            let mode = std::fs::Permissions::from_mode(mode);
            std::fs::set_permissions(folder.path().join(name), mode).unwrap();
        };
        forbid("notes/private", 0);
        if std::fs::read_dir(folder.path().join("notes/private")).is_ok() {
            println!("skipped: the superuser may read everything");
            return;
        }
        assert_eq!(
            reread(&folder).unwrap().ignored,
            [PathBuf::from("notes/private")]
        );
        forbid("stages/intersect", 0);
        assert!(reread(&folder).unwrap_err().contains("cannot read"));
        for name in ["stages/intersect", "notes/private"] {
            forbid(name, 0o700);
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_submission_are_refused_and_links_inside_are_not() {
        use std::os::unix::fs::symlink;
        let (folder, _) = read(&[("stages/intersect/src/lib.rs", b"mod a;")]);
        let src = folder.path().join("stages/intersect/src");
        symlink(src.join("lib.rs"), src.join("a.rs")).unwrap();
        assert_eq!(reread(&folder).unwrap().stages["intersect"].len(), 2);
        symlink("/etc/hostname", src.join("b.rs")).unwrap();
        assert!(
            reread(&folder)
                .unwrap_err()
                .contains("b.rs is a link to a file outside the submission")
        );
        std::fs::remove_file(src.join("b.rs")).unwrap();
        symlink(folder.path(), src.join("round")).unwrap();
        assert!(reread(&folder).unwrap_err().contains("link to a folder"));
    }
}
