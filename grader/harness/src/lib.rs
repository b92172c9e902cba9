//! The part of a worker that does not depend on any stage, so that an edit of a stage does not
//! compile it again.
//!
//! [`run`] takes a case to its record: a panic or a hole in the student's code becomes an outcome.
//! [`main`] is the whole worker program: it runs case after case, limited in time and memory, and
//! writes each record as it is made.

mod clock;
mod isolate;
mod supervise;

pub use isolate::{call, run};
pub use supervise::main;
