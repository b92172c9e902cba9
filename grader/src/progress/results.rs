//! The last result of every task, in `target/first-light/results.json`: a run of one task does not
//! erase what is known of the others.

use crate::build::traces_scenes_with;
use crate::course::Course;
use crate::course::sources::{self, SourceFile};
use crate::report::table::status_text;
use crate::report::{Report, TaskReport};
use crate::score::Status;
use base::{GraderError, Workspace, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The last results, by the keys of their tasks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Results(BTreeMap<String, TaskScore>);

/// The last result of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskScore {
    /// Core points earned.
    pub score: f64,
    /// Core points possible.
    pub max_score: f64,
    /// Robust points earned.
    pub robust_score: f64,
    /// Robust points possible.
    pub robust_max_score: f64,
    /// Whether it was attempted.
    pub attempted: bool,
    /// The status as text.
    pub status: String,
    /// The [fingerprint](sources::fingerprint) of the stage that was graded.
    pub sources: String,
    /// The fingerprints of the stages with which cases of it trace whole scenes, if any do.
    #[serde(default)]
    pub scenes: Option<String>,
}

#[cfg(test)]
impl TaskScore {
    /// The last result of an attempted task without robust points.
    pub(crate) fn of(score: f64, max_score: f64) -> TaskScore {
        TaskScore {
            score,
            max_score,
            robust_score: 0.0,
            robust_max_score: 0.0,
            attempted: true,
            status: String::new(),
            sources: String::new(),
            scenes: None,
        }
    }
}

impl TaskScore {
    /// Whether every core point was earned.
    pub fn is_complete(&self) -> bool {
        self.score >= self.max_score
    }

    /// Whether the result is that of other code than `code`.
    pub fn is_of_other_code(&self, code: &TaskCode) -> bool {
        let scenes = self.scenes.as_ref();
        self.sources != code.stage || scenes.is_some_and(|scenes| *scenes != code.with_scenes)
    }
}

/// The fingerprints of the code that the answers of a task depend on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskCode {
    /// Of its stage.
    stage: String,
    /// Of its stage and those that find the hits in whole scenes.
    with_scenes: String,
}

/// The fingerprints of the code of each task.
pub type Fingerprints = BTreeMap<String, TaskCode>;

/// Computes the fingerprints of all tasks of `course`. Call it before their stages are built.
pub fn fingerprints(workspace: &Workspace, course: &Course) -> Result<Fingerprints, GraderError> {
    let stages = sources::read_all(workspace.root(), course)?;
    Ok(of_files(course, &stages))
}

/// The fingerprints of all tasks of `course`, whose stages have the files `stages`.
pub fn of_files(course: &Course, stages: &BTreeMap<&str, Vec<SourceFile>>) -> Fingerprints {
    let stages: BTreeMap<&str, String> = stages
        .iter()
        .map(|(stage, files)| (*stage, sources::fingerprint(files)))
        .collect();
    let tasks = course.tasks().map(|task| {
        let own = task.stage.as_str();
        let of_scenes: Vec<&str> = stages
            .iter()
            .filter(|(stage, _)| traces_scenes_with(own, stage))
            .map(|(_, code)| code.as_str())
            .collect();
        let code = TaskCode {
            stage: stages[own].clone(),
            with_scenes: of_scenes.join(" "),
        };
        (task.key.clone(), code)
    });
    tasks.collect()
}

impl Results {
    /// Reads the stored results. Where nothing is stored or it cannot be read, nothing is known:
    /// the next run writes it anew.
    pub fn read(workspace: &Workspace) -> Results {
        let text = std::fs::read_to_string(path(workspace)).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or_default()
    }

    /// Replaces the results of the tasks of `report`, whose code had these fingerprints.
    pub fn merge(&mut self, report: &Report, fingerprints: &Fingerprints) {
        let scores = report.tasks.iter().map(|TaskReport { result, .. }| {
            let code = fingerprints.get(&result.key);
            let traces_scenes = result.cases.iter().any(|case| case.with_neighbours);
            let score = TaskScore {
                score: result.score,
                max_score: result.max_score,
                robust_score: result.robust_score,
                robust_max_score: result.robust_max_score,
                attempted: result.status != Status::NotAttempted,
                status: status_text(&result.status),
                sources: code.map(|code| code.stage.clone()).unwrap_or_default(),
                scenes: code
                    .filter(|_| traces_scenes)
                    .map(|code| code.with_scenes.clone()),
            };
            (result.key.clone(), score)
        });
        self.0.extend(scores);
    }

    /// Stores the results.
    pub fn write(&self, workspace: &Workspace) -> Result<(), GraderError> {
        let json = serde_json::to_string_pretty(self)
            .map_err(|e| GraderError::new(format!("cannot write the results as JSON: {e}")))?;
        workspace.create_outputs()?;
        write_whole(&path(workspace), json.as_bytes())
    }

    /// The last result of the task `key`.
    pub fn of(&self, key: &str) -> Option<&TaskScore> {
        self.0.get(key)
    }
}

fn path(workspace: &Workspace) -> PathBuf {
    workspace.outputs().join("results.json")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::of_this_checkout;

    #[test]
    fn a_box_test_changes_the_code_of_the_scenes_that_are_traced_with_it() {
        let (workspace, course) = of_this_checkout();
        let mut stages = sources::read_all(workspace.root(), &course).expect("they are there");
        let of_handed_in = |task: &str, code: &Fingerprints, traces_scenes: bool| TaskScore {
            sources: code[task].stage.clone(),
            scenes: traces_scenes.then(|| code[task].with_scenes.clone()),
            ..TaskScore::of(1.0, 1.0)
        };
        let before = of_files(&course, &stages);
        let [scenes, alone] =
            [true, false].map(|traces| of_handed_in("part2.task3", &before, traces));
        let bbox = stages.get_mut("bbox").expect("a stage");
        bbox[0].text.push('\n');
        let code = of_files(&course, &stages);
        assert!(scenes.is_of_other_code(&code["part2.task3"]));
        assert!(!alone.is_of_other_code(&code["part2.task3"]));
        assert!(!scenes.is_of_other_code(&before["part2.task3"]));
        let light = stages.get_mut("direct").expect("a stage");
        light[0].text.push('\n');
        assert_eq!(
            of_files(&course, &stages)["part2.task3"],
            code["part2.task3"]
        );
    }
}
