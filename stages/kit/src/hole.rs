//! Placeholders for tasks that are not written yet.
//!
//! [`hole!`](crate::hole!) stands in place of a solution. It unwinds with a [`Hole`] as its
//! payload, and the grader reports the task as *not attempted*. [`untouched!`](crate::untouched!)
//! marks a slow but working start that the course provides: it records the task and continues.

use std::cell::RefCell;

/// A function that is not written yet: the payload with which a hole unwinds.
///
/// ```
/// let hole = kit::hole::Hole { task: "part1.task3", function: "test_triangle" };
/// assert_eq!(hole.to_string(), "part1.task3 is not written yet");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Hole {
    /// Key of the task in `course.toml`, such as `part1.task3`.
    pub task: &'static str,
    /// Name of the function that contains the hole, without its path. Only for reports: it comes
    /// from [`std::any::type_name_of_val`], which promises no format.
    pub function: &'static str,
}

impl std::fmt::Display for Hole {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} is not written yet", self.task)
    }
}

impl Hole {
    /// The hole of `task` in the function that contains the item with the path `inside`.
    fn new(task: &'static str, inside: &'static str) -> Hole {
        let mut path = inside.rsplit("::").skip(1);
        let function = path.find(|name| !name.starts_with('{')).unwrap_or(inside);
        Hole { task, function }
    }
}

/// Unwinds with the [`Hole`] of `task`. `inside` is the path of an item in the function. Called by
/// [`hole!`](crate::hole!), whose place a test that fails shows.
#[cold]
#[track_caller]
pub fn stop(task: &'static str, inside: &'static str) -> ! {
    std::panic::panic_any(Hole::new(task, inside))
}

thread_local! {
    static UNTOUCHED: RefCell<Vec<Hole>> = const { RefCell::new(Vec::new()) };
}

/// Records that the provided start of a task ran on this thread. `inside` is the path of an item
/// in the function. Called by [`untouched!`](crate::untouched!).
pub fn mark(task: &'static str, inside: &'static str) {
    UNTOUCHED.with_borrow_mut(|marks| {
        let hole = Hole::new(task, inside);
        if !marks.contains(&hole) {
            marks.push(hole);
        }
    });
}

/// Returns and clears the functions whose provided start ran on this thread since the last call.
pub fn take_marks() -> Vec<Hole> {
    UNTOUCHED.take()
}

/// `hole!("part1.task3", tri, ray)`: marks a task that is not written yet. Never returns. Uses its
/// arguments, so that the compiler does not report them as unused.
#[macro_export]
macro_rules! hole {
    ($task:literal $(, $argument:expr)* $(,)?) => {{
        $( let _ = &$argument; )*
        fn here() {}
        $crate::hole::stop($task, ::std::any::type_name_of_val(&here))
    }};
}

/// `untouched!("part2.task1")`: marks the code below as the start that the course provides.
#[macro_export]
macro_rules! untouched {
    ($task:literal) => {{
        fn here() {}
        $crate::hole::mark($task, ::std::any::type_name_of_val(&here))
    }};
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::catch_unwind;

    fn unwritten(x: f64) -> f64 {
        crate::hole!("part1.task3", x)
    }

    fn with_a_start() {
        [1].iter().for_each(|_| crate::untouched!("part2.task1"));
    }

    #[test]
    fn a_hole_names_the_function_that_contains_it() {
        let caught = catch_unwind(|| unwritten(1.0)).expect_err("it unwinds");
        let hole = caught.downcast_ref::<Hole>().expect("with a hole");
        assert_eq!((hole.task, hole.function), ("part1.task3", "unwritten"));
    }

    #[test]
    fn a_start_names_the_function_around_its_closure() {
        with_a_start();
        let marks = take_marks();
        let [Hole { task, function }] = marks[..] else {
            panic!("{marks:?}")
        };
        assert_eq!((task, function), ("part2.task1", "with_a_start"));
        assert_eq!(take_marks(), []);
    }
}
