//! The arguments of each command and what it does with them.

pub(crate) mod bless;
pub(crate) mod review;
