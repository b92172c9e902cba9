//! Blessing: stores the reference's current answers as goldens, after showing what changes.
//!
//! [`propose`] runs the selected cases and collects a [`Change`] for each golden that would change,
//! in memory: until [`accept`] writes them, no file is touched. Every new answer is judged whole
//! ([`judge::whole`]): if one is wrong in any aspect, nothing is blessed. What is not judged is
//! printed with each change. The goldens' own test collects its differences with the same
//! [`Proposal`].

mod meaning;
mod not_judged_list;
mod proposal;
mod provenance;
mod selection;
#[cfg(test)]
mod tests;

pub use proposal::{Change, ChangeKind, Proposal, SNAPSHOT_HEADER};
pub use selection::{Selected, select};

use base::{GraderError, Workspace, write_whole};
use grader::build::BuildRoot;
use grader::course::{Course, Task};
use grader::grade;
use grader::grade::picture;
use grader::report::table::status_text;
use judge::cases::Spec;
use judge::pictures;
use std::path::Path;

/// Runs the cases that `keys` select (`all`, a part, a task, a case) and returns what would change.
///
/// # Errors
///
/// If a key selects nothing, a stage does not compile, a case has no answer, or the workspace is a
/// handout.
pub fn propose(workspace: &Workspace, keys: &[&str]) -> Result<Proposal, GraderError> {
    let course = Course::read(workspace)?;
    let selected = select(&course, keys)?;
    workspace.ensure_full("goldens are blessed from the reference, which is not in it")?;
    let tasks: Vec<&Task> = selected.iter().map(|selected| selected.task).collect();
    let specs = grade::specs(&tasks, 0)?;
    let workers = grade::workers(&BuildRoot::of(workspace), &tasks, &specs, false)?;
    let mut proposal = Proposal::default();
    for selected in &selected {
        let task = selected.task;
        let Some(of_stage) = workers.workers(&task.stage) else {
            return Err(GraderError::new(format!(
                "nothing is blessed, because `{}` does not compile: the compiler's messages are above",
                task.stage
            )));
        };
        let chosen: Vec<&Spec> = grade::chosen(&[task], &specs)?
            .into_iter()
            .filter(|spec| selected.has_case(spec.name))
            .collect();
        let endings = of_stage.run(&chosen, &mut Vec::new())?;
        let mut judged = Vec::new();
        for (spec, ending) in chosen.iter().zip(&endings) {
            match grade::answered(&task.key, ending, &course)? {
                Ok(answer) => judged.push(proposal.add_case(workspace, spec, answer)?),
                Err(status) => proposal.refuse(spec.task, spec.name, &status_text(&status)),
            }
        }
        proposal.add_not_judged(workspace, task, &specs, &judged)?;
        if selected.picture
            && let Some(kind) = pictures::of(&task.key)
        {
            match picture::of_code(&course, task, &kind, &workers)? {
                Ok(image) => proposal.add_picture(workspace, &kind, &image)?,
                Err(status) => proposal.refuse(&task.key, pictures::NAME, &status_text(&status)),
            }
        }
    }
    Ok(proposal)
}

/// Stores the changes as goldens, and records where they come from.
pub fn accept(workspace: &Workspace, changes: &[Change]) -> Result<(), GraderError> {
    for change in changes {
        if let Some(folder) = change.golden.parent() {
            std::fs::create_dir_all(folder).map_err(|e| GraderError::file("create", folder, e))?;
        }
        write_whole(&change.golden, &change.content)?;
        // What the goldens' test left beside it is older than the golden now.
        let pending = change.pending();
        if pending.is_file() {
            std::fs::remove_file(&pending).map_err(|e| GraderError::file("remove", &pending, e))?;
        }
    }
    write_whole(
        &workspace.root().join("golden/provenance.toml"),
        provenance::text(workspace)?.as_bytes(),
    )
}

fn read(path: &Path) -> Result<String, GraderError> {
    std::fs::read_to_string(path).map_err(|e| GraderError::file("read", path, e))
}
