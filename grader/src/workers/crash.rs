//! Calls that end without an answer: what kind of end it was, and the sentence about it.

use crate::workers::printed::{MOST_BYTES, with_commas};
use crate::workers::runner::Ending;
use serde::{Serialize, Serializer};
use std::fmt;
use wire::Outcome;

/// The kind of a [`Crash`]. A mistake shows in the same cases as the same kind of crash.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CrashKind {
    /// A panic.
    Panic,
    /// A loop or a recursion without end: it ran out of time, of stack, of memory or of threads,
    /// called a function or printed without end.
    Endless,
    /// The code ended the program, or wrote into the worker's records.
    #[default]
    Ended,
    /// The system ended the program or did not start it. It may have run out of memory.
    Killed,
}

/// Whether this is the panic of `println!` or `eprintln!` after the worker's pipe was closed.
fn is_closed_output(message: &str) -> bool {
    message.starts_with("failed printing to std") && message.contains("Broken pipe")
}

/// How the code of a case ended without an answer. As text, what ends the sentence "your code ...",
/// with the call and its input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Crash {
    /// The kind of end.
    pub kind: CrashKind,
    /// How it ended, whichever call it was.
    pub how: String,
    /// The call that was running, counted from 0, if it is known.
    pub call: Option<u32>,
    /// The input of that call.
    pub input: Option<String>,
    /// The file and the line of a panic.
    pub panicked_at: Option<(String, usize)>,
}

impl Crash {
    /// The crash of a case with this ending, without the input of the call; `None` if it is not a
    /// crash.
    pub fn of(ending: &Ending) -> Option<Crash> {
        use CrashKind::{Ended, Endless, Killed, Panic};
        let mut panicked_at = None;
        let (kind, call, how) = match ending {
            Ending::TimedOut { call, waited: true, .. } => (
                Endless,
                Some(*call),
                "did not return in many times the time of correct code, and waited for most of it: does it sleep, or wait for a lock or a thread?".into(),
            ),
            Ending::TimedOut { call, .. } => (
                Endless,
                Some(*call),
                "did not return in many times the time of correct code: too much work, or an endless loop?".into(),
            ),
            Ending::PrintedTooMuch { call } => (
                Endless,
                Some(*call),
                "printed more than 5,000,000 times in one call: an endless loop?".into(),
            ),
            Ending::TooManyThreads { call } => (
                Endless,
                Some(*call),
                "started more than a hundred threads at once: join them, or start one for each processor".into(),
            ),
            Ending::OutOfTime => (
                Endless,
                None,
                "was not run to its end: with it, the cases of this task or of all tasks take many times the time of correct code: does it sleep or wait?".into(),
            ),
            Ending::Died { how, call } if how.is_endless() => (Endless, *call, how.to_string()),
            Ending::Died { how, call } if how.is_of_the_system() => (Killed, *call, how.to_string()),
            Ending::Died { how, call } => (Ended, *call, how.to_string()),
            Ending::Malformed(how) => (Ended, None, how.clone()),
            Ending::ChangedCounts(how) => {
                let how = format!("changed the grader's counts of its tests: {how}");
                (Ended, None, how)
            }
            Ending::Recorded(record) => match &record.outcome {
                Outcome::Panicked { call, message, .. } if is_closed_output(message) => {
                    let most = MOST_BYTES >> 30;
                    let how = format!("printed more than {most} GB in this run, so `println!` panicked: print less");
                    (Ended, Some(*call), how)
                }
                Outcome::Panicked { message, location, call } => {
                    panicked_at = place(location);
                    // Code that replaces the hook of panics hides the place.
                    let at = if location.is_empty() { "" } else { " at " };
                    // In one line: one of several lines could end the report with its own score.
                    let ends = |c: char| c.is_whitespace() || c.is_control();
                    let words = message.split(ends).filter(|word| !word.is_empty());
                    let message = words.collect::<Vec<&str>>().join(" ");
                    (Panic, Some(*call), format!("panicked{at}{location}: {message}"))
                }
                Outcome::CalledTooOften { function, times, asked_for, call } => {
                    let times = with_commas(*times);
                    let how = format!("called {function} {times} times, was asked for {asked_for}: an endless loop?");
                    (Endless, Some(*call), how)
                }
                _ => return None,
            },
            Ending::Skipped | Ending::NotRun => return None,
        };
        Some(Crash {
            kind,
            how,
            call,
            input: None,
            panicked_at,
        })
    }

    /// The same without the input: a simpler one is shown.
    #[must_use]
    pub fn without_input(&self) -> Crash {
        Crash {
            input: None,
            ..self.clone()
        }
    }
}

impl fmt::Display for Crash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.how)?;
        match (self.call, &self.input) {
            (Some(call), Some(input)) => write!(f, " (call {call} of the case: {input})"),
            (Some(call), None) => write!(f, " (call {call} of the case)"),
            (None, _) => Ok(()),
        }
    }
}

impl Serialize for Crash {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl From<&str> for Crash {
    fn from(how: &str) -> Crash {
        Crash {
            how: how.to_owned(),
            ..Crash::default()
        }
    }
}

/// The file and the line of "FILE:LINE" or "FILE:LINE:COLUMN", as rustc and panics print a place;
/// `None` if it is none.
pub fn place(location: &str) -> Option<(String, usize)> {
    let (file, last) = location.rsplit_once(':')?;
    let last = last.parse().ok()?;
    let with_column = file
        .rsplit_once(':')
        .and_then(|(file, line)| Some((file, line.parse().ok()?)));
    let (file, line) = with_column.unwrap_or((file, last));
    Some((file.to_owned(), line))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workers::death::Death;
    use wire::Record;

    fn recorded(outcome: Outcome) -> Ending {
        Ending::Recorded(Record {
            case: 0,
            untouched: Vec::new(),
            holes: Vec::new(),
            outcome,
        })
    }

    #[test]
    fn every_end_has_its_sentence_and_its_kind() {
        let panicked = recorded(Outcome::Panicked {
            message: "index out of bounds:\n\x1b the len is 2 but the index is 3\n".into(),
            location: "stages/intersect/src/triangle.rs:19".into(),
            call: 4,
        });
        let closed = recorded(Outcome::Panicked {
            message: "failed printing to stdout: Broken pipe (os error 32)".into(),
            location: "/rustc/59807/library/std/src/io/stdio.rs:1165".into(),
            call: 149,
        });
        let too_often = recorded(Outcome::CalledTooOften {
            function: "camera_ray".into(),
            times: 1_000_000,
            asked_for: "16 samples".into(),
            call: 0,
        });
        let timed_out = Ending::TimedOut {
            call: 2,
            limit_ms: 500,
            waited: false,
        };
        let waiting = Ending::TimedOut {
            call: 2,
            limit_ms: 500,
            waited: true,
        };
        let died = |how, call| Ending::Died { how, call };
        for (ending, kind, sentence) in [
            (
                closed,
                CrashKind::Ended,
                "printed more than 4 GB in this run, so `println!` panicked: print less (call 149 of the case)",
            ),
            (
                panicked,
                CrashKind::Panic,
                "panicked at stages/intersect/src/triangle.rs:19: index out of bounds: the len is 2 but the index is 3 (call 4 of the case)",
            ),
            (
                too_often,
                CrashKind::Endless,
                "called camera_ray 1,000,000 times, was asked for 16 samples: an endless loop? (call 0 of the case)",
            ),
            (
                timed_out,
                CrashKind::Endless,
                "did not return in many times the time of correct code: too much work, or an endless loop? (call 2 of the case)",
            ),
            (
                waiting,
                CrashKind::Endless,
                "did not return in many times the time of correct code, and waited for most of it: does it sleep, or wait for a lock or a thread? (call 2 of the case)",
            ),
            (
                Ending::PrintedTooMuch { call: 1 },
                CrashKind::Endless,
                "printed more than 5,000,000 times in one call: an endless loop? (call 1 of the case)",
            ),
            (
                Ending::ChangedCounts("in call 3 it counts 1".into()),
                CrashKind::Ended,
                "changed the grader's counts of its tests: in call 3 it counts 1",
            ),
            (
                Ending::OutOfTime,
                CrashKind::Endless,
                "was not run to its end: with it, the cases of this task or of all tasks take many times the time of correct code: does it sleep or wait?",
            ),
            (
                Ending::TooManyThreads { call: 3 },
                CrashKind::Endless,
                "started more than a hundred threads at once: join them, or start one for each processor (call 3 of the case)",
            ),
            (
                died(Death::StackOverflow, Some(7)),
                CrashKind::Endless,
                "overflowed the stack of 64 MB: a recursion without end? (call 7 of the case)",
            ),
            (
                died(Death::Abort, None),
                CrashKind::Ended,
                "aborted the whole program (SIGABRT): does it call `std::process::abort`?",
            ),
        ] {
            let crash = Crash::of(&ending).expect("it crashed");
            assert_eq!((crash.kind, crash.to_string()), (kind, sentence.into()));
        }
        assert_eq!(Crash::of(&Ending::Skipped), None);
    }

    #[test]
    fn the_input_is_part_of_the_call() {
        let mut ended = Crash {
            call: Some(4),
            input: Some("Ray: o = 0".into()),
            ..Crash::from("panicked")
        };
        assert_eq!(
            ended.to_string(),
            "panicked (call 4 of the case: Ray: o = 0)"
        );
        assert_eq!(
            ended.without_input().to_string(),
            "panicked (call 4 of the case)"
        );
        ended.call = None;
        assert_eq!(ended.to_string(), "panicked");
    }

    #[test]
    fn a_panic_has_a_place() {
        for (location, file, line) in [
            (
                "stages/bvh/src/traverse.rs:19",
                "stages/bvh/src/traverse.rs",
                19,
            ),
            ("stages/bvh/src/lib.rs:4:5", "stages/bvh/src/lib.rs", 4),
            ("C:\\bvh\\src\\lib.rs:4", "C:\\bvh\\src\\lib.rs", 4),
            ("C:\\bvh\\src\\lib.rs:4:5", "C:\\bvh\\src\\lib.rs", 4),
        ] {
            assert_eq!(place(location), Some((file.to_owned(), line)), "{location}");
        }
        assert_eq!(place("nowhere"), None);
    }
}
