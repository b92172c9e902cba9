//! Golden images and hit-record snapshots.
//!
//! The data is in the folders beside `src`, one per task: `<task>/<case>.snap` contains the
//! reference's answers to a case, `<task>/<case>.png` its picture. Students are graded against
//! these files.
//!
//! `tests/goldens.rs` checks that they equal the answers of the reference and that the exact oracle
//! finds nothing wrong in them; `<task>/not_judged.txt` lists what it does not judge.
//! `tests/mistakes.rs` plants mistakes, which the oracle must find. `grader review` shows how a
//! change of the reference changes the goldens, and `grader bless` stores the new answers.
//!
//! A snapshot of a case with many calls, a picture for example, has a sample of its rows and a hash
//! of all; `judge::snapshot` describes the form. `grader mutants TASK --bless` makes `signatures`
//! and `mutants`, which are packed; `grader mutants TASK --stored` prints them as text.
