//! Reads and validates a worker's records. The student's code runs in the worker, so they are
//! untrusted.
//!
//! Everything is validated here, once: that the bytes are frames with the key of this run
//! ([`wire::file::FrameReader`]), that the cases start and end in order, that each answer has the
//! form that its case requires ([`judge::fits`]). An invalid record fails the case that was running
//! and ends the reading; the records before it count.

use crate::workers::death::Death;
use crate::workers::runner::{self, Ending};
use std::borrow::Cow;
use wire::record::shortened;
use wire::{Case, Excess, Outcome, Record, RecordFrame};

/// The endings that the records of one worker contain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Records {
    /// How the cases from the first one on ended, in order.
    pub endings: Vec<Ending>,
    /// Whether the next case started and has no end: it ended the worker.
    pub next_began: bool,
    /// The call of the next case that started last, if the worker records calls.
    pub call: Option<u32>,
}

impl Records {
    /// Whether everything that was read is what a worker writes.
    pub fn is_in_order(&self) -> bool {
        let last = self.endings.last();
        !matches!(last, Some(Ending::Malformed(_) | Ending::ChangedCounts(_)))
    }
}

/// Reads the records of a worker that runs `cases` from number `first` on.
pub fn read(
    frames: impl Iterator<Item = Result<RecordFrame, String>>,
    cases: &[Case],
    first: usize,
) -> Records {
    let mut records = Records::default();
    for frame in frames {
        let next = first + records.endings.len();
        let Some(case) = cases.get(next) else {
            // Every case has ended: ignore what follows.
            break;
        };
        let began = records.next_began;
        let is_next = |number: u32| number as usize == next;
        let ending = match frame {
            Ok(RecordFrame::Started { case }) if is_next(case) && !began => {
                records.next_began = true;
                continue;
            }
            Ok(RecordFrame::Spent { case, .. }) if is_next(case) && began => continue,
            Ok(RecordFrame::Calling { case, call }) if is_next(case) && began => {
                records.call = Some(call);
                continue;
            }
            Ok(RecordFrame::Done(record)) if is_next(record.case) && began => ending(case, record),
            Ok(RecordFrame::TimedOut { case: number, call }) if is_next(number) && began => {
                Ending::TimedOut {
                    call,
                    limit_ms: case.limit_ms,
                    waited: false,
                }
            }
            Ok(RecordFrame::PrintedTooMuch { case, call }) if is_next(case) && began => {
                Ending::PrintedTooMuch { call }
            }
            Ok(RecordFrame::TookTooMuch {
                case: number,
                call,
                what,
            }) if is_next(number) && began => match what {
                Excess::Threads => Ending::TooManyThreads { call },
                Excess::Waiting => Ending::TimedOut {
                    call,
                    limit_ms: case.limit_ms,
                    waited: true,
                },
                Excess::Memory => Ending::Died {
                    how: Death::OutOfMemory {
                        limit_mb: runner::memory_mb(cases),
                        asked_for: None,
                    },
                    call: Some(call),
                },
            },
            Ok(frame) => cannot_be_read(&out_of_order(&frame, next, began)),
            Err(why) => cannot_be_read(&why),
        };
        let goes_on = matches!(ending, Ending::Recorded(_));
        records.endings.push(ending);
        (records.next_began, records.call) = (false, None);
        if !goes_on {
            break;
        }
    }
    records
}

/// The ending of a case whose record is in order; validates its answer.
fn ending(case: &Case, mut record: Record) -> Ending {
    if let Outcome::Answered(answer) = &record.outcome
        && let Err(why) = judge::fits(&case.work, answer)
    {
        return Ending::Malformed(format!("the worker's record does not fit the case: {why}"));
    }
    shorten_texts(&mut record);
    Ending::Recorded(record)
}

/// The most functions of a record that are kept: no task has as many.
const MOST_FUNCTIONS: usize = 32;

/// Cuts what the student's code can make as long as it likes: the records of all cases are kept at
/// once, and the report shows them.
fn shorten_texts(record: &mut Record) {
    record.untouched.truncate(MOST_FUNCTIONS);
    record.untouched.iter_mut().for_each(shorten);
    record.holes.truncate(MOST_FUNCTIONS);
    for hole in &mut record.holes {
        shorten(&mut hole.called);
        shorten(&mut hole.hole);
    }
    match &mut record.outcome {
        Outcome::Answered(_) => {}
        Outcome::NotAttempted { task: text } | Outcome::Unable { reason: text } => shorten(text),
        Outcome::Panicked {
            message: first,
            location: second,
            ..
        }
        | Outcome::CalledTooOften {
            function: first,
            asked_for: second,
            ..
        } => [first, second].into_iter().for_each(shorten),
    }
}

fn shorten(text: &mut String) {
    if let Cow::Owned(short) = shortened(text) {
        *text = short;
    }
}

fn cannot_be_read(why: &str) -> Ending {
    Ending::Malformed(format!("the worker's record cannot be read: {why}"))
}

/// Describes a frame that is out of order.
fn out_of_order(frame: &RecordFrame, next: usize, began: bool) -> String {
    let (event, case) = match frame {
        RecordFrame::Started { case } => ("begins", case),
        RecordFrame::TimedOut { case, .. } => ("times out", case),
        RecordFrame::PrintedTooMuch { case, .. } => ("prints too much", case),
        RecordFrame::Calling { case, .. } => ("calls", case),
        RecordFrame::TookTooMuch { case, .. } => ("takes too much", case),
        RecordFrame::Spent { case, .. } => ("runs", case),
        // The runner has replied.
        RecordFrame::Asking { case, .. } => ("asks", case),
        RecordFrame::Done(record) => ("ends", &record.case),
    };
    let state = if began { "runs" } else { "is next" };
    format!("case {case} {event} where case {next} {state}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::record::{HoleCall, MOST_OF_TEXT};
    use wire::work::{BoxWork, Probe, Ray};
    use wire::{Answer, Work};

    /// Three cases of two calls each.
    fn cases() -> Vec<Case> {
        let ray = Ray {
            o: [0.0; 3],
            d: [1.0, 0.0, 0.0],
            min_t: 0.0,
            max_t: 1.0,
        };
        let case = |name: &str| Case {
            task: "part2.task2".into(),
            name: name.into(),
            limit_ms: 77,
            work: Work::Boxes(BoxWork {
                boxes: vec![[[0.0; 3], [1.0; 3]]],
                probes: vec![Probe { shape: 0, ray }; 2],
            }),
            order: Vec::new(),
        };
        ["a", "b", "c"].map(case).to_vec()
    }

    fn started(case: u32) -> RecordFrame {
        RecordFrame::Started { case }
    }

    fn answered(case: u32, answer: Answer) -> RecordFrame {
        RecordFrame::Done(Record {
            case,
            untouched: Vec::new(),
            holes: Vec::new(),
            outcome: Outcome::Answered(answer),
        })
    }

    fn done(case: u32) -> RecordFrame {
        answered(case, Answer::Boxes(vec![None; 2]))
    }

    fn read_all(frames: &[RecordFrame]) -> Records {
        read(frames.iter().cloned().map(Ok), &cases(), 0)
    }

    /// The number of cases with a record, and why the next one fails.
    fn summary(frames: &[RecordFrame]) -> (usize, Option<String>) {
        let mut records = read_all(frames);
        let why = records
            .endings
            .pop_if(|last| !matches!(last, Ending::Recorded(_)));
        assert!(
            records
                .endings
                .iter()
                .all(|ending| matches!(ending, Ending::Recorded(_)))
        );
        let why = why.map(|ending| match ending {
            Ending::Malformed(why) => why,
            other => panic!("{other:?}"),
        });
        (records.endings.len(), why)
    }

    #[test]
    fn cases_begin_and_end_in_order() {
        let frames = [
            started(0),
            done(0),
            started(1),
            done(1),
            started(2),
            done(2),
        ];
        assert_eq!(summary(&frames), (3, None));
        assert!(read_all(&frames[..5]).next_began);
        assert!(!read_all(&frames[..4]).next_began);
        let spent = RecordFrame::Spent { case: 0, ms: 7 };
        let reported = [&frames[..1], std::slice::from_ref(&spent), &frames[1..2]].concat();
        assert_eq!(summary(&reported), (1, None));
        assert!(summary(&[spent]).1.is_some());
        let late = [&frames[..1], &[RecordFrame::TimedOut { case: 0, call: 1 }]].concat();
        let limit = Ending::TimedOut {
            call: 1,
            limit_ms: 77,
            waited: false,
        };
        assert_eq!(read_all(&late).endings, [limit]);
    }

    #[test]
    fn the_last_call_of_a_case_without_an_end_is_known() {
        let calling = |call| RecordFrame::Calling { case: 1, call };
        let frames = [started(0), done(0), started(1), calling(0), calling(1)];
        let records = read_all(&frames);
        assert_eq!((records.next_began, records.call), (true, Some(1)));
        let ended = read_all(&[&frames[..], &[done(1), started(2)]].concat());
        assert_eq!((ended.next_began, ended.call), (true, None));
        let printed = [started(0), RecordFrame::PrintedTooMuch { case: 0, call: 1 }];
        let ending = Ending::PrintedTooMuch { call: 1 };
        assert_eq!(read_all(&printed).endings, [ending]);
    }

    #[test]
    fn a_record_out_of_order_fails_the_running_case() {
        let before = [started(0), done(0), started(1)];
        for (wrong, why) in [
            (done(0), "case 0 ends where case 1 runs"),
            (done(2), "case 2 ends where case 1 runs"),
            (done(u32::MAX), "case 4294967295 ends where case 1 runs"),
            (started(1), "case 1 begins where case 1 runs"),
            (
                RecordFrame::TimedOut { case: 9, call: 0 },
                "case 9 times out where case 1 runs",
            ),
        ] {
            let frames = [&before[..], &[wrong, done(1), started(2), done(2)]].concat();
            let why = format!("the worker's record cannot be read: {why}");
            assert_eq!(summary(&frames), (1, Some(why)));
        }
        let unstarted = [started(0), done(0), done(1)];
        let why = "the worker's record cannot be read: case 1 ends where case 1 is next";
        assert_eq!(summary(&unstarted), (1, Some(why.into())));
    }

    #[test]
    fn an_answer_of_another_form_fails_its_case() {
        for (answer, why) in [
            (
                Answer::Boxes(vec![None]),
                "expected 2 answers, one per call, found 1",
            ),
            (
                Answer::Boxes(vec![None; 3]),
                "expected 2 answers, one per call, found 3",
            ),
            (
                Answer::Stop(Vec::new()),
                "it is an answer to another kind of work, Stop",
            ),
        ] {
            let why = format!("the worker's record does not fit the case: {why}");
            assert_eq!(summary(&[started(0), answered(0, answer)]), (0, Some(why)));
        }
    }

    #[test]
    fn long_texts_are_cut() {
        // Longer than the limit below.
        let long = "é".repeat(1 << 18);
        let hole = HoleCall {
            called: long.clone(),
            hole: long.clone(),
        };
        let record = |outcome| {
            RecordFrame::Done(Record {
                case: 0,
                untouched: vec![long.clone(); MOST_FUNCTIONS + 1],
                holes: vec![hole.clone(); MOST_FUNCTIONS + 1],
                outcome,
            })
        };
        for outcome in [
            Outcome::Panicked {
                message: long.clone(),
                location: long.clone(),
                call: 0,
            },
            Outcome::NotAttempted { task: long.clone() },
            Outcome::Unable {
                reason: long.clone(),
            },
            Outcome::CalledTooOften {
                function: long.clone(),
                times: 7,
                asked_for: long.clone(),
                call: 0,
            },
        ] {
            let read = read_all(&[started(0), record(outcome)]);
            let text = format!("{:?}", read.endings);
            assert!(text.contains("é…"), "it is kept in part");
            assert!(
                text.len() < 4 * MOST_OF_TEXT * MOST_FUNCTIONS,
                "{}",
                text.len()
            );
        }
    }

    #[test]
    fn records_after_the_last_case_are_ignored() {
        let all = [
            started(0),
            done(0),
            started(1),
            done(1),
            started(2),
            done(2),
            started(3),
            done(3),
        ];
        assert_eq!(summary(&all), (3, None));
    }
}
