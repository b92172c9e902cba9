//! Mutants: the reference with a typical mistake in it, and variants: correct code that is not the reference.
//!
//! A wrong grade is worse than none, so the grader is tested both ways: every mutant must lose points, no variant
//! may lose a core point. [`corpus`] reads them, [`host`] puts all of a stage's into one crate beside each
//! other, [`run`] grades them, [`table`] shows which case catches which mistake. The mutants' verdicts are also
//! what [`grader::diagnosis`] compares a student's with.

pub mod corpus;
pub mod host;
pub mod run;
pub mod table;
