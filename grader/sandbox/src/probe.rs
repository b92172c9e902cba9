//! Tries which limits hold on this machine.

/// The exit code of the launcher if it did not start the program.
pub const LAUNCHER_FAILED: u8 = 125;

/// The users as whom the superuser runs code, each program as another. They are those that a system
/// gives to services for as long as they run, and own no files; the last one is `nobody`.
pub const OTHER_USERS: std::ops::Range<u32> = 61_184..65_534;

/// The limits that hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Support {
    /// Files that a policy does not list cannot be read.
    pub files: bool,
    /// Denied system calls fail: no sockets, no processes.
    pub system_calls: bool,
    /// The launcher runs as the superuser, so that it can run a program as another user.
    pub other_user: bool,
}

impl Support {
    /// One line that [`Support::from_line`] reads.
    pub fn to_line(self) -> String {
        let named = [
            (self.files, "files"),
            (self.system_calls, "system-calls"),
            (self.other_user, "other-user"),
        ];
        let held = named.iter().filter(|(holds, _)| *holds);
        let names: Vec<&str> = held.map(|(_, name)| *name).collect();
        format!("holds: {}", names.join(" "))
    }

    /// Reads the output of `sandbox probe`; `None` if it is something else.
    pub fn from_line(line: &str) -> Option<Support> {
        let names = line.trim().strip_prefix("holds:")?;
        let has = |name: &str| names.split_whitespace().any(|held| held == name);
        Some(Support {
            files: has("files"),
            system_calls: has("system-calls"),
            other_user: has("other-user"),
        })
    }
}

/// Gives up all rights of this process and tries what it can still do. Nothing useful can follow.
#[cfg(target_os = "linux")]
pub fn of_this_machine() -> Support {
    use crate::confine;
    let other_user = can_change_user();
    let landlock_only = crate::Policy {
        without: crate::Without {
            seccomp: true,
            ..Default::default()
        },
        ..Default::default()
    };
    if let Err(why) = confine::enter(&landlock_only) {
        eprintln!("sandbox: {why}");
        return Support::default();
    }
    let is_denied = |e: std::io::Error| e.kind() == std::io::ErrorKind::PermissionDenied;
    let files = std::fs::read_dir("/").is_err_and(is_denied);
    let entered = confine::enter(&crate::Policy::default());
    let socket = std::net::UdpSocket::bind("127.0.0.1:0");
    let sealed = confine::seal_thread();
    // Landlock says nothing about whether a file exists: only a denied call does not.
    let exists = std::fs::metadata("/");
    Support {
        files,
        system_calls: entered.is_ok()
            && sealed.is_ok()
            && socket.is_err_and(is_denied)
            && exists.is_err_and(is_denied),
        other_user,
    }
}

/// Whether a program can be run as another user: only the superuser can, and in a namespace only as a
/// user that is mapped there.
#[cfg(target_os = "linux")]
fn can_change_user() -> bool {
    use std::os::unix::process::CommandExt;
    let Ok(this) = std::env::current_exe() else {
        return false;
    };
    let mut nothing = std::process::Command::new(this);
    nothing
        .arg("nothing")
        .gid(OTHER_USERS.end)
        .uid(OTHER_USERS.end);
    match nothing.status() {
        Ok(status) => status.success(),
        // That user may not enter this folder: the change itself was not refused.
        Err(e) => e.raw_os_error() == Some(libc::EACCES),
    }
}

/// Nothing holds: this system has none of the means.
#[cfg(not(target_os = "linux"))]
pub fn of_this_machine() -> Support {
    Support::default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_read_back() {
        for bits in 0..8 {
            let support = Support {
                files: bits & 1 > 0,
                system_calls: bits & 2 > 0,
                other_user: bits & 4 > 0,
            };
            assert_eq!(Support::from_line(&support.to_line()), Some(support));
        }
        assert_eq!(Support::from_line("bash: sandbox: not found"), None);
    }
}
