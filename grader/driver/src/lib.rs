//! Runs cases on the functions of the stages, which a worker links and passes as a table.
//!
//! The driver judges nothing: the right results are in the grader, where the student's code cannot
//! reach them. [`run()`] runs a case and returns its record; a file per stage does the work
//! (`raygen`, `intersect`, `bbox`, `bvh`, `direct`, `global`, `adaptive`); `picture` renders the
//! pictures of their tasks. Code that does not depend on a stage is in [`harness`].

mod adaptive;
mod bbox;
pub mod build_growth;
pub mod bvh;
mod convert;
mod direct;
mod global;
mod intersect;
mod light;
mod meshes;
mod panels;
mod picture;
mod raygen;
mod run;
pub mod stages;
mod timed;
mod visits;

pub use run::run;
