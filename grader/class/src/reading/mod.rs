//! Reads what was handed in, each submission in a process of its own with limits of time, memory and
//! output. An archive, a clone or a tree of folders can make whoever reads it run for ever or take all
//! memory, and git and the libraries that unpack may have mistakes: whatever happens to that process
//! is a row of the class, and nothing happens to the class.
//!
//! [`intake`] opens what was handed in, [`content`] is what is read of it, [`process`] runs both in a
//! process.

pub mod content;
pub mod intake;
pub mod process;
mod signals;

pub use content::{Content, Unreadable};
pub use process::Reader;
