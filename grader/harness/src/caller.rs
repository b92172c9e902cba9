//! The line of the student's code that called a function of the standard library which panicked.
//!
//! A panic names its own place. Functions without `#[track_caller]`, such as `sort_by` and
//! `step_by`, panic in a file of the standard library, which helps nobody. A backtrace has the
//! caller, if the program has the tables of its lines: a student's own run has, a submission has
//! not, and keeps the place in the library.

use std::backtrace::Backtrace;

/// Where a panic at `location` comes from, as "FILE:LINE"; `None` if the location says so itself,
/// or nothing is known of the caller.
pub(crate) fn of_panic(location: &str) -> Option<String> {
    is_of_library(location).then(|| first_caller(&Backtrace::force_capture().to_string()))?
}

/// Whether a path is one of the standard library, as it was compiled or as it is installed.
fn is_of_library(path: &str) -> bool {
    path.starts_with("/rustc/") || path.contains("/rustlib/src/rust/")
}

/// The first line of a backtrace that is neither the library's nor given. The library has no other
/// form of a backtrace than its text: below each function, "at FILE:LINE:COLUMN".
fn first_caller(backtrace: &str) -> Option<String> {
    let places = backtrace
        .lines()
        .filter_map(|line| line.trim().strip_prefix("at "));
    let is_given = |path: &str| GIVEN.iter().any(|given| path.contains(given));
    let mut callers = places.filter(|path| !is_of_library(path) && !is_given(path));
    let (place, _column) = callers.next()?.rsplit_once(':')?;
    // Below the root folder of the workspace, as the compiler names files.
    let start = place.find("/stages/").map_or(0, |at| at + 1);
    Some(place[start..].trim_start_matches("./").to_owned())
}

/// Given code that calls functions of the library for the student's, and that of this crate.
const GIVEN: [&str; 3] = ["stages/kit/", "stages/lanes/", "grader/harness/"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_caller_is_the_first_line_outside_the_library() {
        let text = "   0: harness::caller::of_panic
             at ./grader/harness/src/caller.rs:14:5
   1: core::slice::sort::shared::smallsort::bidirectional_merge
             at /rustc/0f1/library/core/src/slice/sort/shared/smallsort.rs:860:9
   2: kit::sort_all
             at ./stages/kit/src/sort.rs:9:5
   3: bvh::construct::halves
             at /home/me/course/stages/bvh/src/construct.rs:33:9
   4: worker::bvh::build
             at ./grader/worker/src/bvh.rs:7:1";
        let line = Some("stages/bvh/src/construct.rs:33".to_owned());
        assert_eq!(first_caller(text), line);
        assert_eq!(first_caller("   0: <unknown>\n   1: bvh::construct"), None);
        let installed = "/x/lib/rustlib/src/rust/library/core/src/iter/adapters/step_by.rs:35";
        assert!(is_of_library(installed) && !is_of_library("stages/bvh/src/lib.rs:3"));
        assert_eq!(of_panic("stages/bvh/src/lib.rs:3"), None);
    }
}
