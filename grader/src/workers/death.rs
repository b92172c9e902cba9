//! How a case ended its worker.

use crate::workers::printed::with_commas;
use std::fmt;
use std::process::ExitStatus;

/// The end of a worker, as seen from outside. Its text ends the sentence "your code ...".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Death {
    /// The stack overflowed.
    StackOverflow,
    /// It asked for more memory than it may have.
    OutOfMemory {
        /// The limit in megabytes.
        limit_mb: u32,
        /// The bytes of the last request, if they are known.
        asked_for: Option<u64>,
    },
    /// It called `std::process::exit`.
    Exit(i32),
    /// It aborted: it called `std::process::abort`, for example.
    Abort,
    /// It panicked while a panic was unwinding.
    SecondPanic,
    /// A signal ended it.
    Signal(i32),
    /// It could not be started: its statics, or those of a thread, do not fit into its memory.
    TooLargeToStart {
        /// The limit in megabytes.
        limit_mb: u32,
    },
    /// It ended in a way that this system does not report.
    Unknown,
}

/// The number of the signal that `abort` sends.
const SIGABRT: i32 = 6;

/// The number of the signal with which the system ends a program that it cannot load.
const SIGSEGV: i32 = 11;

impl Death {
    /// The death of a worker with this status whose last lines are `end`.
    pub fn of(status: ExitStatus, end: &str, limit_mb: u32) -> Death {
        if let Some(code) = status.code() {
            return Death::Exit(code);
        }
        match signal(status) {
            Some(SIGABRT) => aborted(end, limit_mb),
            Some(signal) => Death::Signal(signal),
            None => Death::Unknown,
        }
    }

    /// The death of a worker that ended before it began the first case, if this can be the fault of
    /// the code that it links: the reference's worker starts under the same limits.
    pub fn before_the_start(status: ExitStatus, end: &str, limit_mb: u32) -> Option<Death> {
        // What the system's loader and the worker say about memory that they do not get.
        let no_memory = [
            "cannot allocate TLS data structures",
            "cannot allocate memory",
            "cannot start a thread",
            "memory allocation of",
            "no memory left",
        ];
        let has_no_memory = no_memory.iter().any(|words| end.contains(words));
        (signal(status) == Some(SIGSEGV) || has_no_memory)
            .then_some(Death::TooLargeToStart { limit_mb })
    }

    /// Whether the machine may be the cause: no code that the compiler checks gets these signals.
    pub fn is_of_the_system(self) -> bool {
        matches!(
            self,
            Death::Signal(_) | Death::TooLargeToStart { .. } | Death::Unknown
        )
    }

    /// Whether it is a symptom of code that does not end, as is a time limit.
    pub fn is_endless(self) -> bool {
        matches!(self, Death::StackOverflow | Death::OutOfMemory { .. })
    }
}

/// The reason of an abort: the runtime's message says it.
fn aborted(end: &str, limit_mb: u32) -> Death {
    if end.contains("has overflowed its stack") {
        return Death::StackOverflow;
    }
    if let Some((_, after)) = end.rsplit_once("memory allocation of ") {
        let asked_for = after.split(' ').next().and_then(|bytes| bytes.parse().ok());
        return Death::OutOfMemory {
            limit_mb,
            asked_for,
        };
    }
    let second_panic = [
        "thread panicked while processing panic",
        "caused non-unwinding panic",
    ];
    match second_panic.iter().any(|message| end.contains(message)) {
        true => Death::SecondPanic,
        false => Death::Abort,
    }
}

#[cfg(unix)]
fn signal(status: ExitStatus) -> Option<i32> {
    std::os::unix::process::ExitStatusExt::signal(&status)
}

#[cfg(not(unix))]
fn signal(_: ExitStatus) -> Option<i32> {
    None
}

/// The name of a signal, and what causes it.
fn signal_name(signal: i32) -> Option<(&'static str, &'static str)> {
    Some(match signal {
        2 => ("SIGINT", "interrupted"),
        4 => ("SIGILL", "an invalid instruction: is there `unsafe` code?"),
        5 => ("SIGTRAP", "a trap"),
        7 => (
            "SIGBUS",
            "an invalid memory access: is there `unsafe` code?",
        ),
        8 => ("SIGFPE", "an arithmetic error"),
        9 => (
            "SIGKILL",
            "the system does this if the memory of the machine is full",
        ),
        11 => (
            "SIGSEGV",
            "an invalid memory access: is there `unsafe` code?",
        ),
        15 => ("SIGTERM", "another program asked it to end"),
        _ => return None,
    })
}

impl fmt::Display for Death {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Death::StackOverflow => {
                f.write_str("overflowed the stack of 64 MB: a recursion without end?")
            }
            Death::OutOfMemory {
                limit_mb,
                asked_for,
            } => {
                write!(f, "asked for more than {limit_mb} MB of memory")?;
                if let Some(bytes) = asked_for {
                    write!(
                        f,
                        " (the last request was for {} bytes)",
                        with_commas(*bytes)
                    )?;
                }
                f.write_str(": a Vec that grows without end?")
            }
            Death::Exit(code) => write!(
                f,
                "called `std::process::exit({code})`, which ends the whole program: return a result instead"
            ),
            Death::Abort => f.write_str(
                "aborted the whole program (SIGABRT): does it call `std::process::abort`?",
            ),
            Death::SecondPanic => {
                f.write_str("panicked again while it cleaned up after a panic: in a `Drop`?")
            }
            Death::Signal(signal) => match signal_name(*signal) {
                Some((name, cause)) => write!(f, "was ended by the signal {name} ({cause})"),
                None => write!(f, "was ended by signal {signal}"),
            },
            Death::TooLargeToStart { limit_mb } => write!(
                f,
                "could not be started: are its `static`s or `thread_local`s larger than {limit_mb} MB together?"
            ),
            Death::Unknown => f.write_str("ended the whole program"),
        }
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::process::ExitStatusExt;

    /// The text of the death of a worker with this wait status: a code in the upper byte, a signal
    /// in the lower one.
    fn text(status: i32, end: &str) -> String {
        Death::of(ExitStatus::from_raw(status), end, 1024).to_string()
    }

    #[test]
    fn every_kind_of_death_has_its_sentence() {
        for (status, end, right) in [
            (
                6,
                "\nthread 'student' (7) has overflowed its stack\nfatal runtime error: stack overflow, aborting\n",
                "overflowed the stack of 64 MB: a recursion without end?",
            ),
            (
                6,
                "memory allocation of 1073741824 bytes failed\n",
                "asked for more than 1024 MB of memory (the last request was for 1,073,741,824 bytes): a Vec that grows without end?",
            ),
            (
                0,
                "",
                "called `std::process::exit(0)`, which ends the whole program: return a result instead",
            ),
            (
                3 << 8,
                "has overflowed its stack",
                "called `std::process::exit(3)`, which ends the whole program: return a result instead",
            ),
            (
                6,
                "",
                "aborted the whole program (SIGABRT): does it call `std::process::abort`?",
            ),
            (
                6,
                "thread caused non-unwinding panic. aborting.\n",
                "panicked again while it cleaned up after a panic: in a `Drop`?",
            ),
            (
                11,
                "",
                "was ended by the signal SIGSEGV (an invalid memory access: is there `unsafe` code?)",
            ),
            (
                9,
                "",
                "was ended by the signal SIGKILL (the system does this if the memory of the machine is full)",
            ),
            (34, "", "was ended by signal 34"),
        ] {
            assert_eq!(text(status, end), right);
        }
    }

    #[test]
    fn only_code_that_is_too_large_is_to_blame_for_a_worker_that_does_not_start() {
        let why = |status, end| Death::before_the_start(ExitStatus::from_raw(status), end, 1024);
        let too_large = Some(Death::TooLargeToStart { limit_mb: 1024 });
        assert_eq!(why(11, ""), too_large);
        let of_loader = "worker: cannot allocate TLS data structures for initial thread\n";
        assert_eq!(why(127 << 8, of_loader), too_large);
        let of_worker = "worker: cannot start a thread: Cannot allocate memory (os error 12)\n";
        assert_eq!(why(2 << 8, of_worker), too_large);
        // The launcher's, and the machine's.
        assert_eq!(why(125 << 8, "sandbox: Landlock: no such file"), None);
        assert_eq!(why(9, ""), None);
    }
}
