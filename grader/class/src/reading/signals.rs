//! The signals that end processes.

use std::process::ExitStatus;

/// The signal that ends a process for which the system has no memory.
pub(super) const SIGKILL: i32 = 9;

/// The signal that ended a process.
#[cfg(unix)]
pub(super) fn signal(status: ExitStatus) -> Option<i32> {
    std::os::unix::process::ExitStatusExt::signal(&status)
}

#[cfg(not(unix))]
pub(super) fn signal(_: ExitStatus) -> Option<i32> {
    None
}
