//! Reads what a student handed in: the source files of stages, and nothing else.

use crate::Untrusted;
use crate::given::Given;
use crate::not_graded::NotGraded;
use crate::{scan, source_file};
use base::GraderError;
use files::file_tree::Files;
use formats::{Layout, shown};
use grader::course::{Course, Task, sources};
use grader::examples;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;

/// The files of a submission. Reading them runs none of its code.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Submission {
    /// For each stage that was handed in, its files by their paths below `src/`.
    pub stages: BTreeMap<String, Files>,
    /// The examples of stages that were handed in, as text.
    #[serde(default)]
    pub examples: BTreeMap<String, String>,
    /// Paths of files that are not graded: they are not source files of a stage, and they differ
    /// from the course's own.
    pub ignored: Vec<Untrusted>,
    /// Those of them that decide points in the student's own runs, such as `stages/kit`: the
    /// student was given them and changed them.
    pub changed_given: Vec<Untrusted>,
    /// Code that a person should look at, a sentence each: lines that may access files or start
    /// programs, tables.
    pub to_check: Vec<String>,
    /// What was unusual about files and was mended or will not compile, as sentences.
    pub notes: Vec<String>,
    /// Stages with code that has no business in a stage, which are not compiled: a sentence for
    /// each place.
    pub forbidden: BTreeMap<String, Vec<String>>,
}

/// The maximum number of source files of a stage.
const MAX_FILES: usize = 500;

/// The maximum number of files and folders of a submission that are compared with the given ones.
/// Forgotten build results or packages of another language may be many more.
const MAX_ENTRIES: usize = 50_000;

/// Folders whose contents are not read.
const SKIPPED_FOLDERS: [&str; 2] = ["target", ".git"];

/// How deep folders may lie inside each other. The system finds the way to each file anew, so the
/// time to read thousands of folders inside each other grows with the square of their number.
const MAX_DEPTH: usize = 64;

/// The longest path of a source file below `src`, in bytes, as of an archive's: a system may not
/// find the place of a longer one in the folder that it is compiled in.
const MAX_PATH: usize = 512;

/// How deep the sources of a stage lie in a project: `stages/STAGE/src`.
const SOURCES_DEPTH: usize = 3;

impl Submission {
    /// Reads the stages of `course` from `folder`: a whole project, or only its folder `stages`.
    /// `trusted` is the course's own workspace.
    pub fn read(folder: &Path, course: &Course, trusted: &Path) -> Result<Submission, NotGraded> {
        // An error names a file of the student's.
        let line = |why: String| shown(&why, Layout::Line);
        Submission::of(folder, course, trusted).map_err(|error| match error {
            NotGraded::Refused(why) => NotGraded::Refused(line(why)),
            NotGraded::Infrastructure(why) => NotGraded::Infrastructure(line(why)),
        })
    }

    fn of(folder: &Path, course: &Course, trusted: &Path) -> Result<Submission, NotGraded> {
        if folder.is_file() {
            return Err(NotGraded::Refused(format!(
                "{} is a file. Expected a folder that contains stages/<stage>/src: if it is an archive, unpack it first",
                folder.display()
            )));
        }
        let top = folder
            .canonicalize()
            .map_err(|e| GraderError::file("open", folder, e))?;
        let stages_folder = if exists(&top.join("stages"))? {
            top.join("stages")
        } else {
            top.clone()
        };
        let mut submission = Submission::default();
        let has_examples = |stage: &str| {
            let of_stage = |task: &&Task| task.stage == stage && task.examples > 0.0;
            course.tasks().any(|task| of_stage(&task))
        };
        let mut notes = Notes::new();
        let stages = course.stages();
        for stage in &stages {
            let examples = stages_folder.join(stage).join(examples::FILE);
            if has_examples(stage) && exists(&examples)? {
                let text = source_file::read(&top, &examples)?.text;
                let text = String::from_utf8_lossy(&text).into_owned();
                submission.examples.insert((*stage).to_string(), text);
            }
            let src = stages_folder.join(stage).join("src");
            if exists(&src)? {
                let files = source_files(&top, &src, &mut notes)?;
                let code = code_of(&files);
                let found = reaches_out(stage, &code);
                submission.to_check.extend(first_places(found));
                submission.to_check.extend(scan::table(stage, &code));
                let mut forbidden = scan::forbidden(stage, &code);
                forbidden.extend(zeros(stage, &files));
                let forbidden = first_places(forbidden);
                if !forbidden.is_empty() {
                    submission.forbidden.insert((*stage).to_string(), forbidden);
                }
                if !files.is_empty() {
                    submission.stages.insert((*stage).to_string(), files);
                }
            }
        }
        if submission.stages.is_empty() {
            return Err(NotGraded::Refused(format!(
                "{} contains no stage: expected a folder stages/<stage>/src, where <stage> is {}. Is it the right folder?",
                folder.display(),
                stages.join(" or ")
            )));
        }
        let is_source = |path: &Path| {
            let below = path.strip_prefix(&stages_folder).ok();
            let mut names = below
                .into_iter()
                .flat_map(Path::iter)
                .map(|name| name.to_string_lossy());
            let Some(stage) = names.next().filter(|stage| stages.contains(&&**stage)) else {
                return false;
            };
            let is_rust = path.extension().is_some_and(|extension| extension == "rs");
            names.next().is_some_and(|name| {
                name == "src" && is_rust
                    || name == examples::FILE && submission.examples.contains_key(&*stage)
            })
        };
        let given = Given::of(&top, &stages_folder, trusted);
        let all = for_each_file(&top, &mut |path| {
            let name = path.strip_prefix(&top).unwrap_or(path);
            let path_in_course = if stages_folder == top {
                Path::new("stages").join(name)
            } else {
                name.to_path_buf()
            };
            if !is_source(path) && !given.is_unchanged(path, &path_in_course) {
                let name = Untrusted::new(name.to_string_lossy());
                if given.decides(&path_in_course) {
                    submission.changed_given.push(name.clone());
                }
                submission.ignored.push(name);
            }
        })?;
        submission.notes = notes.into_iter().map(note).collect();
        if !all {
            // Those that were found first depend on the order of a folder's entries.
            submission.ignored.clear();
            submission.changed_given.clear();
            submission.notes.push(format!(
                "more than {MAX_ENTRIES} files and folders: which of them are ignored is not listed"
            ));
        }
        submission.ignored.sort();
        submission.changed_given.sort();
        Ok(submission)
    }
}

impl Submission {
    /// Why a stage that was handed in is not built, a sentence a line; empty if it is.
    pub fn why_not_built(&self, stage: &str) -> String {
        if let Some(forbidden) = self.forbidden.get(stage) {
            return forbidden.iter().flat_map(|why| [why, "\n"]).collect();
        }
        let has_root = |files: &Files| files.contains_key(Path::new("lib.rs"));
        match self.stages.get(stage).is_some_and(has_root) {
            true => String::new(),
            false => format!("stages/{stage}/src has no lib.rs, so it cannot be built\n"),
        }
    }
}

/// What was unusual about files, and their names.
type Notes = BTreeMap<&'static str, Vec<String>>;

/// A sentence about files with the same peculiarity.
fn note((what, mut files): (&'static str, Vec<String>)) -> String {
    files.sort();
    match files.as_slice() {
        [] => what.to_string(),
        [file] => format!("{what}: {file}"),
        [file, more @ ..] => format!("{what}: {file} and {} more", more.len()),
    }
}

/// Whether `path` exists. A path that cannot be accessed is an error: it must not count as missing.
fn exists(path: &Path) -> Result<bool, NotGraded> {
    match path.metadata() {
        Ok(_) => Ok(true),
        // A broken link counts as existing.
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(path.is_symlink()),
        Err(e) => Err(NotGraded::at("read", path, &e)),
    }
}

/// The files that are text. The compiler refuses the others, if a module names them.
fn code_of(files: &Files) -> Cow<'_, Files> {
    let is_text = |text: &Vec<u8>| sources::why_no_text(text).is_none();
    match files.values().all(is_text) {
        true => Cow::Borrowed(files),
        false => {
            let texts = files.iter().filter(|(_, text)| is_text(text));
            Cow::Owned(
                texts
                    .map(|(path, text)| (path.clone(), text.clone()))
                    .collect(),
            )
        }
    }
}

/// A sentence for each file that is no text, but of zero bytes and others that the compiler may take
/// for text.
fn zeros(stage: &str, files: &Files) -> Vec<String> {
    let found = files.iter().filter_map(|(path, text)| {
        let why = sources::why_no_text(text)?;
        let path = Untrusted::new(path.to_string_lossy()).line();
        let is_utf8 = std::str::from_utf8(text).is_ok();
        is_utf8.then(|| format!("stages/{stage}/src/{path} is {why}"))
    });
    found.collect()
}

/// Reads the Rust files below `src`, which is inside `top`. Appends what was unusual about them to
/// `notes`.
fn source_files(top: &Path, src: &Path, notes: &mut Notes) -> Result<Files, NotGraded> {
    let link = |folder: &Path| {
        NotGraded::Refused(format!(
            "{} is a link to a folder. A submission must contain the files themselves",
            folder.display()
        ))
    };
    // Below a folder that is reached without a link, only links lead out.
    let real = src
        .canonicalize()
        .map_err(|e| NotGraded::at("read", src, &e))?;
    if !real.starts_with(top) {
        return Err(link(src));
    }
    let mut files = Files::new();
    let mut folders = vec![(src.to_path_buf(), 0)];
    while let Some((folder, depth)) = folders.pop() {
        let failed = |e: std::io::Error| NotGraded::at("read", &folder, &e);
        if folder.symlink_metadata().map_err(failed)?.is_symlink() {
            return Err(link(&folder));
        }
        if depth > MAX_DEPTH {
            return Err(NotGraded::Refused(format!(
                "{} contains folders inside each other, more than {MAX_DEPTH} deep: too deep for a stage",
                src.display()
            )));
        }
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.is_dir() {
                folders.push((path, depth + 1));
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let below = path.strip_prefix(src).unwrap_or(&path).to_path_buf();
                if below.as_os_str().len() > MAX_PATH {
                    return Err(NotGraded::Refused(format!(
                        "{} contains a path of more than {MAX_PATH} bytes: too long for a stage",
                        src.display()
                    )));
                }
                let file = source_file::read(top, &path)?;
                let name = path.strip_prefix(top).unwrap_or(&path).display();
                if let Some(note) = file.note {
                    let name = Untrusted::new(name.to_string()).line();
                    notes.entry(note).or_default().push(name);
                }
                files.insert(below, file.text);
                if files.len() > MAX_FILES {
                    return Err(NotGraded::Refused(format!(
                        "{} contains more than {MAX_FILES} source files: too many for a stage",
                        src.display()
                    )));
                }
            }
        }
    }
    Ok(files)
}

/// Calls `visit` for every file below `folder` and for every folder that cannot be read, but not
/// below `SKIPPED_FOLDERS`. Does not follow links. Returns whether these were all: it stops after
/// `MAX_ENTRIES`, and visits folders that are too deep instead of what is in them.
pub fn for_each_file(folder: &Path, visit: &mut impl FnMut(&Path)) -> Result<bool, NotGraded> {
    walk(folder, SOURCES_DEPTH + MAX_DEPTH, &mut 0, visit)
}

/// The same down to `depth`, if `entries` were met before.
fn walk(
    folder: &Path,
    depth: usize,
    entries: &mut usize,
    visit: &mut impl FnMut(&Path),
) -> Result<bool, NotGraded> {
    let failed = |e: std::io::Error| NotGraded::at("read", folder, &e);
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        *entries += 1;
        if *entries > MAX_ENTRIES {
            return Ok(false);
        }
        let is_folder = entry.file_type().map_err(failed)?.is_dir();
        if !is_folder {
            visit(&entry.path());
        } else if !SKIPPED_FOLDERS
            .iter()
            .any(|name| entry.file_name() == *name)
        {
            // All folders that are needed were read before.
            if depth == 0 || std::fs::read_dir(entry.path()).is_err() {
                visit(&entry.path());
            } else if !walk(&entry.path(), depth - 1, entries, visit)? {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// How many places of a stage are named: a file may have a hundred thousand.
const MOST_PLACES: usize = 20;

/// The first of these places, and how many others there are.
fn first_places(mut places: Vec<String>) -> Vec<String> {
    let more = places.len().saturating_sub(MOST_PLACES);
    if more > 0 {
        places.truncate(MOST_PLACES);
        places.push(format!("and {more} more places"));
    }
    places
}

/// Finds lines that may access files outside their module tree or start programs. A person should
/// check whether they are harmless.
fn reaches_out(stage: &str, files: &Files) -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in files {
        for (number, line) in (1..).zip(String::from_utf8_lossy(text).lines()) {
            let code: String = line.chars().filter(|c| !c.is_whitespace()).collect();
            let suspicious = ["std::env", "std::fs", "std::net", "std::os", "std::process"]
                .into_iter()
                .find(|word| code.contains(word));
            if let Some(word) = suspicious {
                let path = Untrusted::new(path.to_string_lossy()).line();
                found.push(format!("stages/{stage}/src/{path}:{number}: `{word}` may access files or start programs"));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source_file::MAX_FILE_SIZE;
    use files::file_tree;
    use std::path::PathBuf;

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

    /// Writes the files to a folder and reads it as a submission.
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
    fn a_project_and_its_stages_folder_are_the_same_submission() {
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

    /// Neither is told a sentence about the macros that its bytes look like.
    #[test]
    fn what_is_no_text_is_called_so() {
        let text = "macro_rules! m { ($n:ident) => { unsafe {} } }";
        let bytes: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let with_mark = [b"\xff\xfe", bytes.as_slice()].concat();
        for (bytes, forbidden) in [
            (with_mark, [""; 0].as_slice()),
            (b"unsafe {} // caf\xe9".to_vec(), &[]),
            // Text of zeros may be code for the compiler.
            (
                bytes,
                &[
                    "stages/intersect/src/lib.rs is UTF-16 text, which the compiler does not read (save it as UTF-8)",
                ],
            ),
        ] {
            let (_folder, submission) = read(&[("stages/intersect/src/lib.rs", &bytes)]);
            let submission = submission.unwrap();
            let found = submission.forbidden.get("intersect").cloned();
            assert_eq!(found.unwrap_or_default(), forbidden);
            assert!(submission.notes[0].contains("save it as UTF-8"));
        }
    }

    #[test]
    fn files_that_are_not_sources_are_listed_as_ignored() {
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
        assert_eq!(ignored, expected.map(Untrusted::from));
    }

    /// They are text from outside, read as data.
    #[test]
    fn examples_are_read_where_the_course_gives_points_for_them() {
        let files: [(&str, &[u8]); 2] = [
            ("stages/intersect/src/lib.rs", b""),
            ("stages/intersect/examples.toml", b"a = 1"),
        ];
        let (folder, without) = read(&files);
        let without = without.unwrap();
        assert!(without.examples.is_empty());
        assert_eq!(without.ignored.len(), 1);
        let course = COURSE.replace("holes =", "examples = 2\nholes =");
        let course = Course::parse(&course).unwrap();
        let with = Submission::read(folder.path(), &course, Path::new("/nowhere")).unwrap();
        assert_eq!(with.examples["intersect"], "a = 1");
        assert_eq!(with.ignored, [] as [Untrusted; 0]);
    }

    #[test]
    fn a_submission_with_very_many_files_is_read() {
        let (folder, few) = read(&[("stages/intersect/src/lib.rs", b"")]);
        let packages = folder.path().join("node_modules");
        std::fs::create_dir(&packages).unwrap();
        for i in 0..MAX_ENTRIES {
            std::fs::File::create(packages.join(i.to_string())).unwrap();
        }
        let many = reread(&folder).unwrap();
        assert_eq!(many.stages, few.unwrap().stages);
        assert_eq!(many.ignored, [] as [Untrusted; 0]);
        assert!(
            many.notes[0].starts_with("more than 50000 files"),
            "{:?}",
            many.notes
        );
    }

    #[test]
    fn unchanged_handout_files_are_not_listed_as_ignored() {
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
            [Untrusted::new(path.to_string_lossy())]
        );
    }

    #[test]
    fn code_that_accesses_files_is_reported() {
        let code = b"fn f() {}\nfn g() { std :: fs::read(\"x\"); }\n";
        let (_folder, submission) = read(&[("stages/intersect/src/lib.rs", code)]);
        let expected =
            ["stages/intersect/src/lib.rs:2: `std::fs` may access files or start programs"];
        assert_eq!(submission.unwrap().to_check, expected);
    }

    #[test]
    fn of_many_places_the_first_are_named() {
        let code = "use std::fs; unsafe {}\n".repeat(1000);
        let (_folder, submission) = read(&[("stages/intersect/src/lib.rs", code.as_bytes())]);
        let submission = submission.unwrap();
        for places in [&submission.to_check, &submission.forbidden["intersect"]] {
            assert_eq!(places.len(), MOST_PLACES + 1);
            assert_eq!(places[MOST_PLACES], "and 980 more places");
        }
    }

    #[test]
    fn folders_that_are_not_submissions_are_errors() {
        let lib = "stages/intersect/src/lib.rs";
        let large = vec![b' '; MAX_FILE_SIZE as usize + 1];
        for (files, why) in [
            (
                &[("README.md", b"x".as_slice())],
                "contains no stage: expected a folder stages/<stage>/src, where <stage> is intersect.",
            ),
            (&[(lib, large.as_slice())], "bytes: expected at most"),
        ] {
            let (_folder, submission) = read(files);
            let error = submission.unwrap_err();
            assert!(error.contains(why), "{error}");
        }
    }

    #[test]
    fn unusual_text_is_read_and_said() {
        let (_folder, submission) = read(&[
            ("stages/intersect/src/lib.rs", b"mod a;\r\nmod b;\r\n"),
            ("stages/intersect/src/a.rs", b"\xff\xfe"),
            ("stages/intersect/src/b.rs", b"\r\n"),
        ]);
        let submission = submission.unwrap();
        let files = &submission.stages["intersect"];
        assert_eq!(files[Path::new("lib.rs")], b"mod a;\nmod b;\n");
        let [first, second] = &submission.notes[..] else {
            panic!("{:?}", submission.notes);
        };
        assert!(first.starts_with("UTF-16 text"), "{first}");
        assert!(first.ends_with(": stages/intersect/src/a.rs"), "{first}");
        assert_eq!(
            second,
            "Windows line ends (CRLF), read as LF: stages/intersect/src/b.rs and 1 more"
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_name_cannot_write_a_line_of_the_report() {
        let (_folder, submission) = read(&[(
            "stages/intersect/src/a\nscore 80 of 80.rs",
            b"fn f() { std::fs::read(\"x\"); }\r\n",
        )]);
        let submission = submission.unwrap();
        let lines = submission.to_check.iter().chain(&submission.notes);
        for line in lines.clone() {
            assert!(line.contains("a\\nscore") && !line.contains('\n'), "{line}");
        }
        assert_eq!(lines.count(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_pipe_is_not_opened() {
        let (folder, _) = read(&[("stages/intersect/src/lib.rs", b"")]);
        let made = std::process::Command::new("mkfifo")
            .arg(folder.path().join("notes.txt"))
            .status();
        assert!(made.unwrap().success());
        assert_eq!(
            reread(&folder).unwrap().ignored,
            [Untrusted::from("notes.txt")]
        );
    }

    #[cfg(unix)]
    #[test]
    fn folders_inside_folders_are_read_to_a_depth() {
        let nest = |start: &Path, depth: usize| {
            std::fs::create_dir_all(start).unwrap();
            let mut shell = std::process::Command::new("sh");
            // Deeper than a path can name.
            let script = "i=0; while [ $i -lt $1 ]; do mkdir f && cd -P f || exit 1; i=$((i+1)); done; echo > deep.rs";
            let made = shell.args(["-c", script, "sh", &depth.to_string()]);
            assert!(made.current_dir(start).status().unwrap().success());
        };
        let (folder, _) = read(&[("stages/intersect/src/lib.rs", b"")]);
        let src = folder.path().join("stages/intersect/src");
        nest(&src.join("allowed"), MAX_DEPTH - 1);
        assert_eq!(reread(&folder).unwrap().stages["intersect"].len(), 2);
        nest(&folder.path().join("other"), 1_900);
        let ignored = reread(&folder).unwrap().ignored;
        assert!(ignored[0].raw().starts_with("other/f/f") && ignored.len() == 1);
        let long = src
            .join("long")
            .join(["d".repeat(200), "e".repeat(200)].join("/"));
        file_tree::write(&long.join(format!("{}.rs", "f".repeat(102))), b"").unwrap();
        assert_eq!(reread(&folder).unwrap().stages["intersect"].len(), 3);
        file_tree::write(&long.join(format!("{}.rs", "f".repeat(103))), b"").unwrap();
        let error = reread(&folder).unwrap_err();
        assert!(error.contains("a path of more than 512 bytes"), "{error}");
        std::fs::remove_dir_all(src.join("long")).unwrap();
        nest(&src.join("refused"), MAX_DEPTH);
        let error = reread(&folder).unwrap_err();
        assert!(
            error.contains("more than 64 deep: too deep for a stage"),
            "{error}"
        );
    }

    /// Uses a link that points to itself: not even the superuser can read it.
    #[cfg(unix)]
    #[test]
    fn unreadable_folders_do_not_count_as_missing() {
        let folder = tempfile::tempdir().unwrap();
        let stages = folder.path().join("stages");
        std::os::unix::fs::symlink(&stages, &stages).unwrap();
        let error = reread(&folder).unwrap_err();
        assert!(error.contains("cannot read"), "{error}");
        assert!(error.contains("stages"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn folders_without_read_permission_are_errors_only_if_needed() {
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
            [Untrusted::from("notes/private")]
        );
        forbid("stages/intersect", 0);
        assert!(reread(&folder).unwrap_err().contains("cannot read"));
        for name in ["stages/intersect", "notes/private"] {
            forbid(name, 0o700);
        }
    }

    #[cfg(unix)]
    #[test]
    fn only_links_out_of_the_submission_are_errors() {
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
