//! Output to the terminal, to a file, or to a pipe whose reader may have gone.
//!
//! The macros of the standard library panic if nobody reads what they print, as in
//! `grader status | head -1`. Programs of the course use [`outln!`](crate::outln) and
//! [`errln!`](crate::errln) instead: once the reader has gone, these print nothing, and the work
//! goes on to its end. So its files are written and its exit code is true. If the output cannot be
//! written for another reason, such as a full disk, the program ends with a message and exit code
//! 2.

use crate::interrupt;
use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Prints a line to the standard output.
#[macro_export]
macro_rules! outln {
    () => { $crate::print::to_stdout(format_args!("\n")) };
    ($($part:tt)*) => { $crate::print::to_stdout(format_args!("{}\n", format_args!($($part)*))) };
}

/// Prints a text to the standard output, without a line end.
#[macro_export]
macro_rules! out {
    ($($part:tt)*) => { $crate::print::to_stdout(format_args!($($part)*)) };
}

/// Prints a line to the standard error output.
#[macro_export]
macro_rules! errln {
    () => { $crate::print::to_stderr(format_args!("\n")) };
    ($($part:tt)*) => { $crate::print::to_stderr(format_args!("{}\n", format_args!($($part)*))) };
}

/// Prints a text to the standard error output, without a line end.
#[macro_export]
macro_rules! err {
    ($($part:tt)*) => { $crate::print::to_stderr(format_args!($($part)*)) };
}

/// Whether the reader of the standard output has gone.
static IS_CLOSED: AtomicBool = AtomicBool::new(false);

/// Whether the reader of the standard output has gone: nobody sees what a program prints from now
/// on. A program that would go on forever, such as `grader watch`, ends then.
pub fn is_closed() -> bool {
    IS_CLOSED.load(Ordering::Relaxed)
}

/// Writes `text` to the standard output, at once. See [`outln!`](crate::outln).
pub fn to_stdout(text: Arguments) {
    if is_closed() {
        return;
    }
    let mut stdout = io::stdout().lock();
    match stdout.write_fmt(text).and_then(|()| stdout.flush()) {
        Ok(()) => {}
        Err(error) if error.kind() == ErrorKind::BrokenPipe => {
            IS_CLOSED.store(true, Ordering::Relaxed);
        }
        Err(error) => {
            to_stderr(format_args!(
                "error: cannot write to the standard output: {error}\n"
            ));
            interrupt::clean_up();
            std::process::exit(2);
        }
    }
}

/// Writes `text` to the standard error output. See [`errln!`](crate::errln).
pub fn to_stderr(text: Arguments) {
    // There is no other place to which this error could be reported.
    let _ = io::stderr().lock().write_fmt(text);
}
