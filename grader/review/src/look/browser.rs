//! Opens a page in the browser.

use std::path::Path;
use std::process::{Command, Stdio};

/// Opens the file in the user's browser. Returns whether there is one: a machine without a screen
/// has none.
pub fn open(page: &Path) -> bool {
    let Some(mut command) = command(page) else {
        return false;
    };
    let quiet = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    quiet.spawn().is_ok()
}

fn command(page: &Path) -> Option<Command> {
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
