//! `grader cost`: what accuracy costs in time.
//!
//! Well-known kernels and the student's own, side by side: how long each takes, and how right it is on ordinary and
//! on hard rays. Read [`report`] first: it is all that is said. Then [`measure()`] (one run), `rays` (what kernels are
//! asked), `truth` and `accuracy` (how right the answers are), `leaks`, `clock` (times), `student` (the same through the
//! worker), `measure_trees` and `overlaps` (trees), [`picture`] (what better pictures cost), [`table`] and [`page`]
//! (showing it).

mod accuracy;
mod clock;
mod leaks;
mod machine;
mod measure;
mod measure_trees;
mod overlaps;
pub mod page;
pub mod picture;
pub mod quartiles;
mod rays;
pub mod report;
mod student;
pub mod table;
pub mod trees;
mod trees_table;
mod truth;

pub use measure::{Order, Size, measure};
