//! Parts of the Rust tests of several kinds of work.

pub(crate) mod hits;
pub(crate) mod numbers;
