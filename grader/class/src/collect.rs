//! The rows of a class: a pure function of the folder `OUT`.

mod points;
pub(crate) mod report;

pub use crate::gradebook::table::points_text as points;
pub use crate::row::{Class, Details, Graded, Row, Score, Status, TaskOutcome};
pub use report::{Case, Diagnosis, Drawing, Finding, Simplest, StudentReport, Task};

use crate::by_hand::{self, ByHand};
use crate::late;
use crate::out::{Out, read_regular};
use crate::plan::{Plan, Planned, State};
use crate::unit::{self, Outcome};
use base::GraderError;
use std::collections::BTreeMap;
use submission::Untrusted;

/// What the rows depend on besides the plan and the units.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// What a submission gets that could not be read.
    pub on_unreadable: OnUnreadable,
    /// The students' names, by those of their submissions.
    pub owners: BTreeMap<String, Untrusted>,
    /// Why submissions do not count, by their names.
    pub replaced: BTreeMap<String, Untrusted>,
    /// What is given by hand.
    pub by_hand: ByHand,
}

/// What a submission gets that could not be read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnUnreadable {
    /// No score: its student may have the code, and it is a question to the teacher.
    #[default]
    Ask,
    /// 0 points, as the teacher has decided.
    Zero,
}

/// What is said about a unit that no machine has finished or failed.
const NOT_YET: &str = "not graded yet";

impl Class {
    /// Reads the results of the units of `plan`, and shows each to `visit`: the number of its row, the
    /// row, and its unit if there is one.
    pub fn read(
        out: &Out,
        plan: Plan,
        options: &Options,
        mut visit: impl FnMut(&Plan, usize, &Row, Option<&Details>) -> Result<(), GraderError>,
    ) -> Result<Class, GraderError> {
        let mut rows = Vec::new();
        for (i, planned) in plan.submissions.iter().enumerate() {
            let (mut row, details) = row(out, &plan, planned, options.on_unreadable)?;
            let name = planned.name.raw();
            row.owner = options.owners.get(name).cloned();
            row.notes.extend(options.replaced.get(name).cloned());
            if let Some(marks) = options.by_hand.submissions.get(name) {
                by_hand::apply(marks, &mut row);
            }
            visit(&plan, i, &row, details.as_ref())?;
            rows.push(row);
        }
        Ok(Class { rows, plan })
    }

    /// What was graded, with the name of the teacher's course.
    pub fn title(&self) -> String {
        let what = &self.plan.settings.what;
        match &self.plan.term {
            Some(term) => format!("{}: {what}", term.title),
            None => what.clone(),
        }
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
        let counts: Vec<String> = self
            .counts()
            .into_iter()
            .map(|(label, count)| format!("{count} {label}"))
            .collect();
        format!("{} submissions: {}", self.rows.len(), counts.join(", "))
    }

    /// How many submissions have no score because the machine failed, or has not graded them yet.
    pub fn not_graded(&self) -> usize {
        let is_left = |row: &&Row| matches!(row.status, Status::Infrastructure(_));
        self.rows.iter().filter(is_left).count()
    }

    /// Whether every submission has a score.
    pub fn is_complete(&self) -> bool {
        self.rows.iter().all(|row| row.score.is_some())
    }
}

/// The row of a submission. Whatever is wrong with it or its result is said in the row.
fn row(
    out: &Out,
    plan: &Plan,
    planned: &Planned,
    on_unreadable: OnUnreadable,
) -> Result<(Row, Option<Details>), GraderError> {
    let without_unit = |status, score| {
        let row = Row {
            name: planned.name.clone(),
            owner: None,
            status,
            score,
            notes: Vec::new(),
            doubts: Vec::new(),
            by_hand: 0.0,
            given: Vec::new(),
            graded: None,
        };
        (row, None)
    };
    let about_file =
        |why: &Untrusted| Untrusted::new(format!("{} {}", planned.file.raw(), why.raw()));
    let (key, notes, commit, as_it_lies) = match &planned.state {
        State::Unit {
            key,
            notes,
            commit,
            as_it_lies,
            ..
        } => (key, notes, commit, *as_it_lies),
        State::TooLarge(why) | State::Unreadable(why) => {
            let status = Status::Unreadable(about_file(why));
            let score = (on_unreadable == OnUnreadable::Zero).then(Score::default);
            return Ok(without_unit(status, score));
        }
        State::NoClone(why) => {
            return Ok(without_unit(Status::Question(about_file(why)), None));
        }
        State::NotRead(why) => {
            return Ok(without_unit(Status::Infrastructure(why.clone()), None));
        }
    };
    let stored = unit::load(out, key).and_then(|unit| {
        let unit = unit.map(|unit| {
            let report = StudentReport::of(&unit, plan)?;
            Ok((unit, report))
        });
        unit.transpose()
    });
    let (unit, report) = match stored {
        Ok(Some(stored)) => stored,
        Ok(None) => {
            let why = read_regular(&out.failure(key)).ok();
            let why = why.and_then(|why| String::from_utf8(why).ok());
            let why = why.map_or_else(|| NOT_YET.to_string(), |why| why.trim().to_string());
            return Ok(without_unit(Status::Infrastructure(why.into()), None));
        }
        Err(why) => {
            let status = Status::Infrastructure(why.to_string().into());
            return Ok(without_unit(status, None));
        }
    };
    let mut notes = notes.clone();
    let due = plan.term.as_ref().and_then(|term| term.due);
    notes.extend(commit.as_ref().and_then(|commit| late::note(commit, due)));
    if as_it_lies {
        notes.push("no clone: graded as it was handed in, and nobody knows when".into());
    }
    notes.extend(report.notes());
    if !unit.endless_extra.is_empty() {
        let over = cases_over_a_limit(&unit.endless_extra);
        notes.push(format!("only in extra credit, over a limit: {over}").into());
    }
    let status = match &unit.outcome {
        Outcome::OverLimit(limit) => Status::OverLimit(limit.as_str().into()),
        Outcome::DoesNotCompile if report.refused_stages.is_empty() => Status::DoesNotCompile,
        Outcome::DoesNotCompile => Status::Refused,
        Outcome::Graded if unit.endless_cases.is_empty() => Status::Graded,
        Outcome::Graded => Status::OverLimit(cases_over_a_limit(&unit.endless_cases).into()),
    };
    let tasks = report.tasks.iter();
    let score = Score {
        core: report.score,
        extra: report.robust_score,
        tasks: tasks
            .clone()
            .map(|task| (task.key.clone(), [task.score, task.robust_score]))
            .collect(),
    };
    let outcomes = tasks.map(|task| TaskOutcome {
        key: task.key.clone(),
        stage: task.stage.clone(),
        status: task.status.clone(),
        lost: task.max_score - task.score,
        diagnosis: task.diagnosis.clone(),
        simplest: task.simplest.clone(),
    });
    let row = Row {
        name: planned.name.clone(),
        owner: None,
        status,
        score: Some(score),
        notes,
        doubts: report.doubts(),
        by_hand: 0.0,
        given: Vec::new(),
        graded: Some(Graded {
            tasks: outcomes.collect(),
            wrong_answers: unit.wrong_answers.clone(),
            sources: unit.sources.clone(),
        }),
    };
    Ok((row, Some((unit, report))))
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
