//! The grader's own code in a stage. A handout has the code that judges: the exact arithmetic and
//! the walks that count tests decide what is right, so a stage that contains them gets points for
//! code that is not the student's.
//!
//! What counts is long passages of equal code, whatever the names in it are. Textbook code that a
//! student and the grader both have is shorter.

use crate::code::passages::{Known, Passage, Text};
use crate::code::source::Source;
use crate::code::{self, known_of_handout};
use crate::file_tree::Files;
use base::GraderError;
use std::path::Path;

/// The fewest tokens of a passage, some seven lines: a shorter run may be equal by chance.
const PASSAGE: usize = 50;

/// So many tokens of such passages, some 20 lines, are no chance: the correct versions of the
/// course have less than half of it in common with the grader.
const MOST: usize = 150;

/// Where the code lies that decides what is right: the exact arithmetic and the walks that count
/// tests.
const DECIDES: [&str; 3] = [
    "grader/oracle/src",
    "grader/judge/src/tools/truth",
    "grader/review/src/box_walk.rs",
];

/// The code of the grader that decides, as a handout has it.
#[derive(Debug)]
pub(crate) struct GradersCode(Source);

impl GradersCode {
    /// That of the course below `root`.
    pub(crate) fn read(root: &Path) -> Result<GradersCode, GraderError> {
        let files = code::in_folders(root, &DECIDES)?;
        Ok(GradersCode(Source::new(&files, &Known::default())))
    }

    /// A sentence for each passage of it in the `files` of `stage`, if they are too long to be
    /// chance. The course below `root` says what everybody has.
    pub(crate) fn found_in(
        &self,
        root: &Path,
        stage: &str,
        files: &Files,
    ) -> Result<Vec<String>, GraderError> {
        if self.0.text.own() == 0 {
            return Ok(Vec::new()); // a folder without a grader
        }
        let known = known_of_handout(root, stage)?;
        let (mut tokens, mut sentences) = (0, Vec::new());
        // One at a time: the tokens of a file take a hundred times its memory.
        for (path, text) in files {
            let file = Files::from([(path.clone(), text.clone())]);
            let own = Source::new(&file, &known);
            for passage in self.passages(&own.text) {
                tokens += passage.length;
                let [start, graders] = passage.starts;
                let (at, graders) = (
                    own.excerpt(start, passage.length),
                    self.0.excerpt(graders, passage.length),
                );
                sentences.push(format!(
                    "stages/{stage}/src/{}:{}: {} lines of the grader's own code ({}:{}). A stage contains the student's own",
                    at.path.line(),
                    at.lines.start,
                    at.lines.len(),
                    graders.path.line(),
                    graders.lines.start,
                ));
            }
        }
        Ok(match tokens < MOST {
            true => Vec::new(),
            false => sentences,
        })
    }

    /// The long passages that it has in common with `text`.
    fn passages(&self, text: &Text) -> Vec<Passage> {
        let mut passages = text.common(&self.0.text);
        passages.retain(|passage| passage.length >= PASSAGE);
        passages
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::correct_versions::{reference, stages, variants, workspace};

    /// How many tokens of long passages a version of a stage has in common with the grader.
    fn in_common(graders: &GradersCode, known: &Known, files: &Files) -> usize {
        let text = Source::new(files, known).text;
        let passages = graders.passages(&text);
        passages.iter().map(|passage| passage.length).sum()
    }

    #[test]
    fn no_correct_version_has_half_of_what_is_refused() {
        let workspace = workspace();
        let root = workspace.root();
        let graders = GradersCode::read(root).unwrap();
        let mut compared = 0;
        for stage in stages() {
            let known = known_of_handout(root, &stage).unwrap();
            let each = variants(&stage).into_iter().map(|file| Files::from([file]));
            for version in each.chain([reference(&stage)]) {
                let tokens = in_common(&graders, &known, &version);
                assert!(2 * tokens < MOST, "{stage}, {:?}: {tokens}", version.keys());
                compared += 1;
            }
        }
        assert!(compared > 50, "{compared}");
    }

    #[test]
    fn code_of_the_grader_is_found_with_other_names_and_in_pieces() {
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
            let renamed = text.replace("ray", "line").replace("self.", "self . ");
            let pasted = Files::from([("walk.rs".into(), renamed.into_bytes())]);
            let found = graders.found_in(root, stage, &pasted).unwrap();
            let start = format!("stages/{stage}/src/walk.rs:");
            assert!(!found.is_empty(), "{path}");
            for sentence in found {
                assert!(sentence.starts_with(&start), "{sentence}");
                assert!(sentence.contains(path), "{sentence}");
            }
        }
    }
}
