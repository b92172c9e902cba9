//! A class with its results: the row of a submission, how grading ended, and its points.

use crate::collect::report::{Diagnosis, Simplest, StudentReport};
use crate::plan::Plan;
use crate::unit::{Unit, WrongAnswers};
use std::collections::BTreeMap;
use std::fmt;
use submission::Untrusted;

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
    /// The name of the submission, the key of marks and results.
    pub name: Untrusted,
    /// Whose it is, by the roster.
    pub owner: Option<Untrusted>,
    /// How it ended.
    pub status: Status,
    /// The points; `None` if there is no score.
    pub score: Option<Score>,
    /// What the student and the instructor should know, as sentences.
    pub notes: Vec<Untrusted>,
    /// What the instructor alone should look at, as sentences.
    pub doubts: Vec<Untrusted>,
    /// The core points of `score` that were given by hand.
    pub by_hand: f64,
    /// What was given by hand, as sentences.
    pub given: Vec<Untrusted>,
    /// What the tables of the class need of its unit, if there is one.
    pub graded: Option<Graded>,
}

/// The part of a unit that is kept for the tables of a class. The whole report of one student after
/// the other is read for the students' pages: those of a thousand do not fit a small machine.
#[derive(Clone, Debug)]
pub struct Graded {
    /// How each task ended.
    pub tasks: Vec<TaskOutcome>,
    /// The wrong answers of each task that has some.
    pub wrong_answers: BTreeMap<String, WrongAnswers>,
    /// The hashes of the source files of each stage that was handed in.
    pub sources: BTreeMap<String, String>,
}

/// How one task of a submission ended.
#[derive(Clone, Debug)]
pub struct TaskOutcome {
    /// Its key.
    pub key: String,
    /// The crate with its functions.
    pub stage: String,
    /// Its status, such as `failed`.
    pub status: String,
    /// The core points that were lost.
    pub lost: f64,
    /// The likely mistake.
    pub diagnosis: Option<Diagnosis>,
    /// The simplest call that shows what is wrong.
    pub simplest: Option<Simplest>,
}

impl Row {
    /// Whose submission it is: the student's name if the roster says it, else the submission's.
    pub fn who(&self) -> &Untrusted {
        self.owner.as_ref().unwrap_or(&self.name)
    }

    /// What a person should know about it, in one line.
    pub fn about(&self) -> String {
        let detail = self.status.detail().into_iter();
        let all = detail
            .chain(&self.given)
            .chain(&self.notes)
            .chain(&self.doubts);
        all.map(Untrusted::line).collect::<Vec<_>>().join("; ")
    }

    /// Whether nothing of it could be read, and the teacher gives nothing for it.
    pub fn is_unread_zero(&self) -> bool {
        let is_zero = self.score.as_ref().is_some_and(|score| score.core == 0.0);
        is_zero && matches!(self.status, Status::Unreadable(_))
    }

    /// Whether the code earned points.
    pub fn has_earned(&self) -> bool {
        let score = self.score.as_ref();
        score.is_some_and(|score| score.core + score.extra > self.by_hand)
    }
}

/// A unit and the report in it.
pub type Details = (Unit, StudentReport);

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
    OverLimit(Untrusted),
    /// What was handed in is no submission that can be read: what is wrong with it. Nothing of it
    /// could be graded, so a person says what it is worth.
    Unreadable(Untrusted),
    /// Whether it counts is for a person to say: what was found.
    Question(Untrusted),
    /// The teacher releases no mark until something is decided.
    HeldBack,
    /// It has no score yet: the machine failed. A person has to look at it.
    Infrastructure(Untrusted),
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
            Status::Question(_) => "a question",
            Status::HeldBack => "held back",
            Status::Infrastructure(_) => "infrastructure",
        }
    }

    /// Which limit, which damage or what failure it is.
    pub fn detail(&self) -> Option<&Untrusted> {
        match self {
            Status::OverLimit(what)
            | Status::Unreadable(what)
            | Status::Question(what)
            | Status::Infrastructure(what) => Some(what),
            _ => None,
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.detail() {
            Some(detail) => write!(f, "{}: {}", self.label(), detail.line()),
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
