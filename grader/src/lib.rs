//! Scores each stage of the course against exact results, golden images and hit-record snapshots.
//!
//! This crate never links a stage. It builds a *worker* program that links the student's stages,
//! runs the test cases in it, and judges the answers that the worker returns.
//!
//! To follow one run, start at [`grade`] and read on in this order:
//!
//! - [`course`]: the tasks, the cases and their points; the files that students get
//! - [`build`]: compiling the stages; [`workers`]: running the cases in them
//! - the crate [`judge`]: which answers are right
//! - [`score`]: points; [`diagnosis`] and [`signature`]: the likely mistake
//! - [`report`]: the output; [`progress`]: what is known from earlier runs
//!
//! [`cli`] is the command line. [`watch`] grades whenever a file is saved; [`check`] prints what is
//! wrong for editors. [`book`] is the rendered book, which reports link to. [`explain`] draws what
//! a case tests, [`sketch`] a single call; [`examples`] judges those that students write
//! themselves. [`predict`] asks what a student expects, [`gym`] which mistake a picture shows. What
//! does not depend on the course's tasks is in the crate `base`.
//!
//! The tools for instructors are separate crates beside this one: `handout` (what students
//! get), `authoring` (the course check, mutants), `submission` (grading what students hand in),
//! `review` (reviewing and accepting goldens), `cost` (time against accuracy).

pub mod book;
pub mod build;
pub mod check;
pub mod cli;
pub mod course;
pub mod diagnosis;
pub mod examples;
pub mod explain;
pub mod grade;
pub mod gym;
pub mod predict;
pub mod progress;
pub mod report;
pub mod score;
pub mod signature;
pub mod sketch;
pub mod watch;
pub mod workers;
