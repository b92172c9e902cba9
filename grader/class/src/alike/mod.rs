//! Finds code that submissions have in common, right or wrong: `grader class DIR --out OUT --alike`.
//! This is a question for the instructor, never a verdict.
//!
//! [`pairs`] compares a class by the passages of [`submission::code`], [`page`] shows them side by
//! side, [`jplag`] writes the class as the program JPlag wants it.

pub mod jplag;
pub mod page;
pub mod pairs;
