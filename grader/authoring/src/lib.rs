//! Tools for the authors of the course. [`handout`] creates the projects for students, and [`term`]
//! makes the course of one teacher. [`check`] tests the course itself, [`diff`] compares two
//! versions of the course, and [`mutants`] grades typical mistakes and correct variants.

pub mod check;
pub mod diff;
pub mod handout;
pub mod mutants;
pub mod term;
