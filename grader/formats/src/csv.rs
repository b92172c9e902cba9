//! A gradebook of one line, in the form of [`gradebook`].

use crate::gradebook::{self, Line};
use crate::{Outcome, Settings};
use base::GraderError;
use grader::score::{Status, TaskResult};
use submission::about_refused;

/// The file about `outcome`. If nothing was graded it has no columns of tasks, all points are empty,
/// not 0, and the note says why.
pub fn write(outcome: &Outcome, settings: &Settings) -> Result<String, GraderError> {
    let line = Line {
        id: settings.id.clone(),
        name: settings.name.clone(),
        ..Line::default()
    };
    let graded = match outcome {
        Outcome::Graded(graded) => graded,
        Outcome::Infrastructure(why) | Outcome::Refused { why, .. } => {
            let max = match outcome {
                Outcome::Refused { max_score, .. } => [*max_score, 0.0],
                _ => [0.0; 2],
            };
            let line = Line {
                status: "not graded".into(),
                note: why.clone(),
                ..line
            };
            return gradebook::write(&[], max, &[line]);
        }
    };
    let report = &graded.report;
    let results = || report.tasks.iter().map(|task| &task.result);
    let not_built = |task: &&TaskResult| task.status == Status::DoesNotCompile;
    let is_refused = |task: &&TaskResult| graded.refused.contains_key(&task.stage);
    let broken: Vec<&str> = results()
        .filter(not_built)
        .filter(|task| !is_refused(task))
        .map(|task| task.key.as_str())
        .collect();
    let broken = (!broken.is_empty()).then(|| format!("does not compile: {}", broken.join(" ")));
    let notes = broken.into_iter().chain(about_refused(&graded.refused));
    let line = Line {
        status: match graded.nothing_compiles() {
            true => "does not compile".into(),
            false => "graded".into(),
        },
        score: Some([report.score, report.robust_score]),
        tasks: results()
            .map(|task| [task.score, task.robust_score])
            .collect(),
        note: notes.collect::<Vec<_>>().join("; "),
        ..line
    };
    let tasks: Vec<&str> = results().map(|task| task.key.as_str()).collect();
    let max = [report.max_score, report.robust_max_score];
    gradebook::write(&tasks, max, &[line])
}
