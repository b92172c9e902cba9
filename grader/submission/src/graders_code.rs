//! The grader's own code in a stage. A handout has the code that judges: the exact arithmetic and
//! the walks that count tests decide what is right, so a stage that contains them gets points for
//! code that is not the student's.
//!
//! What counts is runs of equal code, whatever the names in it are, and whatever was added that
//! changes no program ([`plain`](crate::code::plain)). Textbook code that a student and the grader
//! both have has few of them.

use crate::code::plain::{self, Run};
use crate::code::{given, in_folders};
use crate::file_tree::Files;
use crate::untrusted::Untrusted;
use base::GraderError;
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The tokens of a run, some three lines.
const RUN: usize = 20;

/// So many different runs, some 20 lines in a row, are no chance: the correct versions of the
/// course have less than half of it in common with the grader.
const MOST: usize = 120;

/// Where the code lies that decides what is right: the exact arithmetic and the walks that count
/// tests.
const DECIDES: [&str; 3] = [
    "grader/oracle/src",
    "grader/judge/src/tools/truth",
    "grader/review/src/box_walk.rs",
];

/// The code of the grader that decides, as a handout has it: where each run of it starts.
#[derive(Debug)]
pub(crate) struct GradersCode(HashMap<u64, (PathBuf, usize)>);

/// Lines that a file has in common with the grader.
#[derive(Debug)]
struct Passage {
    lines: Range<usize>,
    /// The hash of its first run.
    first: u64,
}

impl GradersCode {
    /// That of the course below `root`.
    pub(crate) fn read(root: &Path) -> Result<GradersCode, GraderError> {
        let mut starts = HashMap::new();
        for (path, text) in in_folders(root, &DECIDES)? {
            for run in plain::runs(&text, RUN) {
                let start = || (path.clone(), run.lines.start);
                starts.entry(run.hash).or_insert_with(start);
            }
        }
        Ok(GradersCode(starts))
    }

    /// A sentence for each passage of it in the `files` of `stage`, if they are too long to be
    /// chance. The course below `root` says what everybody has.
    pub(crate) fn found_in(
        &self,
        root: &Path,
        stage: &str,
        files: &Files,
    ) -> Result<Vec<String>, GraderError> {
        if self.0.is_empty() {
            return Ok(Vec::new()); // a folder without a grader
        }
        let known = known_runs(root, stage)?;
        let (mut different, mut sentences) = (HashSet::new(), Vec::new());
        // One at a time: the tokens of a file take a hundred times its memory.
        for (path, text) in files {
            let common = self.common(text, &known);
            different.extend(common.iter().map(|run| run.hash));
            let file = Untrusted::new(path.to_string_lossy());
            for Passage { lines, first } in joined(&common) {
                let (graders, line) = &self.0[&first];
                sentences.push(format!(
                    "stages/{stage}/src/{}:{}: {} lines of the grader's own code ({}:{line}). A stage contains the student's own",
                    file.line(),
                    lines.start,
                    lines.len(),
                    graders.display(),
                ));
            }
        }
        Ok(match different.len() < MOST {
            true => Vec::new(),
            false => sentences,
        })
    }

    /// The runs of a text that it has in common with the grader, without what is `known`.
    fn common(&self, text: &[u8], known: &HashSet<u64>) -> Vec<Run> {
        let mut runs = plain::runs(text, RUN);
        runs.retain(|run| self.0.contains_key(&run.hash) && !known.contains(&run.hash));
        runs
    }
}

/// The runs that all students of a stage have.
fn known_runs(root: &Path, stage: &str) -> Result<HashSet<u64>, GraderError> {
    let files = given(root, stage)?.into_values();
    let runs = files.flat_map(|text| plain::runs(&text, RUN));
    Ok(runs.map(|run| run.hash).collect())
}

/// The passages of runs that have lines in common.
fn joined(runs: &[Run]) -> Vec<Passage> {
    let mut passages: Vec<Passage> = Vec::new();
    for Run { hash, lines } in runs {
        match passages.last_mut() {
            Some(last) if lines.start < last.lines.end => {
                last.lines.end = last.lines.end.max(lines.end);
            }
            _ => passages.push(Passage {
                lines: lines.clone(),
                first: *hash,
            }),
        }
    }
    passages
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::correct_versions::{reference, stages, variants, workspace};

    /// How many different runs a version of a stage has in common with the grader.
    fn in_common(graders: &GradersCode, known: &HashSet<u64>, files: &Files) -> usize {
        let runs = files.values().flat_map(|text| graders.common(text, known));
        runs.map(|run| run.hash).collect::<HashSet<u64>>().len()
    }

    #[test]
    fn no_correct_version_has_half_of_what_is_refused() {
        let workspace = workspace();
        let root = workspace.root();
        let graders = GradersCode::read(root).unwrap();
        let mut compared = 0;
        for stage in stages() {
            let known = known_runs(root, &stage).unwrap();
            let each = variants(&stage).into_iter().map(|file| Files::from([file]));
            for version in each.chain([reference(&stage)]) {
                let runs = in_common(&graders, &known, &version);
                assert!(2 * runs < MOST, "{stage}, {:?}: {runs}", version.keys());
                compared += 1;
            }
        }
        assert!(compared > 50, "{compared}");
    }

    #[test]
    fn code_of_the_grader_is_found_with_other_names_and_with_words_that_change_nothing() {
        let workspace = workspace();
        let root = workspace.root();
        let graders = GradersCode::read(root).unwrap();
        for (stage, path) in [
            ("intersect", "grader/oracle/src/triangle.rs"),
            ("intersect", "grader/oracle/src/sphere.rs"),
            ("bbox", "grader/oracle/src/bbox.rs"),
            ("bvh", "grader/judge/src/tools/truth/tree_tests.rs"),
            ("bvh", "grader/review/src/box_walk.rs"),
        ] {
            let text = std::fs::read_to_string(root.join(path)).unwrap();
            let text = text.split("#[cfg(test)]").next().unwrap_or_default();
            let renamed = text.replace("ray", "line").replace("self.", "(self) . ");
            let longer = renamed
                .replace("Some(", "Option::Some(")
                .replace("f64", "core::primitive::f64")
                .replace(";\n        ", ";\n        let _ = ();\n        ");
            for text in [renamed, longer] {
                let pasted = Files::from([("walk.rs".into(), text.into_bytes())]);
                let found = graders.found_in(root, stage, &pasted).unwrap();
                let start = format!("stages/{stage}/src/walk.rs:");
                assert!(!found.is_empty(), "{path}");
                assert!(found.iter().all(|sentence| sentence.starts_with(&start)));
                assert!(found.iter().any(|sentence| sentence.contains(path)));
            }
        }
    }
}
