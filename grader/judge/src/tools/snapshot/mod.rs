//! Snapshots: the answers of the reference, one row per call.
//!
//! A row is `number: question -> answer`, both made of `name=value` fields; a value is a number, a
//! vector `(x,y,z)` or a range `[a,b]`. Floats are written with as few digits as possible, but so
//! that they are read back bit for bit. Every row contains the answer's main fields; at most
//! [`FULL_ROWS`] evenly spread rows of a case also contain the question and all other fields.
//!
//! For a case with more than [`ALL_ROWS`] calls, there is only an evenly spread sample of rows. The
//! first line, `# calls=N hash=H`, covers all calls: `H` is the [`RowsHash`] of the full rows of
//! all calls.
//!
//! [`write()`] returns the text of a [`Content`], [`full`] a snapshot with the full rows of all
//! calls. [`parse`] reads the text (with or without insta's header), [`changes`] compares two
//! snapshots.

mod diff;
mod hash;
mod line;
pub(crate) mod lines;
mod parse;
mod write;

pub use diff::{Changes, changes};
pub use hash::RowsHash;
pub use line::{Line, Value};
pub use parse::{ParseError, Snapshot, parse};
pub use write::{ALL_ROWS, FULL_ROWS, Fields, record};
pub(crate) use write::{Content, Forms, field, forms, full, number, vector, write};
