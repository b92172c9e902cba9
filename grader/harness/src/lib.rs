//! The part of a worker that does not depend on any stage, and is not compiled again when a stage
//! changes.
//!
//! [`run`] runs a case and returns its record: a panic or a hole in the student's code becomes an
//! outcome. [`main`] is the whole worker program: it runs the cases with limits on time and memory
//! and writes each record at once.

mod call_limit;
mod caller;
mod channel;
mod clock;
mod control;
mod isolate;
mod supervise;
mod usage;
mod watch;

pub use call_limit::{MOST_CALLS, limit_calls};
pub use clock::code_time;
pub use isolate::{ask, attempt, call, each_call, run};
pub use supervise::main;
