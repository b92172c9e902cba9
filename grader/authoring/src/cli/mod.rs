//! The arguments of each command and what it does with them.

pub(crate) mod course;
pub(crate) mod handout;
pub(crate) mod mutants;
