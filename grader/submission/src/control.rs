//! A control: the course's own stage, built and run as a submission is. If this fails, the machine
//! failed, so what went wrong with a submission is no score.

use crate::clean_workspace::CleanWorkspace;
use base::{GraderError, Workspace};
use files::file_tree::Files;
use grader::build::compile_errors;
use grader::course::{Course, Task, sources};
use grader::grade::{self, Graded};
use grader::score::Status;
use std::path::Path;

/// Grades a submission: `grade` does so, and `may_be_the_machine` says of its result whether the
/// machine may be the cause of lost points. Then `control` has to succeed, and what `grade` returns
/// after it counts: a disk may have been full, or the memory taken, for a moment.
pub(crate) fn unless_the_machine_failed<T>(
    mut grade: impl FnMut() -> Result<T, GraderError>,
    may_be_the_machine: impl Fn(&T) -> bool,
    control: impl FnOnce() -> Result<(), GraderError>,
) -> Result<T, GraderError> {
    let first = grade()?;
    if !may_be_the_machine(&first) {
        return Ok(first);
    }
    // Its files would take the space of others.
    drop(first);
    control()?;
    grade()
}

/// Builds the course's own stage of `tasks`, all of one stage, and grades it with `seed`. Returns an
/// error that says what failed, if anything did.
pub(crate) fn grade(
    workspace: &Workspace,
    clean: &CleanWorkspace,
    course: &Course,
    tasks: &[&Task],
    seed: u64,
) -> Result<(), GraderError> {
    let Some(stage) = tasks.first().map(|task| task.stage.as_str()) else {
        return Ok(());
    };
    let files = reference(clean.trusted(), stage)?;
    let folder = clean.with_stages(&[(stage, &files)], None)?;
    let graded = grade::at(workspace, course, tasks, seed, &folder.build_root(), false)?;
    match failure(&graded) {
        None => Ok(()),
        Some(why) => Err(GraderError::new(format!(
            "this machine cannot grade: the course's own stage `{stage}`, built and run as a submission is, {}. Nothing was scored. `cargo grader doctor` says what is missing",
            folder.for_report(&why)
        ))),
    }
}

/// The files of `stage` in the course below `root`.
fn reference(root: &Path, stage: &str) -> Result<Files, GraderError> {
    let folder = root.join("stages").join(stage).join("src");
    let read = |path: &Path| {
        let bytes = std::fs::read(path).map_err(|e| GraderError::file("read", path, e))?;
        let below = path.strip_prefix(&folder).unwrap_or(path);
        Ok((below.to_path_buf(), bytes))
    };
    let paths = sources::paths(root, stage)?;
    paths.iter().map(|path| read(path)).collect()
}

/// Longer lines of the compiler's are left out, in bytes.
const MOST_OF_LINE: usize = 200;

/// What went wrong with code that is right, to end the sentence "the course's own stage ...". The
/// tasks of a handout are not written.
fn failure(graded: &Graded) -> Option<String> {
    if !graded.compiler.is_empty() {
        let (first, _) = compile_errors::first(&graded.compiler);
        // The command of a linker has thousands of letters.
        let short = first.lines().filter(|line| line.len() <= MOST_OF_LINE);
        let lines: Vec<&str> = short.collect();
        return Some(format!("does not compile ({})", lines.join("\n").trim()));
    }
    let mut results = graded.report.tasks.iter().map(|task| &task.result);
    let is_open = |status: &Status| matches!(status, Status::NotAttempted | Status::Needs(_));
    let worst = results.find(|task| task.score < task.max_score && !is_open(&task.status));
    let lost = worst.map(|task| {
        let mut crashed = task.cases.iter().filter_map(|case| match &case.status {
            Status::Crashed(how) => Some(format!("{}: {how}", case.name)),
            _ => None,
        });
        let (key, score, max_score) = (&task.key, task.score, task.max_score);
        let how = crashed.next().unwrap_or_else(|| "wrong answers".into());
        format!("gets {score} of {max_score} points in {key} ({how})")
    });
    let is_cut = graded.may_be_the_machine;
    lost.or_else(|| is_cut.then(|| "was ended by the system".to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SubmissionReport;
    use crate::one::Options;
    use crate::read::Submission;
    use files::file_tree;
    use grader::grade::GradeRequest;
    use std::cell::Cell;

    /// What counts, and how often the submission was graded and the control run, if the results of
    /// grading are these: `true` may be the machine's.
    fn graded(
        results: &[bool],
        control: Result<(), &str>,
    ) -> (Result<usize, String>, usize, usize) {
        let (grades, controls) = (Cell::new(0), Cell::new(0));
        let counts = unless_the_machine_failed(
            || {
                grades.set(grades.get() + 1);
                Ok(grades.get() - 1)
            },
            |number| results[*number],
            || {
                controls.set(controls.get() + 1);
                control.map_err(GraderError::new)
            },
        );
        let counts = counts.map_err(|why| why.to_string());
        (counts, grades.get(), controls.get())
    }

    #[test]
    fn what_the_machine_may_have_caused_counts_only_after_a_control() {
        assert_eq!(graded(&[false], Ok(())), (Ok(0), 1, 0));
        assert_eq!(graded(&[true, true], Ok(())), (Ok(1), 2, 1));
        // It was the machine's, and is over.
        assert_eq!(graded(&[true, false], Ok(())), (Ok(1), 2, 1));
        let no_linker = "linker `cc` not found";
        let failed = (Err(no_linker.to_string()), 1, 1);
        assert_eq!(graded(&[true], Err(no_linker)), failed);
    }

    /// A cargo without a linker: no crate has an error, and the worker is not linked.
    #[cfg(unix)]
    const NO_LINKER: &str = r#"#!/bin/sh
while [ "$1" != --target-dir ]; do shift; done
for name in raygen worker; do : > "$2/release/deps/$name-0.d"; done
printf '%s\n' '{"reason":"compiler-message","target":{"name":"worker"},"message":{"level":"error","message":"linker `cc` not found","rendered":"error: linker `cc` not found\n","spans":[],"code":null}}'
exit 101
"#;

    #[cfg(unix)]
    #[test]
    fn a_missing_linker_is_no_score() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a folder");
        let inside = |name: &str| folder.path().join(name);
        file_tree::write(&inside("course/stages/raygen/src/lib.rs"), b"").expect("a file");
        file_tree::write(&inside("home/config.toml"), b"").expect("a file");
        for name in ["release/.fingerprint", "release/build", "release/deps"] {
            std::fs::create_dir_all(inside("target").join(name)).expect("a folder");
        }
        file_tree::write(&inside("cargo"), NO_LINKER.as_bytes()).expect("a file");
        let executable = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(inside("cargo"), executable).expect("a file");
        let clean = CleanWorkspace::with_cargo(folder.path(), &inside("cargo"));
        let workspace = Workspace::above(Path::new(env!("CARGO_MANIFEST_DIR"))).expect("a course");
        let files = Files::from([("lib.rs".into(), b"pub fn f() {}\n".to_vec())]);
        let submission = Submission {
            stages: [("raygen".to_string(), files)].into(),
            ..Submission::default()
        };
        let options = Options {
            request: GradeRequest {
                what: "part1.task1".into(),
                seed: 7,
            },
            together: false,
            pictures: false,
        };
        let report = SubmissionReport::of(&submission, &workspace, &clean, &options);
        let why = report.expect_err("nothing can be linked").to_string();
        for words in [
            "this machine cannot grade",
            "`raygen`",
            "linker `cc` not found",
        ] {
            assert!(why.contains(words), "{words}: {why}");
        }
    }
}
