//! The commands: their arguments, and the functions that run them.

pub(crate) mod bless;
pub(crate) mod review;
