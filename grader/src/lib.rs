//! Scores each stage of the course against exact truth, golden images and hit-record snapshots.
//!
//! The trusted side. It never links a stage: it builds a worker with the student's stages, has it run the
//! [`cases`], and judges what comes back. Follow one run in [`grade`]: [`workspace`] and [`course`] (what
//! there is to grade), [`workers`] with [`compile`], [`workers`] with [`runner`] (building and running the workers),
//! [`judge`] with [`truth`] (right and wrong), [`score`] (points), [`speedup`] (times, which earn none), [`report`]
//! (showing them).
//!
//! For instructors: [`handout`] carves what a student is given, [`submission`] grades what comes back, [`check`]
//! asks whether the course keeps its word, [`bless`] takes new goldens, [`review`] shows what changed, [`mutants`]
//! grades typical mistakes.

pub mod child_processes;
pub mod cli;
pub mod compile;
pub mod course;
pub mod diagnosis;
pub mod error;
pub mod grade;
pub mod interrupt;
pub mod lists;
pub mod records;
pub mod report;
pub mod runner;
pub mod score;
pub mod signature;
pub mod speedup;
pub mod stage_workers;
pub mod worker_set;
pub mod workspace;
