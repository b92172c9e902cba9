//! [bubblewrap](https://github.com/containers/bubblewrap), in place of Landlock on kernels that do not
//! have it: a program runs in a file system with the files of its policy and nothing else.
//!
//! It needs the right to make namespaces, which some systems and most containers do not give.

use sandbox::Policy;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

/// Where distributions put it. Not the first one on the path: that may be anything.
const PROGRAM: &str = "/usr/bin/bwrap";

/// A user, a network, processes and a name of its own, and an end with the grader.
const OPTIONS: [&str; 10] = [
    "--unshare-user",
    "--unshare-net",
    "--unshare-ipc",
    "--unshare-pid",
    "--unshare-uts",
    "--die-with-parent",
    "--proc",
    "/proc",
    "--dev",
    "/dev",
];

/// Programs are found through links here: `cc`, for example.
const LINKS_TO_PROGRAMS: &str = "/etc/alternatives";

/// What [`OPTIONS`] make anew.
const MADE_ANEW: [&str; 2] = ["/proc", "/dev"];

/// The command that runs `launcher` with the files of `policy`. Its arguments are to be added.
pub(crate) fn command(launcher: &Path, policy: &Policy) -> Command {
    let (read, write) = ("--ro-bind-try", "--bind-try");
    let links = [PathBuf::from(LINKS_TO_PROGRAMS)];
    let launcher_too = [launcher.to_path_buf()];
    let files = [
        (read, links.as_slice()),
        (read, &launcher_too),
        (read, &policy.read),
        (read, &policy.run),
        (write, &policy.write),
    ];
    let files = files
        .iter()
        .flat_map(|(option, paths)| paths.iter().map(move |path| (path, option)));
    let is_made_anew = |path: &Path| MADE_ANEW.iter().any(|made| path.starts_with(made));
    let mut files: Vec<_> = files.filter(|(path, _)| !is_made_anew(path)).collect();
    // What is in a folder comes after it, and covers what is there; so does the right to write.
    files.sort_by_key(|(path, option)| (*path, **option == write));
    let mut command = Command::new(PROGRAM);
    command.args(OPTIONS);
    let mut bound: Vec<(&Path, &str)> = Vec::new();
    for (path, option) in files {
        // It may be a link, which bubblewrap cannot cover, in a folder that has it already.
        let around = bound.iter().rfind(|(folder, _)| path.starts_with(folder));
        if around.is_none_or(|(_, of_folder)| of_folder != option) {
            command.arg(option).args([path, path]);
            bound.push((path, option));
        }
    }
    command.arg("--").arg(launcher);
    command
}

/// Whether it can run `launcher` here.
pub(crate) fn works(launcher: &Path) -> bool {
    let policy = Policy {
        run: ["/lib", "/lib64", "/usr/lib"].map(PathBuf::from).to_vec(),
        ..Policy::default()
    };
    let status = command(launcher, &policy)
        .arg("nothing")
        .env_clear()
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    status.is_ok_and(|status| status.success())
}

/// How the program ended that it ran: it exits with 128 and the number of the signal that ended the
/// program.
#[cfg(unix)]
pub(crate) fn status_of_program(status: ExitStatus) -> ExitStatus {
    use std::os::unix::process::ExitStatusExt;
    match status.code() {
        Some(code @ 129..=192) => ExitStatus::from_raw(code - 128),
        _ => status,
    }
}

#[cfg(not(unix))]
pub(crate) fn status_of_program(status: ExitStatus) -> ExitStatus {
    status
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_come_before_what_is_in_them() {
        let policy = Policy {
            read: ["/a/b/c", "/dev/urandom", "/proc/self/task"]
                .map(PathBuf::from)
                .to_vec(),
            run: vec!["/a".into()],
            write: vec!["/a/b".into(), "/dev/null".into()],
            ..Policy::default()
        };
        let command = command(Path::new("/a/launcher"), &policy);
        let words: Vec<_> = command
            .get_args()
            .map(|word| word.to_string_lossy())
            .collect();
        let words = words[OPTIONS.len()..].join(" ");
        assert_eq!(
            words,
            "--ro-bind-try /a /a --bind-try /a/b /a/b --ro-bind-try /a/b/c /a/b/c --ro-bind-try /etc/alternatives /etc/alternatives -- /a/launcher"
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_signal_is_an_exit_code() {
        use std::os::unix::process::ExitStatusExt;
        let signal = |code: i32| status_of_program(ExitStatus::from_raw(code << 8)).signal();
        assert_eq!(
            [0, 1, 128, 134, 139].map(signal),
            [None, None, None, Some(6), Some(11)]
        );
    }
}
