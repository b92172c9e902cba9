//! `grader watch`: grades what a saved file touches, shows what to do next, and reads keys.
//!
//! [`run`] is the loop. It sees the world through a [`Desk`], so that a test can drive it;
//! [`files`] finds out which files were saved.

pub mod files;

use crate::course::chapter::chapter;
use crate::course::{Course, Task, is_selected};
use crate::report::screen::{self, Context};
use crate::report::terminal::{GREEN, Page};
use crate::report::wrap::one_line;
use crate::report::{HintLevel, Report, Reveal};
use base::GraderError;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What happened at the desk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// Files of these stages were saved.
    Saved(BTreeSet<String>),
    /// The student pressed this key, or typed this line.
    Typed(String),
    /// There is nothing more to read: the terminal was closed.
    Closed,
    /// Nobody reads what is shown: the pipe to `head`, for example, was closed.
    Unread,
}

/// The world around the loop.
pub trait Desk {
    /// Waits for the next event.
    fn next_event(&mut self) -> Result<Event, GraderError>;

    /// Grades `what`, as [`Course::select`] reads it.
    fn grade(&mut self, what: &str) -> Result<(Report, Context), GraderError>;

    /// The key of the next open task that is none of `but`: of `limit`, a part or a task, or of the
    /// course.
    fn next_open(
        &mut self,
        limit: Option<&str>,
        but: &[&Task],
    ) -> Result<Option<String>, GraderError>;

    /// Whether a key counts only after Enter.
    fn needs_enter(&self) -> bool;

    /// Opens a file outside the terminal: a page or a picture. Returns whether that is possible.
    fn open(&mut self, file: &Path) -> bool;

    /// Shows a text instead of the one before.
    fn show(&mut self, text: &str);
}

/// The last line of the screen, after "keys": the keys.
const KEYS: &str = "h more hint, n next task, p picture, c chapter, q quit";

/// Why the loop ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The student quit.
    ByKey,
    /// There was nothing more to read.
    InputClosed,
    /// Nobody read what was shown.
    OutputClosed,
}

impl Ended {
    /// The sentence about it, where the student did not ask for it.
    pub fn why(self) -> Option<&'static str> {
        match self {
            Ended::ByKey | Ended::OutputClosed => None,
            Ended::InputClosed => Some(
                "grader watch ended: its standard input was closed, and it reads keys from there. \
                 Run it in a terminal",
            ),
        }
    }
}

/// Lines for the keys and a remark.
const FOOTER: usize = 3;

/// Watches until the student quits. `limit` is the part or the task that is graded, if not all are;
/// `complete` are the keys of the tasks that are known to be complete.
pub fn run(
    desk: &mut impl Desk,
    course: &Course,
    limit: Option<&str>,
    hint: HintLevel,
    complete: BTreeSet<String>,
    page: Page,
) -> Result<Ended, GraderError> {
    let first = desk.next_open(limit, &[])?;
    let mut session = Session {
        course,
        limit,
        page: Page {
            height: page.height.saturating_sub(FOOTER),
            ..page
        },
        reveal: Reveal { hint, extra: false },
        complete,
        what: first.unwrap_or_else(|| limit.unwrap_or("all").to_owned()),
        last: None,
    };
    session.grade(desk);
    loop {
        match desk.next_event()? {
            Event::Closed => return Ok(Ended::InputClosed),
            Event::Unread => return Ok(Ended::OutputClosed),
            Event::Saved(stages) => {
                if let Some(what) = session.touched(&stages) {
                    session.what = what;
                    session.grade(desk);
                }
            }
            Event::Typed(line) => match line.trim() {
                "q" => return Ok(Ended::ByKey),
                "" => session.grade(desk),
                "h" => {
                    let next = session.reveal.hint.next();
                    session.reveal.hint = next.unwrap_or(session.reveal.hint);
                    session.show(desk, next.map_or("This is the last level.", |_| ""));
                }
                "n" => match desk.next_open(limit, &session.selected())? {
                    Some(next) => {
                        session.what = next;
                        session.grade(desk);
                    }
                    None => session.show(desk, "No other task is open."),
                },
                "p" => session.open(desk, "picture", picture),
                "c" => session.open(desk, "chapter", |_, key| chapter(key).map(PathBuf::from)),
                other => session.show(desk, &format!("There is no key {other:?}.")),
            },
        }
    }
}

/// The picture of the task `key`, if the run rendered it.
fn picture(report: &Report, key: &str) -> Option<PathBuf> {
    let mut tasks = report.tasks.iter().filter(|task| task.result.key == key);
    tasks.find_map(|task| task.picture.clone())
}

/// What is on the screen.
struct Session<'a> {
    course: &'a Course,
    /// The part or the task that is graded.
    limit: Option<&'a str>,
    page: Page,
    reveal: Reveal,
    /// The keys of the tasks that were complete when they were last graded.
    complete: BTreeSet<String>,
    /// What is graded.
    what: String,
    /// The last report and what is shown with it, or why there is none.
    last: Option<Result<(Report, Context), GraderError>>,
}

impl Session<'_> {
    /// What to grade after files of `stages` were saved: the tasks of these stages that are
    /// watched.
    fn touched(&self, stages: &BTreeSet<String>) -> Option<String> {
        let tasks = self.course.tasks().filter(|task| {
            let is_watched = self.limit.is_none_or(|limit| is_selected(&task.key, limit));
            is_watched && stages.contains(&task.stage)
        });
        let keys: Vec<&str> = tasks.map(|task| task.key.as_str()).collect();
        (!keys.is_empty()).then(|| keys.join(","))
    }

    /// The tasks that are shown.
    fn selected(&self) -> Vec<&Task> {
        self.course.select(&self.what).unwrap_or_default()
    }

    fn grade(&mut self, desk: &mut impl Desk) {
        let what = format!("grading {} ...", self.what.replace(',', ", "));
        desk.show(&format!("{}\n", one_line(&what, self.page.width)));
        let graded = desk.grade(&self.what);
        let mut now_complete = Vec::new();
        if let Ok((report, _)) = &graded {
            for result in report.tasks.iter().map(|task| &task.result) {
                if result.score < result.max_score {
                    self.complete.remove(&result.key);
                } else if self.complete.insert(result.key.clone()) {
                    now_complete.push(result.key.clone());
                }
            }
        }
        self.last = Some(graded);
        let remark = match now_complete.as_slice() {
            [] => String::new(),
            keys => format!("Done, every core point: {}.", keys.join(", ")),
        };
        let remark = match self.page.colours && !remark.is_empty() {
            true => format!("{GREEN}{remark}{GREEN:#}"),
            false => remark,
        };
        self.show(desk, &remark);
    }

    /// Shows the last report with a remark below it.
    fn show(&self, desk: &mut impl Desk, remark: &str) {
        let text = match &self.last {
            Some(Ok((report, context))) => {
                screen::format_screen(report, context, self.reveal, self.page)
            }
            Some(Err(error)) => format!("error: {error}\n"),
            None => String::new(),
        };
        let remark = match remark {
            "" => String::new(),
            remark => format!("{remark}\n"),
        };
        let keys = if desk.needs_enter() {
            "keys, then Enter"
        } else {
            "keys"
        };
        desk.show(&format!("{text}\n{remark}{keys}: {KEYS}\n"));
    }

    /// Opens the file that `of` finds for the task that is shown in detail: its picture or its
    /// chapter, named `what`. Below the report stands its path.
    fn open(
        &self,
        desk: &mut impl Desk,
        what: &str,
        of: impl Fn(&Report, &str) -> Option<PathBuf>,
    ) {
        let Some(Ok((report, _))) = &self.last else {
            return self.show(desk, "");
        };
        let task = screen::first_to_mend(report, false).or(report.tasks.last());
        let remark = task.map(|task| {
            let key = &task.result.key;
            match of(report, key) {
                Some(file) => {
                    let opened = if desk.open(&file) { ", opened" } else { "" };
                    format!("The {what} of {key}: {}{opened}", file.display())
                }
                None => format!("There is no {what} of {key}."),
            }
        });
        self.show(desk, &remark.unwrap_or_default());
    }
}

#[cfg(test)]
mod tests;
