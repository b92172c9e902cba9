//! Hit-record snapshots: what the reference answered, one call a line.
//!
//! A line is `number: question -> answer`, both made of `name=value` fields; a value is a number, a
//! vector `(x,y,z)` or a range `[a,b]`. Floats are written shortest so that they read back bit for
//! bit. Every line has the answer's main figures; evenly spread ones, [`FULL_LINES`] a case, have
//! the question and the whole record.
//!
//! [`write()`] makes the text ([`full`] all that it could say), [`parse`] reads it (and insta's
//! header before it), [`changes`] says in words what changed between two.

mod diff;
mod line;
pub(crate) mod lines;
mod parse;
mod write;

pub use diff::{Changes, changes};
pub use line::{Line, Value};
pub use parse::{ParseError, Snapshot, parse};
pub use write::{FULL_LINES, Fields, full, record, write};
pub(crate) use write::{Forms, field, forms, number, vector};
