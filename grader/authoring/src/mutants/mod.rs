//! Tests the grader with mutants and variants. A *mutant* is the reference, or a variant, with a
//! typical mistake. A *variant* is correct code that differs from the reference.
//!
//! Every mutant must lose points, and no variant may lose a core point. [`corpus`] reads mutants
//! and variants, [`versions_crate`] builds all versions of a stage in one crate, [`run`] grades
//! them, [`table`] lists which case detects which mistake. [`grader::diagnosis`] compares a
//! student's results with those of the mutants. [`pairs`] composes two mistakes in the same code.
//! [`mistake_pictures`] renders mistakes for the book. [`blessing`] checks that no mistake of the
//! reference could become golden unnoticed.
//! [`simplest`] measures how simple the calls are that show the mistakes, [`examples`] how many of
//! them a student's examples catch.

pub mod blessing;
pub mod corpus;
pub mod empty;
pub mod examples;
pub mod families;
mod few_colours;
pub mod groups;
pub mod mistake_pictures;
pub mod pairs;
pub mod proportion;
pub mod run;
pub mod seeds;
pub mod simplest;
pub mod table;
pub mod versions_crate;
