//! `grader cost`: measures the time that accuracy costs.
//!
//! Compares well-known kernels with the student's own: the time of each, and its accuracy on
//! ordinary and on hard rays. Read [`report`] first: it defines all results. Then [`measure()`]
//! (one run), `rays` (the test rays), `truth` and `accuracy` (comparison with the oracle), `leaks`,
//! `timing`, `student` (measures the student's kernel through the worker), `measure_trees` and
//! `coplanar` (trees), [`picture`] (the cost of better pictures), [`table`] and [`page`] (output).

mod accuracy;
mod coplanar;
mod leaks;
mod machine;
mod measure;
mod measure_trees;
pub mod page;
pub mod picture;
pub mod quartiles;
mod rays;
pub mod report;
mod student;
pub mod table;
mod timing;
pub mod trees;
mod trees_table;
mod truth;

pub use measure::{CostRequest, SampleCounts, measure};
