//! Hit-record snapshots: what the reference answered, one call a row.
//!
//! A row is `number: question -> answer`, both made of `name=value` fields; a value is a number, a
//! vector `(x,y,z)` or a range `[a,b]`. Floats are written shortest so that they read back bit for
//! bit. Every row has the answer's main figures; evenly spread ones, [`FULL_ROWS`] a case, have the
//! question and the whole record.
//!
//! A case of more than [`ALL_ROWS`] calls has only a sample of its rows, evenly spread. The first
//! line, `# calls=N hash=H`, covers all calls: `H` is the [`RowsHash`] of what the rows would be if
//! every call had one in full.
//!
//! [`write()`] makes the text ([`full`] all rows in full), [`parse`] reads it (and insta's header
//! before it), [`changes`] describes what changed between two.

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
pub use write::{ALL_ROWS, FULL_ROWS, Fields, full, record, write};
pub(crate) use write::{Forms, field, forms, number, vector};
