//! Runs cases on a student's stages and records the results.
//!
//! The worker judges nothing: the right results are in the grader, where the student's code cannot
//! reach them. [`run()`] runs a case and returns its record; a file per stage does the work
//! (`raygen`, `intersect`, `bbox`, `bvh`, `direct`, `global`, `adaptive`), each behind the cargo
//! feature of its name; `picture` renders the pictures of their tasks. Code that does not
//! depend on a stage is in [`harness`].

#[cfg(feature = "adaptive")]
mod adaptive;
#[cfg(feature = "bbox")]
mod bbox;
#[cfg(feature = "bvh")]
pub mod build_growth;
#[cfg(feature = "bvh")]
pub mod bvh;
mod convert;
#[cfg(feature = "direct")]
mod direct;
#[cfg(feature = "global")]
mod global;
#[cfg(feature = "intersect")]
mod intersect;
#[cfg(any(feature = "direct", feature = "global", feature = "adaptive"))]
mod light;
#[cfg(feature = "meshes")]
mod meshes;
#[cfg(any(feature = "direct", feature = "global", feature = "adaptive"))]
mod panels;
#[cfg(any(
    feature = "raygen",
    feature = "intersect",
    feature = "bbox",
    feature = "bvh",
    feature = "direct",
    feature = "global",
    feature = "adaptive"
))]
mod picture;
#[cfg(feature = "raygen")]
mod raygen;
pub mod run;
#[cfg(any(feature = "intersect", feature = "bbox"))]
mod timed;
#[cfg(feature = "meshes")]
mod visits;

pub use run::run;
