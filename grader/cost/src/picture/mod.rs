//! `grader cost picture`: what a better picture costs.
//!
//! The grader links no renderer. It builds the `pathtracer` program of the workspace, the student's own in a handout, and
//! has it render small pictures again and again, with other random numbers each time. Read [`plan`] (what is compared),
//! [`program`] (how a picture is made), [`estimate`] (how its error is estimated), [`curve`] (what is said of it),
//! [`table`] (showing it).

pub mod curve;
pub mod estimate;
pub mod measure;
pub mod plan;
pub mod program;
pub mod table;

pub use curve::{Curve, Experiment, Interval, Pictures, Point};
pub use measure::measure;
