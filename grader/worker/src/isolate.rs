//! One case apart from the rest: panics and holes become outcomes.

use kit::hole::Hole;
use std::any::Any;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU32, Ordering};
use wire::{Answer, Outcome};

/// The call into the student's code that is running, counted from 0 in its case.
static CALL: AtomicU32 = AtomicU32::new(0);

thread_local! {
    static PANIC_LOCATION: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Notes that the case's call number `index` begins.
pub(crate) fn call(index: usize) {
    CALL.store(u32::try_from(index).unwrap_or(u32::MAX), Ordering::Relaxed);
}

/// Which call of the case is running, counted from 0.
pub fn current_call() -> u32 {
    CALL.load(Ordering::Relaxed)
}

/// Makes panics silent and remembers where they were: the grader tells of them itself.
pub fn watch_panics() {
    std::panic::set_hook(Box::new(|info| {
        let location = info
            .location()
            .map(|l| format!("{}:{}", l.file(), l.line()))
            .unwrap_or_default();
        PANIC_LOCATION.with_borrow_mut(|slot| *slot = location);
    }));
}

/// Runs `work` and says how it ended.
pub(crate) fn outcome(work: impl FnOnce() -> Result<Answer, String>) -> Outcome {
    call(0);
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(answer)) => Outcome::Answered(answer),
        Ok(Err(reason)) => Outcome::Unable { reason },
        Err(payload) => match payload.downcast_ref::<Hole>() {
            Some(hole) => Outcome::NotAttempted {
                task: hole.task.to_string(),
            },
            None => Outcome::Panicked {
                message: message(&*payload),
                location: PANIC_LOCATION.take(),
                call: current_call(),
            },
        },
    }
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without a message".into())
}
