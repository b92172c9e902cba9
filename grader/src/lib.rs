//! Scores each stage of the course against exact results, golden images and hit-record snapshots.
//!
//! This crate never links a stage. It builds a *worker* program that links the student's stages,
//! runs the test cases in it, and judges the answers that the worker returns.
//!
//! To follow one run, start at [`grade`] and read on in this order:
//!
//! - [`workspace`] and [`course`]: the tasks, the cases and their points
//! - [`compile`], [`worker_set`], [`stage_workers`], [`runner`]: building and running the workers
//! - the crate [`judge`]: which answers are right
//! - [`score`]: points; [`diagnosis`] and [`signature`]: the likely mistake; [`speedup`]: times
//! - [`picture`]: what the code renders; [`chapter`]: where the book explains it
//! - [`given`]: files that students were given and changed
//! - [`report`]: the output; [`results`] and [`next_task`]: what is known from earlier runs
//!
//! [`watch`] grades whenever a file is saved. [`explain`] draws what a case tests.
//!
//! The tools for instructors are separate crates beside this one: `authoring` (handouts, the course
//! check, mutants), `submission` (grading what students hand in), `review` (reviewing and accepting
//! goldens), `cost` (time against accuracy).

mod cargo_run;
mod changed_signature;
mod channel;
pub mod chapter;
pub mod child_processes;
pub mod cli;
pub mod compile;
pub mod compile_errors;
pub mod compile_warnings;
pub mod consistency;
pub mod course;
pub mod crash;
pub mod death;
pub mod diagnosis;
pub mod error;
pub mod explain;
mod fresh_cases;
pub mod given;
pub mod grade;
pub mod interrupt;
pub mod launcher;
pub mod next_task;
pub mod packed;
pub mod picture;
pub mod printed;
pub mod records;
pub mod regularity;
pub mod report;
pub mod results;
pub mod runner;
pub mod score;
pub mod signature;
pub mod sources;
pub mod speedup;
pub mod stage_workers;
mod target_folder;
pub mod watch;
pub mod worker_set;
pub mod workspace;
