//! The commands: their arguments, and the functions that run them.

pub(crate) mod course;
pub(crate) mod mutants;
