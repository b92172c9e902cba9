//! What a worker asks while a case runs.
//!
//! Code that breaks the compiler's checks could change what the worker has counted in its own memory.
//! So in a submission the results of tests of boxes and primitives are known to the grader only: the
//! worker asks for each, and the grader counts.

use serde::{Deserialize, Serialize};
use std::io::{self, Read, Write};

/// A test of which the worker does not know the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Question {
    /// Where is the ray's line inside the box of this node?
    Box(u32),
    /// Where does the ray's line hit this primitive? Both numbers are the same.
    Prim(u32),
}

/// The interval of a line inside a box, or the hit of a primitive; `None` if there is none.
pub type Reply = Option<[f64; 2]>;

const REPLY_BYTES: usize = 17;

/// Writes a reply of the grader.
pub fn write_reply(out: &mut dyn Write, reply: Reply) -> io::Result<()> {
    let mut bytes = [0; REPLY_BYTES];
    bytes[0] = u8::from(reply.is_some());
    let [first, second] = reply.unwrap_or_default();
    bytes[1..9].copy_from_slice(&first.to_le_bytes());
    bytes[9..].copy_from_slice(&second.to_le_bytes());
    out.write_all(&bytes)
}

/// Reads what [`write_reply`] wrote.
pub fn read_reply(input: &mut dyn Read) -> io::Result<Reply> {
    let mut bytes = [0; REPLY_BYTES];
    input.read_exact(&mut bytes)?;
    let number = |at: usize| {
        let mut eight = [0; 8];
        eight.copy_from_slice(&bytes[at..at + 8]);
        f64::from_le_bytes(eight)
    };
    Ok((bytes[0] > 0).then(|| [number(1), number(9)]))
}
