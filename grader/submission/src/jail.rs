//! Which files cargo and the worker of one submission may use.

use crate::containment::{Containment, FILE_MB};
use crate::toolchain::{LIBRARY_CACHE, Toolchain};
use grader::workers::awake::Awake;
use grader::workers::launcher::{Launcher, WorkerLimits};
use sandbox::{Limits, Policy};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};

/// Processor time of one process that compiles, in seconds. The largest crate of the course takes
/// 6 seconds; on a machine ten times as slow a fifth of this.
const COMPILER_SECONDS: u64 = 300;

/// Address space of one process that compiles, in megabytes.
const COMPILER_MB: u64 = 4096;

/// Starts the programs of one submission.
#[derive(Clone, Debug)]
pub(crate) struct Jail {
    pub(crate) containment: Containment,
    pub(crate) toolchain: Toolchain,
    /// The workspace that is built.
    pub(crate) root: PathBuf,
    /// The sources of the libraries.
    pub(crate) libraries: PathBuf,
    /// Cargo's own folder, with its settings.
    pub(crate) home: PathBuf,
    /// Where the compiler writes.
    pub(crate) target: PathBuf,
    /// Where programs put temporary files.
    pub(crate) temporary: PathBuf,
    /// When all programs of the submission have to have ended, if there is such a limit.
    pub(crate) end: Option<Awake>,
}

impl Launcher for Jail {
    fn cargo(&self) -> Command {
        let mut run = self.toolchain.folders.clone();
        run.extend(self.toolchain.cargo.parent().map(Path::to_path_buf));
        let read = vec![
            self.root.clone(),
            self.libraries.clone(),
            LIBRARY_CACHE.into(),
            "/dev/urandom".into(),
        ];
        let mut write: Vec<PathBuf> = [&self.home, &self.target, &self.temporary]
            .into_iter()
            .cloned()
            .collect();
        write.push("/dev/null".into());
        let policy = Policy {
            read,
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

    fn closes_files(&self) -> bool {
        self.containment.closes_files()
    }

    fn seals(&self) -> bool {
        self.containment.seals()
    }

    fn status_of_program(&self, status: ExitStatus) -> ExitStatus {
        self.containment.status_of_program(status)
    }

    fn end(&self) -> Option<Awake> {
        self.end
    }
}
