//! How programs are started of which not all code is trusted.

use crate::workers::awake::Awake;
use std::fmt;
use std::path::Path;
use std::process::{Command, ExitStatus};

/// Starts cargo and workers with few rights. Both get nothing of the caller's environment.
pub trait Launcher: fmt::Debug + Send + Sync {
    /// The command that runs cargo. Its arguments are to be added.
    fn cargo(&self) -> Command;

    /// The command that runs a worker. Its arguments are to be added.
    fn worker(&self, program: &Path, limits: WorkerLimits) -> Command;

    /// Whether cargo and the worker can open no files but those that are meant for them.
    fn closes_files(&self) -> bool;

    /// Whether the thread of the student's code in a worker is to give up all rights.
    fn seals(&self) -> bool;

    /// How a program ended whose command had this status: another program may have run it.
    fn status_of_program(&self, status: ExitStatus) -> ExitStatus;

    /// When everything that it starts has to have ended; `None` if there is no such limit.
    fn end(&self) -> Option<Awake>;
}

/// Limits on a worker beyond those on its cases: they hold even if the worker does not enforce the
/// latter any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkerLimits {
    /// Memory that its cases may allocate, in megabytes.
    pub memory_mb: u32,
    /// Processor time of all its cases, in seconds.
    pub cpu_seconds: u64,
}
