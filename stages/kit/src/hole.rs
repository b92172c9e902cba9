//! Holes: tasks that are not written yet.
//!
//! [`hole!`](crate::hole!) stands where a solution is to go. It unwinds with a [`Hole`] as its payload, so the
//! grader can say *not attempted*. [`untouched!`](crate::untouched!) stands where the course gives a slow but
//! working start: it leaves a mark and goes on.

use std::cell::RefCell;

/// What a hole unwinds with: the key of the task, such as `part1.task3`.
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

/// Stops here because the task is not written yet. What [`hole!`](crate::hole!) calls.
#[cold]
pub fn stop(task: &'static str) -> ! {
    std::panic::panic_any(Hole { task })
}

thread_local! {
    static UNTOUCHED: RefCell<Vec<&'static str>> = const { RefCell::new(Vec::new()) };
}

/// Notes that the given start of a task ran on this thread. What [`untouched!`](crate::untouched!) calls.
pub fn mark(task: &'static str) {
    UNTOUCHED.with_borrow_mut(|marks| {
        if !marks.contains(&task) {
            marks.push(task);
        }
    });
}

/// The tasks whose given start ran on this thread since the last call.
pub fn take_marks() -> Vec<&'static str> {
    UNTOUCHED.take()
}

/// `hole!("part1.task3", tri, ray)`: a task that is not written yet. Takes its arguments, so that
/// the compiler does not call them unused, and never returns.
#[macro_export]
macro_rules! hole {
    ($task:literal $(, $argument:expr)* $(,)?) => {{
        $( let _ = &$argument; )*
        $crate::hole::stop($task)
    }};
}

/// `untouched!("part2.task1")`: the code below is the start that the course gives.
#[macro_export]
macro_rules! untouched {
    ($task:literal) => {
        $crate::hole::mark($task)
    };
}
