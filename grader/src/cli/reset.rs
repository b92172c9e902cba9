//! The command `grader reset part1.task3`: puts the gaps of a task back.

use super::picture::{task_argument, task_of};
use crate::course::sources::{self, SourceFile};
use crate::course::{Course, Task};
use base::program::Exit;
use base::{GraderError, Workspace, child_processes, outln, write_whole};
use clap::{ArgMatches, Command};
use std::path::{Path, PathBuf};

/// The name of the command.
pub(super) const NAME: &str = "reset";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Puts the gaps of a task back, from the first commit; your text is kept beside the file")
        .arg(task_argument().required(true))
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let task = task_of(matches, &workspace, &course)?;
    let root = workspace.root();
    let first = first_commit(root)?;
    let files = sources::read(root, &task.stage)?;
    let mut changed = 0;
    for file in files.iter().filter(|file| has_functions(task, file)) {
        let original = git(root, &["show", &format!("{first}:./{}", file.path)])?;
        if original == file.text || !sources::has_hole(&original, &task.key) {
            continue;
        }
        let kept = unused_beside(&root.join(&file.path));
        write_whole(&kept, file.text.as_bytes())?;
        write_whole(&root.join(&file.path), original.as_bytes())?;
        changed += 1;
        outln!(
            "{} is as it was at first. Your text is kept: {}",
            file.path,
            kept.strip_prefix(root).unwrap_or(&kept).display()
        );
    }
    if changed == 0 {
        outln!("{} is as it was at first: nothing is changed.", task.key);
    }
    Ok(Exit::Passed)
}

/// Whether a file has a function of the task.
fn has_functions(task: &Task, file: &SourceFile) -> bool {
    let mut functions = task.holes.iter();
    functions.any(|name| sources::defines_function(&file.text, name))
}

/// The first commit of the repository that `root` is in: the folder as it was received.
fn first_commit(root: &Path) -> Result<String, GraderError> {
    let commits = git(root, &["rev-list", "--max-parents=0", "HEAD"])?;
    let last = commits.lines().last().map(str::to_owned);
    last.ok_or_else(|| GraderError::new("the repository of this folder has no commit"))
}

/// What git prints.
fn git(root: &Path, arguments: &[&str]) -> Result<String, GraderError> {
    let mut command = std::process::Command::new("git");
    let output = child_processes::output(command.current_dir(root).args(arguments));
    let failed = |why: &str| {
        GraderError::new(format!(
            "the gaps are taken from the first commit of this folder, and git finds none: {why}. Copy the file from the \
             handout that you received"
        ))
    };
    let output = output.map_err(|e| failed(&e.to_string()))?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(failed(String::from_utf8_lossy(&output.stderr).trim())),
    }
}

/// A path beside `file` that nothing has yet, and that cargo does not compile.
fn unused_beside(file: &Path) -> PathBuf {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let names = (1..).map(|number| format!("{name}.kept{number}"));
    let mut paths = names.map(|name| file.with_file_name(name));
    paths
        .find(|path| !path.exists())
        .unwrap_or_else(|| file.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_was_kept_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.rs");
        let first = unused_beside(&file);
        assert_eq!(first, folder.path().join("a.rs.kept1"));
        std::fs::write(&first, "").unwrap();
        assert_eq!(unused_beside(&file), folder.path().join("a.rs.kept2"));
    }

    #[test]
    fn without_a_repository_the_error_says_where_the_gaps_are() {
        let folder = tempfile::tempdir().unwrap();
        let error = first_commit(folder.path()).unwrap_err().to_string();
        assert!(
            error.contains("from the handout that you received"),
            "{error}"
        );
    }
}
