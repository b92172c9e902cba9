//! `grader cost`: measures the time that accuracy costs.
//!
//! Compares well-known kernels with the student's own: the time of each, and its accuracy on
//! ordinary and on hard rays. Read [`report`] first: it defines all results. Then [`measure()`]
//! (one run), [`timing`] (how everything is timed), `measure_kernels`, `rays` (the test rays),
//! `truth` and `accuracy` (comparison with the oracle), `leaks`, `student` (measures the student's
//! kernel through the worker), [`trees`], [`picture`] (the cost of better pictures), [`table`] and
//! [`page`] (output); [`world`] compares with real ray casters.

mod accuracy;
mod cells;
mod leak_view;
mod leaks;
mod machine;
mod measure;
mod measure_kernels;
pub mod page;
pub mod picture;
mod precision;
pub mod quartiles;
mod ray_family;
mod rays;
pub mod report;
mod student;
pub mod table;
pub mod timing;
pub mod trees;
mod truth;
pub mod world;

pub use measure::{CostRequest, SampleCounts, measure};
