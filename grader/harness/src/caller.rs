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
    path.starts_with("/rustc/") || path.contains("/rustlib/src/rust/library/")
}

/// The first line of a backtrace in the code of a stage that is not given. The library has no other
/// form of a backtrace than its text: below each function, "at FILE:LINE:COLUMN".
fn first_caller(backtrace: &str) -> Option<String> {
    let places = backtrace
        .lines()
        .filter_map(|line| line.trim().strip_prefix("at "));
    // Below the root folder of the workspace, as the compiler names files.
    let mut of_stages = places.filter_map(|place| Some(&place[place.rfind(STAGES)? + 1..]));
    let is_given = |place: &str| GIVEN.iter().any(|given| place.starts_with(given));
    let (line, _column) = of_stages.find(|place| !is_given(place))?.rsplit_once(':')?;
    Some(line.to_owned())
}

/// The folder of the stages.
const STAGES: &str = "/stages/";

/// Given code that calls functions of the library for the student's.
const GIVEN: [&str; 2] = ["stages/kit/", "stages/lanes/"];

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
   4: driver::bvh::build
             at ./grader/driver/src/bvh.rs:7:1";
        let line = Some("stages/bvh/src/construct.rs:33".to_owned());
        assert_eq!(first_caller(text), line);
        assert_eq!(first_caller("   0: <unknown>\n   1: bvh::construct"), None);
        // Other code has lines, too, where that of the stages has none.
        let others = "at ./rustc/0f1/library/core/src/bool.rs:66:5\nat csu/../nptl/start.h:58:3";
        assert_eq!(first_caller(others), None);
        let installed = "/x/lib/rustlib/src/rust/library/core/src/iter/adapters/step_by.rs:35";
        assert!(is_of_library(installed) && !is_of_library("stages/bvh/src/lib.rs:3"));
        assert_eq!(of_panic("stages/bvh/src/lib.rs:3"), None);
    }
}
