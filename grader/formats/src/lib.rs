//! Reports in the formats of course systems.
//!
//! [`outcome`] is what a run of the grader came to; [`Format::write`] turns it into the text of a
//! file. Everything here is a function of its arguments: nothing reads a clock, the environment or a
//! file. The program beside this library, `grader part1 --write FORMAT=FILE`, grades and writes.
//!
//! A failure of the grader itself is an outcome of its own ([`Outcome::Infrastructure`]): each
//! format says so in its own way, and none gives zero points for it.
//!
//! One format a module: [`gradescope`], [`classroom50`], [`prairielearn`], [`junit`], [`json`],
//! [`actions`], [`markdown`]; [`gradebook`] is that of a class. `schemas/` has a JSON Schema of
//! each JSON format, written from the documentation that it names; the tests check every file
//! against them.

pub mod actions;
pub mod annotation;
pub mod classroom50;
mod format;
pub mod gradebook;
pub mod gradescope;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod outcome;
pub mod points;
pub mod prairielearn;
pub mod settings;
mod text;

pub use format::Format;
pub use outcome::{Graded, Outcome};
pub use settings::Settings;
