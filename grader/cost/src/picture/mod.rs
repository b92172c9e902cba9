//! `grader cost picture`: measures the time that better pictures cost.
//!
//! The grader does not link a renderer. It builds the `pathtracer` program of the workspace (in a
//! handout, the student's) and renders small pictures repeatedly, with different random numbers
//! each time. Read [`plan`] (what is compared), [`program`] (how a picture is rendered),
//! [`estimate`] (how its error is estimated), [`efficiency`] (error and time together), [`curve`]
//! (the results), [`table`] (text output).

pub mod curve;
pub mod efficiency;
pub mod estimate;
pub mod measure;
pub mod plan;
pub mod program;
#[cfg(test)]
mod simulated;
pub mod table;

pub use curve::{ConfidenceInterval, Curve, CurvePoint, Experiment, PictureReport, Thumbnail};
pub use measure::{experiment, measure};
