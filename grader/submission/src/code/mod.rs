//! Source code as it is compared: what two texts have in common, whatever the names in them are.
//!
//! [`tokens`] reads code without comments, blanks and names, [`passages`] finds equal runs,
//! [`source`] is the code of a stage.

pub mod passages;
pub mod source;
pub mod tokens;

use base::GraderError;
use files::file_tree::Files;
use grader::course::sources;
use passages::Known;
use std::path::{Path, PathBuf};

/// What all students of a stage have or may have: the text around its solutions, and the correct
/// variants that the course knows.
pub fn known(root: &Path, stage: &str) -> Result<Known, GraderError> {
    let mut known = Known::default();
    for text in given(root, stage)?.values() {
        known.add_text(text);
    }
    for text in variants(root, stage)? {
        known.add_text(&text);
    }
    Ok(known)
}

/// The files of a stage without its solutions, by their paths below `src/`.
pub fn given(root: &Path, stage: &str) -> Result<Files, GraderError> {
    let folder = root.join("stages").join(stage).join("src");
    let files = sources::paths(root, stage)?.into_iter().map(|path| {
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        let below: PathBuf = path.strip_prefix(&folder).unwrap_or(&path).into();
        Ok((below, without_solutions(&text).into_bytes()))
    });
    files.collect()
}

/// The folders with code that could be pasted into a stage: what judges, and the exact arithmetic.
const GRADERS: [&str; 3] = ["grader/judge/src", "grader/oracle/src", "grader/look/src"];

/// The code of the grader below `root`, as a handout has it.
pub fn of_the_grader(root: &Path) -> Result<Files, GraderError> {
    let mut files = Files::new();
    for folder in GRADERS.map(|folder| root.join(folder)) {
        for path in sources::below(&folder)? {
            let text =
                std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
            let name = path.strip_prefix(root).unwrap_or(&path).into();
            files.insert(name, without_solutions(&text).into_bytes());
        }
    }
    Ok(files)
}

/// The texts of the known correct variants of a stage.
fn variants(root: &Path, stage: &str) -> Result<Vec<Vec<u8>>, GraderError> {
    let folder = root.join("grader/mutants/variants").join(stage);
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
