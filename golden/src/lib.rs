//! Golden images and hit-record snapshots.
//!
//! The data is in the folders beside `src`, one a task: `<task>/<case>.snap` is what the reference
//! answers to a case, `<task>/<case>.png` the picture it makes. Students are graded against these
//! very files; `tests/goldens.rs` keeps them true to the reference and to the exact oracle, `cargo
//! insta review` shows what a change of the reference does to them, and `grader bless` takes it
//! over.
