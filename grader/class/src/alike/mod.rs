//! Finds code that submissions have in common, right or wrong: `grader class DIR --out OUT --alike`.
//! This is a question for the instructor, never a verdict.
//!
//! [`tokens`] reads code without comments, blanks and names, [`passages`] finds equal runs,
//! [`source`] is the code of a stage, [`pairs`] compares a class, [`page`] shows the passages side
//! by side, [`jplag`] writes the class as the program JPlag wants it.

pub mod jplag;
pub mod page;
pub mod pairs;
pub mod passages;
pub mod source;
pub mod tokens;

use base::{GraderError, Workspace};
use grader::course::sources;
use passages::Known;
use std::path::{Path, PathBuf};
use submission::file_tree::{self, Files};

/// What all students of a stage have or may have: the text around its solutions, and the correct
/// variants that the course knows.
pub fn known(workspace: &Workspace, stage: &str) -> Result<Known, GraderError> {
    let mut known = Known::default();
    for text in given(workspace, stage)?
        .values()
        .chain(&variants(workspace, stage)?)
    {
        let text = String::from_utf8_lossy(text);
        known.add(&tokens::of(&text).unwrap_or_default());
    }
    Ok(known)
}

/// The files of a stage without its solutions, by their paths below `src/`.
pub fn given(workspace: &Workspace, stage: &str) -> Result<Files, GraderError> {
    let folder = workspace.root().join("stages").join(stage).join("src");
    let files = sources::paths(workspace.root(), stage)?.into_iter();
    let files = files.map(|path| {
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        let below: PathBuf = path.strip_prefix(&folder).unwrap_or(&path).into();
        Ok((below, without_solutions(&text).into_bytes()))
    });
    files.collect()
}

/// The folders with code that could be pasted into a stage: what judges, and the exact arithmetic.
const GRADERS: [&str; 3] = ["grader/judge/src", "grader/oracle/src", "grader/review/src"];

/// The code of the grader, as a handout has it.
pub fn of_the_grader(workspace: &Workspace) -> Result<Files, GraderError> {
    let root = workspace.root();
    let is_judge = |path: &PathBuf| {
        GRADERS.iter().any(|folder| path.starts_with(folder))
            && path.extension().is_some_and(|e| e == "rs")
    };
    let paths = file_tree::workspace_paths(root)?
        .into_iter()
        .filter(is_judge);
    let files = paths.map(|path| {
        let text = file_tree::read(root, &path)?;
        let text = without_solutions(&String::from_utf8_lossy(&text));
        Ok((path, text.into_bytes()))
    });
    files.collect()
}

/// The texts of the known correct variants of a stage.
fn variants(workspace: &Workspace, stage: &str) -> Result<Vec<Vec<u8>>, GraderError> {
    let folder = workspace.root().join("grader/mutants/variants").join(stage);
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let failed = |path: &Path, e| GraderError::file("read", path, e);
    let entries = std::fs::read_dir(&folder).map_err(|e| failed(&folder, e))?;
    let texts = entries.map(|entry| {
        let path = entry.map_err(|e| failed(&folder, e))?.path();
        std::fs::read(&path).map_err(|e| failed(&path, e))
    });
    texts.collect()
}

/// `text` without the lines from each `BEGIN SOLUTION` to its `END SOLUTION`, and with the code of
/// the stubs there.
fn without_solutions(text: &str) -> String {
    let mut is_solution = false;
    let mut kept = String::with_capacity(text.len());
    for line in text.lines() {
        let comment = line.trim_start().strip_prefix("//").map(str::trim_start);
        let starts = |marker: &str| comment.is_some_and(|comment| comment.starts_with(marker));
        if starts("BEGIN SOLUTION(") {
            is_solution = true;
        } else if starts("END SOLUTION(") {
            is_solution = false;
        } else if let Some(stub) = comment.and_then(|comment| comment.strip_prefix("STUB:")) {
            kept.extend([stub, "\n"]);
        } else if !is_solution {
            kept.extend([line, "\n"]);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_are_cut_and_stubs_kept() {
        let text = "a\n  // BEGIN SOLUTION(k)\n  b\n  // STUB: c\n  // END SOLUTION(k)\nd\n";
        assert_eq!(without_solutions(text), "a\n c\nd\n");
    }
}
