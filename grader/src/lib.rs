//! Scores each stage of the course against exact truth, golden images and hit-record snapshots.
//!
//! The trusted side. It never links a stage: it builds a worker with the student's stages, has it run the
//! [`cases`], and judges what comes back. Follow one run in [`grade`]: [`workspace`] and [`course`] (what
//! there is to grade), [`crew`] with [`compile`], [`workers`] with [`runner`] (building and running the workers),
//! [`judge`] with [`truth`] (right and wrong), [`score`] (points), [`speedup`] (times, which earn none), [`report`]
//! (showing them).
//!
//! For instructors: [`handout`] carves what a student is given, [`submission`] grades what comes back, [`check`]
//! asks whether the course keeps its word, [`bless`] takes new goldens, [`review`] shows what changed, [`mutants`]
//! grades typical mistakes.

pub mod bless;
pub mod cases;
pub mod check;
pub mod cli;
pub mod compile;
pub mod convert;
pub mod cost;
pub mod course;
pub mod crates;
pub mod crew;
pub mod diagnosis;
pub mod error;
pub mod grade;
pub mod handout;
pub mod html;
pub mod interrupt;
pub mod judge;
pub mod mutants;
pub mod oracle;
pub mod paste;
pub mod picture;
pub mod report;
pub mod review;
pub mod runner;
pub mod running;
pub mod score;
pub mod signature;
pub mod snapshot;
pub mod speedup;
pub mod submission;
pub mod tree;
pub mod truth;
mod words;
pub mod workers;
pub mod workspace;
