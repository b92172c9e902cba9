//! `grader cost`: what accuracy costs in time.
//!
//! Well-known kernels and the student's own, side by side: how long each takes, and how right it is on ordinary and
//! on hard rays. Read [`report`] first: it is all that is said.

pub mod picture;
pub mod quartiles;
pub mod report;
pub mod trees;
