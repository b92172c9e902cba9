//! How the code of submissions is contained: what this machine can do, and what is said about it.

use crate::bubblewrap;
use crate::toolchain::LIBRARY_CACHE;
use base::{GraderError, Workspace};
use grader::build;
use grader::workers::launcher::WorkerLimits;
use sandbox::probe::OTHER_USERS;
pub use sandbox::{Limits, Policy};
use sandbox::{Support, Without};
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

/// Address space of a worker beyond what its cases may allocate, in megabytes: program, libraries,
/// stacks, and what allocators reserve. The worker itself ends a case that uses more than it may.
const WORKER_SPARE_MB: u64 = 512;

/// The most threads of a worker, if it runs as a user of its own. The worker itself ends a case that
/// starts more than a hundred.
const WORKER_THREADS: u64 = 512;

/// The largest file that a process may write, in megabytes.
pub(crate) const FILE_MB: u64 = 512;

/// Where the system's loader of programs may be: a worker needs to run it, and nothing else there.
const LOADERS: [&str; 5] = [
    "/lib64/ld-linux-x86-64.so.2",
    "/lib/ld-linux-aarch64.so.1",
    "/lib/ld-linux-riscv64-lp64d.so.1",
    "/lib/ld-musl-x86_64.so.1",
    "/lib/ld-musl-aarch64.so.1",
];

/// The folders of the C library.
const LIBRARIES: [&str; 4] = ["/lib", "/lib64", "/usr/lib", "/usr/lib64"];

/// What keeps the code of a submission from everything that is not its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Containment {
    /// Code is compiled and run by the launcher.
    Sandbox {
        /// The launcher.
        launcher: PathBuf,
        /// What it can do here.
        held: Support,
        /// The command in front of the launcher for an empty network of its own; `None` where this
        /// is not allowed.
        own_network: Option<&'static [&'static str]>,
        /// Whether bubblewrap runs the launcher, in a file system that has what the policy lists and
        /// nothing else, and with no network and no other processes.
        bubblewrap: bool,
    },
    /// Only time and memory are limited.
    None,
}

impl Containment {
    /// The strongest containment of this machine. Builds the launcher if it is not built yet. If
    /// there is none, this is an error, unless `unsandboxed`: then code runs without.
    pub fn choose(workspace: &Workspace, unsandboxed: bool) -> Result<Containment, GraderError> {
        if unsandboxed {
            return Ok(Containment::None);
        }
        let launcher = build::build_program(workspace.root(), "sandbox")?
            .map_err(|_| GraderError::new("the package sandbox does not compile"))?;
        Containment::with_launcher(workspace, launcher)
    }

    /// The same with the launcher that [`Containment::choose`] has built.
    pub fn with_launcher(
        workspace: &Workspace,
        launcher: PathBuf,
    ) -> Result<Containment, GraderError> {
        let mut held = support(&mut Command::new(&launcher))
            .map_err(|e| GraderError::file("run", &launcher, e))?;
        held.other_user &= is_open_to_all(workspace.root());
        // Only in place of Landlock: it can do no more, and takes some milliseconds to start.
        let bubblewrap = !held.files && bubblewrap::works(&launcher);
        let goldens = workspace.root().join("golden");
        let is_closed = held.other_user && is_closed_to_others(&goldens);
        if !(held.system_calls || bubblewrap || is_closed) {
            return Err(GraderError::new(
                "this machine cannot contain the code of a submission: it needs Linux with seccomp, or the program `bwrap` (package bubblewrap) and the right to use it, or to be run by the superuser with a folder `golden` that others cannot read. Grade on another machine, or add `--unsandboxed` if you trust the code: it then has all your rights",
            ));
        }
        if bubblewrap {
            return Ok(Containment::in_bubblewrap(launcher, held));
        }
        let own_network = UNSHARE.into_iter().find(|unshare| {
            let inside = support(&mut in_front_of(unshare, &launcher));
            inside.is_ok_and(|inside| inside == held)
        });
        Ok(Containment::Sandbox {
            launcher,
            held,
            own_network,
            bubblewrap,
        })
    }

    /// The program that contains others; `None` where nothing is contained.
    pub fn launcher(&self) -> Option<&Path> {
        match self {
            Containment::Sandbox { launcher, .. } => Some(launcher),
            Containment::None => None,
        }
    }

    /// With bubblewrap in front of the launcher. It maps one user, so there is no other.
    fn in_bubblewrap(launcher: PathBuf, held: Support) -> Containment {
        Containment::Sandbox {
            launcher,
            held: Support {
                other_user: false,
                ..held
            },
            own_network: None,
            bubblewrap: true,
        }
    }

    /// This containment and those of machines that lack some of its means. For tests.
    pub fn levels(&self) -> Vec<Containment> {
        let Containment::Sandbox { launcher, held, .. } = self else {
            return vec![Containment::None];
        };
        let of = |held: Support| Containment::Sandbox {
            launcher: launcher.clone(),
            held,
            own_network: None,
            bubblewrap: false,
        };
        let other_user = false;
        let files = false;
        // A kernel without Landlock.
        let no_landlock = Support { files, ..*held };
        let no_landlock_and_seccomp = Support {
            system_calls: false,
            ..no_landlock
        };
        let mut levels = vec![
            self.clone(),
            of(Support {
                other_user,
                ..*held
            }),
            of(no_landlock),
            of(Support {
                other_user,
                ..no_landlock
            }),
            of(no_landlock_and_seccomp),
        ];
        if bubblewrap::works(launcher) {
            let less = [no_landlock, no_landlock_and_seccomp];
            levels.extend(less.map(|held| Containment::in_bubblewrap(launcher.clone(), held)));
        }
        levels
    }

    /// Whether code can open no file that is not its own, whatever it calls.
    pub fn closes_files(&self) -> bool {
        matches!(self, Containment::Sandbox { held, bubblewrap, .. } if held.files || *bubblewrap)
    }

    /// How the program ended that a command of this containment has run: bubblewrap reports a signal
    /// as an exit code.
    pub fn status_of_program(&self, status: ExitStatus) -> ExitStatus {
        match self {
            Containment::Sandbox {
                bubblewrap: true, ..
            } => bubblewrap::status_of_program(status),
            _ => status,
        }
    }

    /// Whether code is run by the launcher.
    pub fn is_sandbox(&self) -> bool {
        *self != Containment::None
    }

    /// Whether every thread of a worker gives up all rights.
    pub fn seals(&self) -> bool {
        matches!(self, Containment::Sandbox { held, .. } if held.system_calls)
    }

    /// The command that runs the worker `program`. Its arguments are to be added.
    pub fn worker(&self, program: &Path, limits: WorkerLimits) -> Command {
        let mut run = LOADERS.map(PathBuf::from).to_vec();
        run.push(program.to_path_buf());
        let mut read = LIBRARIES.map(PathBuf::from).to_vec();
        read.push(LIBRARY_CACHE.into());
        // The worker measures the time of the student's thread and counts its threads. It opens these
        // files and gives up the right before the student's code runs.
        read.extend(["/proc/self/task".into(), "/proc/self/status".into()]);
        let user = self.user();
        let policy = Policy {
            read,
            run,
            limits: Limits {
                cpu_seconds: Some(limits.cpu_seconds),
                memory_mb: Some(u64::from(limits.memory_mb) + WORKER_SPARE_MB),
                file_mb: Some(FILE_MB),
                threads: user.map(|_| WORKER_THREADS),
            },
            user,
            ..Policy::default()
        };
        let mut command = self.command(program, &policy);
        command
            .env_clear()
            // Otherwise every thread reserves 64 MB of address space.
            .env("MALLOC_ARENA_MAX", "2");
        command
    }

    /// The user as whom the next worker runs; the caller if `None`. Each has another one, so that
    /// none can use up what another needs.
    fn user(&self) -> Option<u32> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let Containment::Sandbox { held, .. } = self else {
            return None;
        };
        held.other_user.then(|| {
            let next = NEXT.fetch_add(1, Ordering::Relaxed);
            let of_this_process = std::process::id().wrapping_mul(37).wrapping_add(next);
            OTHER_USERS.start + of_this_process % (OTHER_USERS.end - OTHER_USERS.start)
        })
    }

    /// A command that runs `program`, limited to `policy` as far as this machine can. Without a
    /// sandbox nothing limits it.
    pub fn command(&self, program: &Path, policy: &Policy) -> Command {
        let Containment::Sandbox {
            launcher,
            held,
            own_network,
            bubblewrap,
        } = self
        else {
            return Command::new(program);
        };
        let policy = Policy {
            without: Without {
                landlock: !held.files,
                seccomp: !held.system_calls,
            },
            ..policy.clone()
        };
        let mut command = match own_network {
            _ if *bubblewrap => bubblewrap::command(launcher, &policy),
            Some(unshare) => in_front_of(unshare, launcher),
            None => Command::new(launcher),
        };
        command.args(policy.to_arguments()).arg(program);
        command
    }
}

/// One line for a report: what held, and what did not.
impl fmt::Display for Containment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Containment::Sandbox {
            held,
            own_network,
            bubblewrap,
            ..
        } = self
        else {
            return f.write_str(
                "none (--unsandboxed): the code had all rights of the person who graded it",
            );
        };
        let means = [
            ("Landlock", held.files),
            ("seccomp", held.system_calls),
            ("bubblewrap", *bubblewrap),
            ("limits of resources", true),
            ("another user", held.other_user),
            ("a network of its own", own_network.is_some()),
        ];
        let means: Vec<&str> = means
            .iter()
            .filter(|(_, holds)| *holds)
            .map(|(name, _)| *name)
            .collect();
        write!(
            f,
            "sandbox ({}) for the compiler and the code; not held: ",
            means.join(", ")
        )?;
        let user = match held.other_user {
            true => "every user",
            false => "the person who graded it",
        };
        match (self.closes_files(), held.system_calls) {
            (true, true) => {}
            (false, true) => f.write_str(
                "the compiler could read files of the person who graded, if the scan of the code missed a way, and then refused the code; ",
            )?,
            (files, false) => {
                if !files {
                    write!(f, "the code could read what {user} can read; ")?;
                }
                f.write_str("it could start programs, and read the memory of its worker; ")?;
                if own_network.is_none() && !bubblewrap {
                    f.write_str("it could use the network; ")?;
                }
            }
        }
        f.write_str(match held.system_calls {
            true => "code that breaks the compiler's checks can change how many tests it seems to make in whole scenes",
            false => "the code could change what it seems to have answered and counted",
        })
    }
}

/// The commands that can give a program an empty network of its own: the superuser's, and
/// everybody's where this is allowed.
const UNSHARE: [&[&str]; 2] = [
    &["/usr/bin/unshare", "--net", "--ipc", "--"],
    &[
        "/usr/bin/unshare",
        "--user",
        "--map-current-user",
        "--net",
        "--ipc",
        "--",
    ],
];

/// The command `unshare` with `launcher` as the program that it runs.
fn in_front_of(unshare: &[&str], launcher: &Path) -> Command {
    let mut command = Command::new(unshare[0]);
    command.args(&unshare[1..]).arg(launcher);
    command
}

/// Which limits hold here, as the command `launcher` finds out. One that fails holds nothing.
fn support(launcher: &mut Command) -> std::io::Result<Support> {
    let output = launcher
        .arg("probe")
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()?;
    let line = String::from_utf8_lossy(&output.stdout);
    Ok(Support::from_line(&line).unwrap_or_default())
}

/// Whether every user may enter `folder`: another user could not run anything in it otherwise.
#[cfg(unix)]
fn is_open_to_all(folder: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    const ENTER_BY_OTHERS: u32 = 0o001;
    folder.ancestors().all(|folder| {
        let metadata = folder.metadata();
        metadata.is_ok_and(|it| it.permissions().mode() & ENTER_BY_OTHERS != 0)
    })
}

/// Whether no other user may read what is in `folder`.
#[cfg(unix)]
fn is_closed_to_others(folder: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    const BY_OTHERS: u32 = 0o007;
    let metadata = folder.metadata();
    metadata.is_ok_and(|it| it.permissions().mode() & BY_OTHERS == 0)
}

#[cfg(not(unix))]
fn is_open_to_all(_: &Path) -> bool {
    false
}

#[cfg(not(unix))]
fn is_closed_to_others(_: &Path) -> bool {
    false
}
