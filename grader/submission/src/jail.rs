//! Which files cargo and the worker of one submission may use.

use crate::containment::{Containment, FILE_MB};
use crate::toolchain::{LIBRARY_CACHE, Toolchain};
use grader::workers::launcher::{Launcher, WorkerLimits};
use sandbox::{Limits, Policy};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Processor time of one process that compiles, in seconds. The largest crate of the course takes
/// 6 seconds.
const COMPILER_SECONDS: u64 = 45;

/// Address space of one process that compiles, in megabytes.
const COMPILER_MB: u64 = 4096;

/// Starts the programs of one submission.
#[derive(Clone, Debug)]
pub(crate) struct Jail {
    pub(crate) containment: Containment,
    pub(crate) toolchain: Toolchain,
    /// The workspace that is built.
    pub(crate) root: PathBuf,
    /// What of it the compiler reads: files, and folders with everything in them.
    pub(crate) sources: Vec<PathBuf>,
    /// The sources of the libraries.
    pub(crate) libraries: PathBuf,
    /// Cargo's own folder, with its settings.
    pub(crate) home: PathBuf,
    /// Where the compiler writes.
    pub(crate) target: PathBuf,
    /// Where programs put temporary files.
    pub(crate) temporary: PathBuf,
}

impl Launcher for Jail {
    fn cargo(&self) -> Command {
        let mut run = self.toolchain.folders.clone();
        run.extend(self.toolchain.cargo.parent().map(Path::to_path_buf));
        let mut read = self.sources.clone();
        read.extend([self.libraries.clone(), LIBRARY_CACHE.into()]);
        read.push("/dev/urandom".into());
        let write = [&self.home, &self.target, &self.temporary];
        let mut write: Vec<PathBuf> = write.into_iter().cloned().collect();
        write.push("/dev/null".into());
        let policy = Policy {
            read,
            list: vec![self.root.clone()],
            run,
            write,
            processes: true,
            limits: Limits {
                cpu_seconds: Some(COMPILER_SECONDS),
                memory_mb: Some(COMPILER_MB),
                file_mb: Some(FILE_MB),
                threads: None,
            },
            ..Policy::default()
        };
        let mut command = self.containment.command(&self.toolchain.cargo, &policy);
        command
            .env_clear()
            .env("PATH", &self.toolchain.path)
            .env("RUSTC", &self.toolchain.rustc)
            .env("HOME", &self.home)
            .env("CARGO_HOME", &self.home)
            .env("TMPDIR", &self.temporary)
            .env("LC_ALL", "C")
            .env("CARGO_INCREMENTAL", "0")
            // Cargo reads settings in the current folder and all above it.
            .current_dir("/");
        command
    }

    fn worker(&self, program: &Path, limits: WorkerLimits) -> Command {
        self.containment.worker(program, limits)
    }

    fn seals(&self) -> bool {
        self.containment.seals()
    }
}
