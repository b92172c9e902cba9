//! What every program of the course is built on, whatever it computes.
//!
//! - [`GraderError`]: errors that are not the fault of the code under test
//! - [`mod@print`]: output that a closed pipe does not turn into a panic
//! - [`program`]: command lines and exit codes
//! - [`write_whole`]: files are written whole or not at all
//! - [`shell_word`]: paths in commands that are printed
//! - [`interrupt`]: Ctrl-C ends child processes and removes temporary files
//! - [`child_processes`]: starting and ending programs
//! - [`browser`]: opens pages; [`keys`]: reads single keys
//! - [`Workspace`]: the checkout or handout of the course
//! - [`term`]: the folder of a teacher's course
//! - [`fnv`]: a hash of bytes; [`digits`]: significant digits; [`utc`]: dates and times of day

pub mod browser;
pub mod child_processes;
pub mod digits;
mod error;
mod files;
pub mod fnv;
pub mod interrupt;
pub mod keys;
pub mod print;
pub mod program;
mod shell;
pub mod term;
pub mod utc;
mod workspace;

pub use error::{GraderError, is_of_the_machine, without_path};
pub use files::{bytes_below, folder_of, write_whole, write_whole_by};
pub use shell::shell_word;
pub use workspace::Workspace;

/// The version of the course and of all its programs.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
