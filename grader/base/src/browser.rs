//! Opens pages and pictures outside the terminal.

use std::ffi::OsStr;
use std::process::{Command, Stdio};

/// Opens the file or the address in the user's browser, or in the program for files of its kind.
/// Returns whether there is one: a machine without a screen has none.
pub fn open(page: impl AsRef<OsStr>) -> bool {
    let Some(mut command) = command(page.as_ref()) else {
        return false;
    };
    let quiet = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    quiet.spawn().is_ok()
}

/// Whether files can be opened: on a machine with a screen, and on Linux only with `xdg-open`.
pub fn is_there() -> bool {
    let Some(command) = command(OsStr::new("")) else {
        return false;
    };
    let program = command.get_program();
    let folders = std::env::var_os("PATH").unwrap_or_default();
    cfg!(windows) || std::env::split_paths(&folders).any(|folder| folder.join(program).is_file())
}

fn command(page: &OsStr) -> Option<Command> {
    if cfg!(windows) {
        let mut command = Command::new("cmd");
        command.args(["/C", "start", ""]).arg(page);
        return Some(command);
    }
    if cfg!(target_os = "macos") {
        let mut command = Command::new("open");
        command.arg(page);
        return Some(command);
    }
    let has_screen = ["DISPLAY", "WAYLAND_DISPLAY"]
        .iter()
        .any(|name| std::env::var_os(name).is_some_and(|value| !value.is_empty()));
    has_screen.then(|| {
        let mut command = Command::new("xdg-open");
        command.arg(page);
        command
    })
}
