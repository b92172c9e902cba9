//! Placeholders for tasks that are not written yet.
//!
//! [`hole!`](crate::hole!) stands in place of a solution. It unwinds with a [`Hole`] as its
//! payload, and the grader reports the task as *not attempted*. [`untouched!`](crate::untouched!)
//! marks a slow but working start that the course provides: it records the task and continues.

use std::cell::RefCell;

/// The payload with which a hole unwinds: the key of the task, such as `part1.task3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hole {
    /// Key of the task in `course.toml`.
    pub task: &'static str,
}

impl std::fmt::Display for Hole {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} is not written yet", self.task)
    }
}

/// Unwinds with the [`Hole`] of `task`. Called by [`hole!`](crate::hole!), whose place a test that
/// fails shows.
#[cold]
#[track_caller]
pub fn stop(task: &'static str) -> ! {
    std::panic::panic_any(Hole { task })
}

thread_local! {
    static UNTOUCHED: RefCell<Vec<&'static str>> = const { RefCell::new(Vec::new()) };
}

/// Records that the provided start of a task ran on this thread. Called by
/// [`untouched!`](crate::untouched!).
pub fn mark(task: &'static str) {
    UNTOUCHED.with_borrow_mut(|marks| {
        if !marks.contains(&task) {
            marks.push(task);
        }
    });
}

/// Returns and clears the tasks whose provided start ran on this thread since the last call.
pub fn take_marks() -> Vec<&'static str> {
    UNTOUCHED.take()
}

/// `hole!("part1.task3", tri, ray)`: marks a task that is not written yet. Never returns. Uses its
/// arguments, so that the compiler does not report them as unused.
#[macro_export]
macro_rules! hole {
    ($task:literal $(, $argument:expr)* $(,)?) => {{
        $( let _ = &$argument; )*
        $crate::hole::stop($task)
    }};
}

/// `untouched!("part2.task1")`: marks the code below as the start that the course provides.
#[macro_export]
macro_rules! untouched {
    ($task:literal) => {
        $crate::hole::mark($task)
    };
}
