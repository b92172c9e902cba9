//! Runs one case in isolation: panics and holes become outcomes.

use crate::call_limit::CalledTooOften;
use crate::caller;
use kit::hole::Hole;
use std::any::Any;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::Read;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, OnceLock};
use wire::file::FrameWriter;
use wire::question::{Question, Reply, read_reply};
use wire::record::{HoleCall, shortened};
use wire::{Answer, Case, Outcome, Record, RecordFrame, Work};

/// The case that is running.
static CASE: AtomicU32 = AtomicU32::new(0);

/// The call of the student's code that is running, counted from 0 in its case.
static CALL: AtomicU32 = AtomicU32::new(0);

/// The writer of records, if each call is written to it.
static CALLS: OnceLock<&Mutex<FrameWriter>> = OnceLock::new();

/// Where questions are written, and where the replies arrive.
struct Questions {
    records: &'static Mutex<FrameWriter>,
    replies: Mutex<Box<dyn Read + Send>>,
}

/// The questions of this worker.
static QUESTIONS: OnceLock<Questions> = OnceLock::new();

thread_local! {
    static PANIC_LOCATION: RefCell<String> = const { RefCell::new(String::new()) };

    /// The task of the case that runs on this thread, and its holes so far.
    static HOLES: RefCell<(String, Vec<HoleCall>)> =
        const { RefCell::new((String::new(), Vec::new())) };

    /// The order of the calls of the case that runs on this thread, as the case has it.
    static ORDER: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };

    /// For each place of a `todo!()` that this case ran into, the function that is written there.
    static GAPS: RefCell<BTreeMap<String, String>> = const { RefCell::new(BTreeMap::new()) };
}

/// Calls the function `called` of the case's task, and returns its answer; `None` if it is not
/// written yet, or calls one that is not. Then it is in the record's list of holes and is not
/// called again in this case, so that the other functions can still be judged.
///
/// A hole of another task ends the case.
pub fn attempt<T>(called: &str, function: impl FnOnce() -> T) -> Option<T> {
    if is_hole(called) {
        return None;
    }
    match catch_unwind(AssertUnwindSafe(function)) {
        Ok(answer) => Some(answer),
        Err(payload) => {
            note_hole(called, payload);
            None
        }
    }
}

// What does not depend on the type of the answer is compiled once.

/// Whether a call of the function `called` has run into a hole in this case.
fn is_hole(called: &str) -> bool {
    HOLES.with_borrow(|(_, holes)| holes.iter().any(|hole| hole.called == called))
}

/// Notes the hole that a call of the function `called` ended at, if that is one of the case's task.
/// Otherwise unwinds with `payload`.
fn note_hole(called: &str, payload: Box<dyn Any + Send>) {
    let of_task = HOLES.with_borrow_mut(|(task, holes)| {
        let hole = match payload.downcast_ref::<Hole>() {
            Some(hole) => (hole.task == task).then(|| hole.function.to_string())?,
            None => is_gap(&*payload).then(|| function_with_gap(called))?,
        };
        holes.push(HoleCall {
            called: called.to_string(),
            hole,
        });
        Some(())
    });
    if of_task.is_none() {
        resume_unwind(payload);
    }
}

/// Whether the code ran into `todo!()` or `unimplemented!()`: it is not written yet.
fn is_gap(payload: &(dyn Any + Send)) -> bool {
    let beginnings = ["not yet implemented", "not implemented"];
    let message = message(payload);
    beginnings.iter().any(|words| message.starts_with(words))
}

/// The function that the gap is in at which the call of `called` just ended: the first of this case
/// that ended there. A worker calls a function before those that call it.
fn function_with_gap(called: &str) -> String {
    let location = PANIC_LOCATION.take();
    GAPS.with_borrow_mut(|gaps| {
        let function = gaps.entry(location).or_insert_with(|| called.to_string());
        function.clone()
    })
}

/// Makes a call for each of the `questions`, in the order that the case has, and returns the answers
/// in the order of the questions.
pub fn each_call<Q, A>(questions: &[Q], mut answer: impl FnMut(usize, &Q) -> A) -> Vec<A> {
    let mut places = order_of(questions.len());
    let mut answers = Vec::with_capacity(places.len());
    for &i in &places {
        call(i);
        answers.push(answer(i, &questions[i]));
    }
    // Back to the order of the questions, without the code that sorts each type of answer.
    for at in 0..places.len() {
        while places[at] != at {
            let place = places[at];
            answers.swap(at, place);
            places.swap(at, place);
        }
    }
    answers
}

/// The indices below `count`, in the order in which the case makes its calls.
fn order_of(count: usize) -> Vec<usize> {
    ORDER.with_borrow(|order| match order.len() == count {
        true => order.iter().map(|&i| i as usize).collect(),
        false => Vec::from_iter(0..count),
    })
}

/// Records the start of call number `index` of the case, counted from 0.
pub fn call(index: usize) {
    let call = u32::try_from(index).unwrap_or(u32::MAX);
    CALL.store(call, Ordering::Relaxed);
    if let Some(Ok(mut records)) = CALLS.get().map(|records| records.lock()) {
        let case = CASE.load(Ordering::Relaxed);
        // If the entry is lost, the report does not say which call ended the worker.
        let _ = records.write(&RecordFrame::Calling { case, call });
    }
}

/// Asks the grader for the result of a test of the running call: the worker does not know it. Without
/// a reply the process ends: the grader is gone, or the student's code has read the reply.
pub fn ask(question: Question) -> Reply {
    let ask = || {
        let Questions { records, replies } = QUESTIONS.get()?;
        let mut replies = replies.lock().ok()?;
        let frame = RecordFrame::Asking {
            case: CASE.load(Ordering::Relaxed),
            call: current_call(),
            question,
        };
        records.lock().ok()?.write(&frame).ok()?;
        read_reply(&mut *replies).ok()
    };
    ask().unwrap_or_else(|| std::process::abort())
}

/// Sends the questions of [`ask`] with the records, and reads the replies from `replies`.
pub(crate) fn ask_through(records: &'static Mutex<FrameWriter>, replies: Box<dyn Read + Send>) {
    let replies = Mutex::new(replies);
    let _ = QUESTIONS.set(Questions { records, replies });
}

/// Writes an entry to `records` for each call from now on, so that they show which call ended the
/// worker.
pub(crate) fn write_calls(records: &'static Mutex<FrameWriter>) {
    let _ = CALLS.set(records);
}

/// The call of the case that is running, counted from 0.
pub(crate) fn current_call() -> u32 {
    CALL.load(Ordering::Relaxed)
}

/// Makes panics silent and keeps their location for the record. Call it on the main thread: a panic
/// on that thread is a defect of the worker, and ends it before anything of the student's is called.
pub(crate) fn watch_panics() {
    let main = std::thread::current().id();
    std::panic::set_hook(Box::new(move |info| {
        if std::thread::current().id() == main {
            std::process::abort();
        }
        let location = info
            .location()
            .map(|l| format!("{}:{}", l.file(), l.line()))
            .unwrap_or_default();
        let location = match caller::of_panic(&location) {
            Some(line) => format!("{line} (in the standard library, which it calls)"),
            None => location,
        };
        PANIC_LOCATION.with_borrow_mut(|slot| *slot = location);
    }));
}

/// Runs case number `index`. `dispatch` calls the stages and returns their answer, or an error if
/// this worker cannot run the work.
pub fn run(index: u32, case: &Case, dispatch: impl Fn(&Work) -> Result<Answer, String>) -> Record {
    let _ = kit::hole::take_marks();
    HOLES.set((case.task.clone(), Vec::new()));
    GAPS.take();
    ORDER.set(case.order.clone());
    CASE.store(index, Ordering::Relaxed);
    let outcome = outcome(&case.task, &|| dispatch(&case.work));
    let untouched = kit::hole::take_marks();
    let (task, mut holes) = HOLES.take();
    let of_task = untouched.iter().filter(|start| start.task == task);
    holes.extend(of_task.map(|start| HoleCall {
        called: start.function.to_string(),
        hole: start.function.to_string(),
    }));
    Record {
        case: index,
        untouched: untouched.iter().map(|start| start.task.into()).collect(),
        holes,
        outcome,
    }
}

fn outcome(task: &str, work: &dyn Fn() -> Result<Answer, String>) -> Outcome {
    call(0);
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(answer)) => Outcome::Answered(answer),
        Ok(Err(reason)) => Outcome::Unable { reason },
        Err(payload) => {
            let outcome = unwound(task, &*payload);
            discard(payload);
            outcome
        }
    }
}

/// Drops a payload. Its `Drop` is the student's code, and may panic, too: that payload is not
/// dropped.
fn discard(payload: Box<dyn Any + Send>) {
    if let Err(second) = catch_unwind(AssertUnwindSafe(|| drop(payload))) {
        std::mem::forget(second);
    }
}

/// The outcome of work for `task` that unwound with this payload.
fn unwound(task: &str, payload: &(dyn Any + Send)) -> Outcome {
    if is_gap(payload) {
        return Outcome::NotAttempted {
            task: task.to_string(),
        };
    }
    if let Some(hole) = payload.downcast_ref::<Hole>() {
        return Outcome::NotAttempted {
            task: hole.task.to_string(),
        };
    }
    if let Some(calls) = payload.downcast_ref::<CalledTooOften>() {
        return Outcome::CalledTooOften {
            function: calls.function.to_string(),
            times: calls.times,
            asked_for: calls.asked_for.clone(),
            call: current_call(),
        };
    }
    Outcome::Panicked {
        message: message(payload),
        location: PANIC_LOCATION.take(),
        call: current_call(),
    }
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    shortened(text.unwrap_or("a panic without a message")).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::{BoxWork, Probe, Ray};

    /// The record of a case of `task` in which `dispatch` calls functions.
    fn record(task: &str, dispatch: impl Fn()) -> Record {
        let ray = Ray {
            o: [0.0; 3],
            d: [0.0; 3],
            min_t: 0.0,
            max_t: 0.0,
        };
        let case = Case {
            task: task.into(),
            name: String::new(),
            limit_ms: 1,
            work: Work::Boxes(BoxWork {
                boxes: Vec::new(),
                probes: vec![Probe { shape: 0, ray }],
            }),
            order: Vec::new(),
        };
        run(0, &case, |_| {
            dispatch();
            Ok(Answer::Boxes(Vec::new()))
        })
    }

    fn unwritten() -> u32 {
        kit::hole!("part1.task3")
    }

    fn hole(called: &str, hole: &str) -> HoleCall {
        HoleCall {
            called: called.into(),
            hole: hole.into(),
        }
    }

    #[test]
    fn calls_are_made_in_the_order_of_the_case_and_answered_in_that_of_the_question() {
        for (order, made) in [
            (vec![2, 0, 1], ["c", "a", "b"]),
            (Vec::new(), ["a", "b", "c"]),
            // That of another list.
            (vec![1, 0], ["a", "b", "c"]),
        ] {
            ORDER.set(order);
            let mut called = Vec::new();
            let answers = each_call(&["a", "b", "c"], |i, question| {
                called.push(*question);
                (i, current_call())
            });
            assert_eq!(
                (answers, called),
                (vec![(0, 0), (1, 1), (2, 2)], made.to_vec())
            );
        }
    }

    #[test]
    fn a_hole_of_one_function_leaves_the_others() {
        let record = record("part1.task3", || {
            assert_eq!(attempt("first", || 1), Some(1));
            assert_eq!(attempt("second", unwritten), None);
            assert_eq!(attempt("unwritten", unwritten), None);
            // Not called again.
            assert_eq!(attempt("second", || 2), None);
        });
        assert!(matches!(record.outcome, Outcome::Answered(_)), "{record:?}");
        let holes = [hole("second", "unwritten"), hole("unwritten", "unwritten")];
        assert_eq!(record.holes, holes);
    }

    #[test]
    fn todo_is_a_hole_of_the_function_that_is_called_first() {
        fn begun() -> u32 {
            unimplemented!("no sphere yet")
        }
        // Not the macro `todo!`, of which clippy warns: this is its message.
        let planned = || -> u32 { panic!("not yet implemented: {}", "slivers") };
        let record = record("part1.task3", || {
            assert_eq!(attempt("test", begun), None);
            assert_eq!(attempt("intersect", || begun() + 1), None);
            assert_eq!(attempt("record", planned), None);
            assert_eq!(attempt("other", || 4), Some(4));
        });
        assert!(matches!(record.outcome, Outcome::Answered(_)), "{record:?}");
        let names: Vec<&str> = record
            .holes
            .iter()
            .map(|hole| hole.called.as_str())
            .collect();
        assert_eq!(names, ["test", "intersect", "record"]);
        // A whole case that runs into one is not attempted.
        let whole = self::record("part1.task3", || {
            begun();
        });
        let task = "part1.task3".to_string();
        assert_eq!(whole.outcome, Outcome::NotAttempted { task });
    }

    #[test]
    fn holes_are_those_of_one_case() {
        record("part1.task3", || {
            attempt("first", unwritten);
        });
        let next = record("part1.task3", || {
            assert_eq!(attempt("first", || 3), Some(3))
        });
        assert_eq!(next.holes, []);
    }

    #[test]
    fn a_hole_of_another_task_and_a_panic_end_the_case() {
        let other = record("part2.task3", || {
            attempt("first", unwritten);
        });
        let task = "part1.task3".to_string();
        assert_eq!(other.outcome, Outcome::NotAttempted { task });
        assert_eq!(other.holes, []);
        let panicked = record("part1.task3", || {
            attempt("first", || panic!("too small"));
        });
        assert!(matches!(panicked.outcome, Outcome::Panicked { .. }));
    }

    #[test]
    fn a_payload_that_panics_when_it_is_dropped_is_one_panic() {
        struct Payload(u32);
        impl Drop for Payload {
            fn drop(&mut self) {
                if self.0 > 0 {
                    std::panic::panic_any(Payload(self.0 - 1));
                }
            }
        }
        let panicked = record("part1.task3", || std::panic::panic_any(Payload(2)));
        assert!(matches!(panicked.outcome, Outcome::Panicked { .. }));
        let next = record("part1.task3", || ());
        assert!(matches!(next.outcome, Outcome::Answered(_)));
    }

    #[test]
    fn a_provided_start_is_a_hole_of_its_function() {
        fn traverse() {
            kit::untouched!("part2.task3");
        }
        let record = record("part2.task3", traverse);
        assert_eq!(record.untouched, ["part2.task3"]);
        assert_eq!(record.holes, [hole("traverse", "traverse")]);
    }
}
