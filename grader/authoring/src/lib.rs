//! Tools for the authors of the course: [`handout`] creates the projects for students, [`check`]
//! tests the course itself, [`diff`] compares two versions of it, [`mutants`] grades typical mistakes
//! and correct variants, [`term`] makes the course of one teacher.

pub mod check;
pub mod diff;
pub mod handout;
pub mod mutants;
pub mod term;
