//! Reports in the formats of course systems.
//!
//! [`outcome`] is what a run of the grader came to; [`Format::write`] turns it into the text of a
//! file. Everything here is a function of its arguments: nothing reads a clock, the environment or
//! a file, but [`command`]: `grader part1 --write FORMAT=FILE`, which grades and writes. The
//! program beside this library grades the project that it is called in, `submission` what a student
//! handed in.
//!
//! A failure of the grader itself is an outcome of its own ([`Outcome::Infrastructure`]): each
//! format says so in its own way, and none gives zero points for it.
//!
//! One format a module: [`gradescope`], [`classroom50`], [`prairielearn`], [`junit`], [`json`],
//! [`actions`], [`markdown`]. `schemas/` has a JSON Schema of each JSON format, written from the
//! documentation that it names; the tests check every file against them.

pub mod actions;
pub mod annotation;
pub mod classroom50;
pub mod command;
mod format;
pub mod gradescope;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod outcome;
pub mod points;
pub mod prairielearn;
pub mod settings;
pub mod text;

pub use format::Format;
pub use outcome::{Graded, Outcome};
pub use settings::Settings;
pub use text::{Layout, shown};
