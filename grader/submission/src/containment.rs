//! How the code of submissions is contained: what this machine can do, and what is said about it.

use base::GraderError;
use base::Workspace;
use grader::build;
use sandbox::Support;
pub use sandbox::{Limits, Policy};
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The user as whom the superuser runs code: `nobody`, who owns no files.
const NOBODY: u32 = 65534;

/// What keeps the code of a submission from everything that is not its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Containment {
    /// Code is compiled and run by the launcher.
    Sandbox {
        /// The launcher.
        launcher: PathBuf,
        /// As whom it runs code; the caller if `None`. The compiler runs as the caller.
        user: Option<u32>,
        /// The command in front of the launcher for an empty network of its own; `None` where this
        /// is not allowed.
        own_network: Option<&'static [&'static str]>,
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
        let held = support(&mut Command::new(&launcher))
            .map_err(|e| GraderError::file("run", &launcher, e))?;
        if !held.contains() {
            return Err(GraderError::new(
                "this machine cannot contain the code of a submission: it needs Linux 5.13 or newer with Landlock and seccomp. Grade on another machine, or add `--unsandboxed` if you trust the code: it then has all your rights",
            ));
        }
        let own_network = UNSHARE.into_iter().find(|unshare| {
            let held = support(&mut in_front_of(unshare, &launcher));
            held.is_ok_and(Support::contains)
        });
        Ok(Containment::Sandbox {
            user: (held.other_user && is_open_to_all(workspace.root())).then_some(NOBODY),
            launcher,
            own_network,
        })
    }

    /// Whether code cannot leave its folders.
    pub fn is_sandbox(&self) -> bool {
        *self != Containment::None
    }

    /// The user as whom the code of a submission runs; the caller if `None`.
    pub(crate) fn user(&self) -> Option<u32> {
        match self {
            Containment::Sandbox { user, .. } => *user,
            Containment::None => None,
        }
    }

    /// A command that runs `program`, limited to `policy`. Without a sandbox nothing limits it.
    pub fn command(&self, program: &Path, policy: &Policy) -> Command {
        let Containment::Sandbox {
            launcher,
            own_network,
            ..
        } = self
        else {
            return Command::new(program);
        };
        let mut command = match own_network {
            Some(unshare) => in_front_of(unshare, launcher),
            None => Command::new(launcher),
        };
        command.args(policy.to_arguments()).arg(program);
        command
    }
}

/// One line for a report.
impl fmt::Display for Containment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Containment::Sandbox {
                user, own_network, ..
            } => {
                f.write_str("sandbox (Landlock, seccomp, limits of resources")?;
                if user.is_some() {
                    f.write_str(", another user")?;
                }
                if own_network.is_some() {
                    f.write_str(", a network of its own")?;
                }
                f.write_str(") for the compiler and the code")
            }
            Containment::None => f.write_str(
                "none (--unsandboxed): the code had all rights of the person who graded it",
            ),
        }
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

#[cfg(not(unix))]
fn is_open_to_all(_: &Path) -> bool {
    false
}
