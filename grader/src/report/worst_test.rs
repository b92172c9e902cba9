//! Writes the test of a task's worst answer to a file, and says how to run it.

use super::{Report, TaskReport};
use crate::course::sources::with_slashes;
use base::write_whole;
use base::{GraderError, Workspace};
use std::path::PathBuf;

/// Writes the tests of `report` to `target/first-light/TASK.rs` and notes the files in it. Removes
/// the file of a task that has no wrong answer any more.
pub fn write_all(workspace: &Workspace, report: &mut Report) -> Result<(), GraderError> {
    for task in &mut report.tasks {
        let path = path(workspace, &task.result.key);
        match &task.worst_as_test {
            Some(test) => {
                workspace.create_outputs()?;
                write_whole(&path, test.as_bytes())?;
                let inside = path.strip_prefix(workspace.root()).unwrap_or(&path);
                task.test_file = Some(inside.to_path_buf());
            }
            None if path.exists() => {
                std::fs::remove_file(&path).map_err(|e| GraderError::file("remove", &path, e))?
            }
            None => {}
        }
    }
    Ok(())
}

/// Where the test of the task `key` is written.
fn path(workspace: &Workspace, key: &str) -> PathBuf {
    let name = key.replace('.', "_");
    workspace.outputs().join(format!("{name}.rs"))
}

/// The commands that run the test of `task`, if it has one, in lines that can be pasted into a
/// shell together. Each stage has the folder for it.
pub(super) fn commands(task: &TaskReport) -> Option<[String; 2]> {
    let file = task.test_file.as_ref()?;
    let (name, stage) = (file.file_stem()?.display(), &task.result.stage);
    Some([
        format!("cp {} stages/{stage}/tests &&", with_slashes(file)),
        format!("cargo test -p {stage} --test {name}"),
    ])
}
