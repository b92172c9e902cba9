//! Tools for the authors of the course. [`term`] makes the course of one teacher. [`check`] tests
//! the course itself and its handouts, [`diff`] compares two versions of the course, and
//! [`mutants`] grades typical mistakes and correct variants.

pub mod check;
pub mod diff;
pub mod mutants;
pub mod term;
