//! Finds code that submissions have in common, right or wrong: `grader class DIR --out OUT --alike`.
//! This is a question for the instructor, never a verdict.
//!
//! [`pairs`] compares a class by the passages of [`submission::code`], with [`owners`]; [`common`]
//! finds what many have. [`page`] shows the strongest pairs side by side, [`table`] has all of
//! them, [`jplag`] writes the class as the program JPlag wants it.

pub mod common;
pub mod jplag;
pub mod owners;
pub mod page;
pub mod pairs;
pub mod table;
