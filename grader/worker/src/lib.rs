//! Runs cases on a student's stages and writes down what they answered.
//!
//! The worker says what the code computed and judges nothing: truth is out of its sight, in the grader.
//! [`run()`] takes a case to its record; a file per stage does the work (`raygen`, `intersect`, `bbox`,
//! `bvh`), each behind the cargo feature of its name; [`isolate`] turns panics and holes into outcomes.

#[cfg(feature = "bbox")]
mod bbox;
#[cfg(feature = "bvh")]
mod bvh;
mod convert;
#[cfg(feature = "intersect")]
mod intersect;
pub mod isolate;
#[cfg(feature = "meshes")]
mod meshes;
#[cfg(feature = "raygen")]
mod raygen;
pub mod run;
#[cfg(any(feature = "intersect", feature = "bbox"))]
mod timed;
#[cfg(feature = "meshes")]
mod visits;

pub use run::run;
