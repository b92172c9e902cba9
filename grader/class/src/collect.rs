//! The rows of a class: a pure function of the folder `OUT`.

mod report;

pub use report::{Case, Diagnosis, Finding, StudentReport, Task};

use crate::out::Out;
use crate::plan::{Plan, Planned, State};
use crate::unit::{self, Outcome, Unit};
use base::GraderError;
use std::collections::BTreeMap;
use std::fmt;

/// A class with its results.
#[derive(Clone, Debug)]
pub struct Class {
    /// The plan.
    pub plan: Plan,
    /// One row for each submission, sorted by name.
    pub rows: Vec<Row>,
}

/// The result of one submission.
#[derive(Clone, Debug)]
pub struct Row {
    /// The student's name.
    pub name: String,
    /// How it ended.
    pub status: Status,
    /// The points; `None` if there is no score.
    pub score: Option<Score>,
    /// What the instructor should know, as sentences.
    pub notes: Vec<String>,
    /// The result of its unit and the report in it, if there is one.
    pub graded: Option<(Unit, StudentReport)>,
}

/// How grading a submission ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// It was built, and its cases were judged.
    Graded,
    /// None of its stages compiles.
    DoesNotCompile,
    /// None of its stages compiles, and at least one was refused before it was compiled.
    Refused,
    /// It exceeded this limit.
    OverLimit(String),
    /// What was handed in is no submission that can be read: what is wrong with it. Nothing of it
    /// could be graded, so it has no points.
    Unreadable(String),
    /// It has no score yet: the machine failed. A person has to look at it.
    Infrastructure(String),
}

impl Status {
    /// Its name in tables.
    pub fn label(&self) -> &'static str {
        match self {
            Status::Graded => "graded",
            Status::DoesNotCompile => "does not compile",
            Status::Refused => "refused",
            Status::OverLimit(_) => "over a limit",
            Status::Unreadable(_) => "could not be read",
            Status::Infrastructure(_) => "infrastructure",
        }
    }

    /// Which limit, which damage or what failure it is.
    pub fn detail(&self) -> Option<&str> {
        match self {
            Status::OverLimit(what) | Status::Unreadable(what) | Status::Infrastructure(what) => {
                Some(what)
            }
            _ => None,
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.detail() {
            Some(detail) => write!(f, "{}: {detail}", self.label()),
            None => f.write_str(self.label()),
        }
    }
}

/// The points of a submission.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Score {
    /// Core points.
    pub core: f64,
    /// Extra points.
    pub extra: f64,
    /// Core and extra points of each task, by its key.
    pub tasks: BTreeMap<String, [f64; 2]>,
}

/// What is said about a unit that no machine has finished or failed.
const NOT_YET: &str = "not graded yet";

impl Class {
    /// Reads the results of the units of `plan`.
    pub fn read(out: &Out, plan: Plan) -> Result<Class, GraderError> {
        let rows: Result<Vec<Row>, GraderError> = plan
            .submissions
            .iter()
            .map(|planned| row(out, planned))
            .collect();
        Ok(Class { rows: rows?, plan })
    }

    /// How many submissions ended in each way, by its name in tables.
    pub fn counts(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        for row in &self.rows {
            *counts.entry(row.status.label()).or_default() += 1;
        }
        counts
    }

    /// How many submissions there are, and how they ended.
    pub fn summary(&self) -> String {
        let counts = self.counts().into_iter();
        let counts: Vec<String> = counts
            .map(|(label, count)| format!("{count} {label}"))
            .collect();
        format!("{} submissions: {}", self.rows.len(), counts.join(", "))
    }

    /// Core and extra points possible.
    pub fn max_score(&self) -> [f64; 2] {
        self.plan
            .tasks
            .iter()
            .fold([0.0; 2], |[core, extra], task| {
                [core + task.max_score, extra + task.max_extra]
            })
    }

    /// Whether every submission has a score.
    pub fn is_complete(&self) -> bool {
        self.rows.iter().all(|row| row.score.is_some())
    }
}

fn row(out: &Out, planned: &Planned) -> Result<Row, GraderError> {
    let without_unit = |status, score| Row {
        name: planned.name.clone(),
        status,
        score,
        notes: Vec::new(),
        graded: None,
    };
    let (key, notes) = match &planned.state {
        State::Unit { key, notes, .. } => (key, notes),
        State::TooLarge(limit) => {
            let status = Status::OverLimit(format!("{} {limit}", planned.file));
            return Ok(without_unit(status, Some(Score::default())));
        }
        State::Unreadable(why) => {
            let status = Status::Unreadable(format!("{} {why}", planned.file));
            return Ok(without_unit(status, Some(Score::default())));
        }
    };
    let Some(unit) = unit::load(out, key)? else {
        let why = std::fs::read_to_string(out.failure(key));
        let why = why.map_or_else(|_| NOT_YET.to_string(), |why| why.trim().to_string());
        return Ok(without_unit(Status::Infrastructure(why), None));
    };
    let report = StudentReport::of(&unit)?;
    let mut notes = notes.clone();
    notes.extend(report.notes());
    let status = match &unit.outcome {
        Outcome::OverLimit(limit) => Status::OverLimit(limit.clone()),
        Outcome::DoesNotCompile if report.refused_stages.is_empty() => Status::DoesNotCompile,
        Outcome::DoesNotCompile => Status::Refused,
        Outcome::Graded if unit.endless_cases.is_empty() => Status::Graded,
        Outcome::Graded => Status::OverLimit(cases_over_a_limit(&unit.endless_cases)),
    };
    let tasks = report.tasks.iter();
    let tasks = tasks.map(|task| (task.key.clone(), [task.score, task.robust_score]));
    Ok(Row {
        name: planned.name.clone(),
        status,
        score: Some(Score {
            core: report.score,
            extra: report.robust_score,
            tasks: tasks.collect(),
        }),
        notes,
        graded: Some((unit, report)),
    })
}

/// Names the cases that did not end within their limits, by task.
fn cases_over_a_limit(tasks: &BTreeMap<String, Vec<String>>) -> String {
    let tasks = tasks.iter().map(|(task, cases)| match cases.as_slice() {
        [case] => format!("{task}/{case}"),
        cases => format!("{} cases of {task}", cases.len()),
    });
    let tasks: Vec<String> = tasks.collect();
    format!("time, memory or output of a case: {}", tasks.join(", "))
}

/// Formats points with at most three decimal places.
pub fn points(points: f64) -> String {
    let text = format!("{points:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".to_string(),
        text => text.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_no_needless_digits() {
        for (number, text) in [
            (80.0, "80"),
            (21.05, "21.05"),
            (1.0 / 3.0, "0.333"),
            (0.0, "0"),
            (-1e-9, "0"),
        ] {
            assert_eq!(points(number), text);
        }
    }
}
