//! Records: how each case ended, with its answer.

use crate::kinds::Answer;
use crate::question::Question;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// An entry of the file that the worker writes: for each case a start, then its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RecordFrame {
    /// The case with this index starts. If no entry follows, the case ended the worker.
    Started {
        /// Index in the list of cases.
        case: u32,
    },
    /// The student's code ran longer than the case allows; the worker ends.
    TimedOut {
        /// Index in the list of cases.
        case: u32,
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// The student's code printed without end; the worker ends.
    PrintedTooMuch {
        /// Index in the list of cases.
        case: u32,
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// A call starts. Only a worker that is asked for it writes these entries.
    Calling {
        /// Index in the list of cases.
        case: u32,
        /// The call, counted from 0.
        call: u32,
    },
    /// The case has ended.
    Done(Record),
    /// The worker waits for the result of a test.
    Asking {
        /// Index in the list of cases.
        case: u32,
        /// The call that tests, counted from 0.
        call: u32,
        /// The test.
        question: Question,
    },
    /// The student's code took more of the machine than a worker may; the worker ends.
    TookTooMuch {
        /// Index in the list of cases.
        case: u32,
        /// The call that was running, counted from 0.
        call: u32,
        /// What it took.
        what: Excess,
    },
    /// The case is running.
    Spent {
        /// Index in the list of cases.
        case: u32,
        /// What it has taken so far: milliseconds of the machine whose seconds the limits are.
        ms: u64,
    },
}

/// What code can take too much of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Excess {
    /// Threads at one time.
    Threads,
    /// Memory, the stacks of threads included.
    Memory,
    /// Time in which it computed nothing.
    Waiting,
}

/// The result of one case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Index in the list of cases.
    pub case: u32,
    /// Tasks whose given code was called unchanged.
    pub untouched: Vec<String>,
    /// Functions of the case's task that ran into a hole or a start that the course provides, each
    /// once. Their answers mean nothing.
    pub holes: Vec<HoleCall>,
    /// How the case ended.
    pub outcome: Outcome,
}

/// A call of a function that is not written yet, or that calls one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HoleCall {
    /// The function that the worker called.
    pub called: String,
    /// The function that is not written yet.
    pub hole: String,
}

/// How a case ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// The student's code returned.
    Answered(Answer),
    /// The student's code called a hole.
    NotAttempted {
        /// Key of the task that is not written yet.
        task: String,
    },
    /// The student's code panicked.
    Panicked {
        /// The panic's message.
        message: String,
        /// File and line, if known.
        location: String,
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// The student's code called a function that it was given far more often than it was asked to.
    CalledTooOften {
        /// The name of the function, such as `camera_ray`.
        function: String,
        /// How often it was called.
        times: u64,
        /// What the student's code was asked for, such as `16 samples`.
        asked_for: String,
        /// The call that was running, counted from 0.
        call: u32,
    },
    /// The worker cannot do this work: a stage is not linked or a file is missing.
    Unable {
        /// Why.
        reason: String,
    },
}

/// The longest text of a record, in bytes. The student's code can make the message of a panic as long
/// as it likes.
pub const MOST_OF_TEXT: usize = 4096;

/// `text`, or its beginning if it is longer than [`MOST_OF_TEXT`].
pub fn shortened(text: &str) -> Cow<'_, str> {
    if text.len() <= MOST_OF_TEXT {
        return text.into();
    }
    let mut ends = (0..=MOST_OF_TEXT).rev();
    let end = ends.find(|end| text.is_char_boundary(*end)).unwrap_or(0);
    format!("{}…", &text[..end]).into()
}
