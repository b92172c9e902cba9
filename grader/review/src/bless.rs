//! Blessing: stores the reference's current answers as goldens, after showing what changes.
//!
//! The goldens' own test writes the new files beside the old ones (`.snap.new`, `.new.png`,
//! `not_judged.txt.new`), with the same writer that checks them; blessing compares the pairs, and
//! renames. The test judges every new answer whole (`judge::whole`): if one is wrong in any aspect,
//! nothing is blessed. What is not judged is printed with each change.

use grader::child_processes;
use grader::compile;
use grader::course::{Course, Task};
use grader::error::GraderError;
use grader::report::write_whole;
use grader::workspace::Workspace;
use judge::snapshot::{Snapshot, changes, parse};
use pages::picture::read_png;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A golden that would change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The golden.
    pub golden: PathBuf,
    /// The new file next to it, which would replace it.
    pub new: PathBuf,
    /// A description of the change.
    pub meaning: String,
    /// The aspects of the new answers that the oracle does not judge, with the reasons.
    pub not_judged: Vec<String>,
}

/// Runs the goldens' test for `key` (`all`, a part, a task) and lists what would change.
pub fn propose(workspace: &Workspace, key: &str) -> Result<Vec<Change>, GraderError> {
    let course = Course::read(workspace)?;
    let tasks = course.select(key)?;
    workspace.ensure_full("goldens are blessed from the reference, which is not in it")?;
    // What an earlier run left, `cargo test` or one that was interrupted, is of another reference.
    for (_, stale) in new_files(workspace, &tasks)? {
        remove(&stale)?;
    }
    let mut cargo = Command::new(compile::cargo());
    cargo
        .current_dir(workspace.root())
        .args([
            "test",
            "--release",
            "--package",
            "golden",
            "--test",
            "goldens",
        ])
        // Cargo shows the progress of its build, because the first one takes minutes. The test
        // itself prints little.
        .args(["--", "--quiet"])
        .env("INSTA_UPDATE", "new")
        .env("INSTA_OUTPUT", "none")
        .env("INSTA_FORCE_PASS", "1")
        .env("FIRSTLIGHT_BLESS", key)
        .stdin(Stdio::null())
        .stdout(Stdio::piped());
    let failed = |e| GraderError::new(format!("cannot run cargo: {e}"));
    let (child, _running) = child_processes::start(&mut cargo).map_err(failed)?;
    let output = child.wait_with_output().map_err(failed)?;
    if !output.status.success() {
        return Err(GraderError::new(nothing_blessed(&String::from_utf8_lossy(
            &output.stdout,
        ))));
    }
    new_files(workspace, &tasks)?
        .into_iter()
        .map(|(golden, new)| {
            Ok(Change {
                meaning: meaning(&golden, &new)?,
                not_judged: not_judged(&golden)?,
                golden,
                new,
            })
        })
        .collect()
}

/// The message when cargo fails. `printed` is the output of the test; it is empty if the test was
/// not built.
fn nothing_blessed(printed: &str) -> String {
    match printed.trim() {
        "" => {
            "nothing is blessed, because the goldens' test could not be built: see cargo's errors above"
                .into()
        }
        printed => format!("nothing is blessed, because the goldens' test failed:\n{printed}"),
    }
}

/// Stores the changes as goldens, and records where they come from.
pub fn accept(workspace: &Workspace, proposed: &[Change]) -> Result<(), GraderError> {
    for change in proposed {
        if change
            .golden
            .extension()
            .is_some_and(|extension| extension == "snap")
        {
            let text = read(&change.new)?;
            // The line of the assertion is noise in a review.
            let kept: Vec<&str> = text
                .lines()
                .filter(|line| !line.starts_with("assertion_line:"))
                .collect();
            write_whole(&change.golden, (kept.join("\n") + "\n").as_bytes())?;
            remove(&change.new)?;
        } else {
            std::fs::rename(&change.new, &change.golden)
                .map_err(|e| GraderError::file("write", &change.golden, e))?;
        }
    }
    write_whole(
        &workspace.root().join("golden/provenance.toml"),
        provenance(workspace)?.as_bytes(),
    )
}

/// Removes the new files.
pub fn reject(proposed: &[Change]) -> Result<(), GraderError> {
    proposed.iter().try_for_each(|change| remove(&change.new))
}

fn remove(path: &Path) -> Result<(), GraderError> {
    std::fs::remove_file(path).map_err(|e| GraderError::file("remove", path, e))
}

fn read(path: &Path) -> Result<String, GraderError> {
    std::fs::read_to_string(path).map_err(|e| GraderError::file("read", path, e))
}

/// Pairs of a golden of `tasks` and the new file beside it.
fn new_files(
    workspace: &Workspace,
    tasks: &[&Task],
) -> Result<Vec<(PathBuf, PathBuf)>, GraderError> {
    let mut found = Vec::new();
    for task in tasks {
        let folder = workspace.root().join("golden").join(&task.key);
        // A task whose goldens are all new has no folder yet.
        if !folder.is_dir() {
            continue;
        }
        let failed = |e| GraderError::file("read", &folder, e);
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            let name = path.display().to_string();
            if let Some(golden) = name.strip_suffix(".new") {
                found.push((PathBuf::from(golden), path));
            } else if let Some(stem) = name.strip_suffix(".new.png") {
                found.push((PathBuf::from(format!("{stem}.png")), path));
            }
        }
    }
    found.sort();
    Ok(found)
}

fn meaning(golden: &Path, new: &Path) -> Result<String, GraderError> {
    if !golden.exists() {
        return Ok("is new".into());
    }
    if golden
        .extension()
        .is_some_and(|extension| extension == "png")
    {
        return pixels(golden, new);
    }
    if golden
        .extension()
        .is_some_and(|extension| extension == "txt")
    {
        return Ok(changed_lines(&read(golden)?, &read(new)?));
    }
    Ok(changes(&snapshot(golden)?, &snapshot(new)?).to_string())
}

/// The lines that were removed and those that were added.
fn changed_lines(old: &str, new: &str) -> String {
    let only_in = |a: &str, b: &str, sign: char| {
        let lines = a
            .lines()
            .filter(|line| !b.lines().any(|other| other == *line));
        lines
            .map(|line| format!("\n  {sign} {line}"))
            .collect::<String>()
    };
    format!(
        "what the exact oracle does not judge{}{}",
        only_in(old, new, '-'),
        only_in(new, old, '+')
    )
}

/// What the oracle does not judge in the new answers of the case of a golden: the lines about it in
/// the list beside the golden, or in the new one.
fn not_judged(golden: &Path) -> Result<Vec<String>, GraderError> {
    let list = golden.with_file_name("not_judged.txt");
    let new = list.with_extension("txt.new");
    let case = golden.file_stem().unwrap_or_default().display().to_string();
    let list = match [new, list].into_iter().find(|list| list.is_file()) {
        Some(list) => read(&list)?,
        None => String::new(),
    };
    let about_it = list.lines().filter_map(|line| {
        let (name, sentence) = line.split_once(": ")?;
        (name == case).then(|| sentence.to_string())
    });
    Ok(about_it.collect())
}

/// Reads the golden snapshot of a case.
pub(crate) fn golden_snapshot(
    workspace: &Workspace,
    task: &str,
    case: &str,
) -> Result<Snapshot, GraderError> {
    let path = workspace.snapshot(task, case);
    let text = workspace.read_snapshot(task, case)?;
    let text = text.ok_or_else(|| GraderError::file("read", &path, "it does not exist"))?;
    parse(&text).map_err(|e| GraderError::file("understand", &path, e))
}

/// Reads the snapshot `path`.
fn snapshot(path: &Path) -> Result<Snapshot, GraderError> {
    parse(&read(path)?).map_err(|e| GraderError::file("understand", path, e))
}

fn pixels(golden: &Path, new: &Path) -> Result<String, GraderError> {
    let (old, new) = (read_png(golden)?, read_png(new)?);
    if old.size() != new.size() {
        return Ok(format!("size {:?} became {:?}", old.size(), new.size()));
    }
    let differing = old
        .pixels()
        .iter()
        .zip(new.pixels())
        .filter(|(a, b)| a != b)
        .count();
    Ok(format!("{differing} of {} pixels", old.pixels().len()))
}

/// Where the goldens come from.
fn provenance(workspace: &Workspace) -> Result<String, GraderError> {
    let rustc = Command::new("rustc").arg("--version").output();
    let rustc = rustc
        .map(|output| String::from_utf8_lossy(&output.stdout).trim().to_string())
        .unwrap_or_default();
    let mut text = String::from("# Written by `grader bless`: what the goldens were made with.\n");
    let _ = writeln!(text, "toolchain = {rustc:?}");
    let _ = writeln!(
        text,
        "target = \"{}-{}\"",
        std::env::consts::ARCH,
        std::env::consts::OS
    );
    let _ = writeln!(
        text,
        "flags = {:?}",
        std::env::var("RUSTFLAGS").unwrap_or_default()
    );
    let _ = writeln!(
        text,
        "seed = 0\noracle = \"every golden is judged in all aspects at the robust bounds, except for what not_judged.txt lists\"\n\n[scenes]"
    );
    let folder = workspace.root().join("scenes/dae");
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(|e| GraderError::file("read", &folder, e))? {
        scenes.push(
            entry
                .map_err(|e| GraderError::file("read", &folder, e))?
                .path(),
        );
    }
    scenes.sort();
    for path in scenes {
        let name = path.file_name().unwrap_or_default().display().to_string();
        let _ = writeln!(text, "{name:?} = \"{:016x}\"", fnv(read(&path)?.as_bytes()));
    }
    Ok(text)
}

/// FNV-1a hash. It only detects that a scene file is not the one that was used; it is not
/// cryptographic.
fn fnv(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const COURSE: &str = r#"
conventions = []
[[part]]
number = 1
title = "One"
[[part.task]]
key = "part1.task1"
title = "Mine"
stage = "bbox"
holes = []
cases = [{ name = "a", tier = "core", points = 1 }]
[[part.task]]
key = "part1.task2"
title = "Another"
stage = "bbox"
holes = []
cases = [{ name = "a", tier = "core", points = 1 }]
"#;

    #[test]
    fn what_waits_for_another_task_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        for (path, text) in [
            ("stages/course.toml", COURSE),
            ("stages/bbox/src/lib.rs", ""),
            ("golden/part1.task1/a.snap.new", ""),
            ("golden/part1.task1/a.new.png", ""),
            ("golden/part1.task1/a.snap", ""),
            ("golden/part1.task2/a.snap.new", ""),
        ] {
            submission::file_tree::write(&root.join(path), text.as_bytes()).unwrap();
        }
        let workspace = Workspace::above(root).unwrap();
        let course = Course::read(&workspace).unwrap();
        let found = new_files(&workspace, &course.select("part1.task1").unwrap()).unwrap();
        let goldens: Vec<&Path> = found.iter().map(|(golden, _)| golden.as_path()).collect();
        let folder = workspace.root().join("golden/part1.task1");
        assert_eq!(goldens, [folder.join("a.png"), folder.join("a.snap")]);
    }

    #[test]
    fn what_is_not_judged_is_told_with_each_change_of_its_case() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        let list = "a: normal, in 3 calls: the normals cancel\nab: work: no record\n";
        for (path, text) in [
            ("golden/part1.task1/not_judged.txt", list),
            ("golden/part1.task2/not_judged.txt", list),
            ("golden/part1.task2/not_judged.txt.new", "a: t: new\n"),
        ] {
            submission::file_tree::write(&root.join(path), text.as_bytes()).unwrap();
        }
        let of = |golden: &str| not_judged(&root.join("golden").join(golden)).unwrap();
        assert_eq!(
            of("part1.task1/a.snap"),
            ["normal, in 3 calls: the normals cancel"]
        );
        assert_eq!(of("part1.task1/ab.png"), ["work: no record"]);
        assert_eq!(of("part1.task2/a.snap"), ["t: new"]);
        assert_eq!(of("part1.task3/a.snap"), Vec::<String>::new());
        let lists = [
            ("part1.task2/not_judged.txt"),
            ("part1.task2/not_judged.txt.new"),
        ];
        let [golden, new] = lists.map(|path| root.join("golden").join(path));
        assert_eq!(
            meaning(&golden, &new).unwrap(),
            "what the exact oracle does not judge\
             \n  - a: normal, in 3 calls: the normals cancel\n  - ab: work: no record\n  + a: t: new"
        );
    }

    #[test]
    fn blessing_in_a_handout_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        for (path, text) in [
            ("stages/course.toml", COURSE),
            ("stages/bbox/src/lib.rs", ""),
        ] {
            submission::file_tree::write(&folder.path().join(path), text.as_bytes()).unwrap();
        }
        let workspace = Workspace::above(folder.path()).unwrap();
        let error = propose(&workspace, "all").unwrap_err().to_string();
        assert!(error.contains("is a handout"), "{error}");
    }

    #[test]
    fn empty_output_means_that_the_test_was_not_built() {
        assert!(nothing_blessed(" \n").contains("see cargo's errors above"));
        assert!(nothing_blessed("a panicked\n").ends_with("failed:\na panicked"));
    }

    #[test]
    fn a_task_without_a_stage_is_refused_with_the_stages_name() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("stages/course.toml");
        submission::file_tree::write(&file, COURSE.as_bytes()).unwrap();
        let workspace = Workspace::above(folder.path()).unwrap();
        let error = Course::read(&workspace).unwrap_err().to_string();
        assert!(error.contains("there is no stages/bbox"), "{error}");
    }
}
