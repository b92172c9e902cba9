//! Without `-f`: opens the window, the program `viewer`.
//!
//! This program does not link the window's libraries. It runs `viewer`, which cargo builds inside a
//! workspace, so that it contains the stages as they are now; elsewhere a `viewer` beside this
//! program is used.

use crate::failure::Failure;
use base::errln;
use pathtracer::args::{Args, has_display};
use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Runs `viewer` with the arguments of this program. On Unix it replaces this process.
pub(crate) fn open(args: &Args) -> Result<ExitCode, Failure> {
    let scene = args.scene.display();
    let instead = format!("add -f and the file to write, as in pathtracer -f picture.png {scene}");
    if !has_display() {
        return Err(Failure::Input(format!(
            "there is no display to open a window on: set DISPLAY or WAYLAND_DISPLAY, or {instead}"
        )));
    }
    let folder = env::current_dir().unwrap_or_default();
    let mut command = match (workspace_above(&folder), viewer_beside()) {
        (Some(root), _) => {
            errln!("note: without -f the window opens; its first build takes a few minutes");
            let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
            cargo.args(["run", "--quiet", "--release", "--package", "viewer"]);
            cargo.arg("--manifest-path").arg(root.join("Cargo.toml"));
            cargo.arg("--");
            cargo
        }
        (None, Some(viewer)) => Command::new(viewer),
        (None, None) => {
            return Err(Failure::Input(format!(
                "there is no window here: run this inside the course's folder, put the program viewer beside \
                 pathtracer, or {instead}"
            )));
        }
    };
    command.args(env::args_os().skip(1));
    run(&mut command)
        .map_err(|why| Failure::Input(format!("cannot open the window: {why}: {instead}")))
}

/// The workspace with the package `viewer` that contains `folder`.
fn workspace_above(folder: &Path) -> Option<PathBuf> {
    let has_viewer = |folder: &&Path| folder.join("stages/viewer/Cargo.toml").is_file();
    folder.ancestors().find(has_viewer).map(Path::to_owned)
}

/// The program `viewer` in the folder of this program.
fn viewer_beside() -> Option<PathBuf> {
    let name = format!("viewer{}", env::consts::EXE_SUFFIX);
    let viewer = env::current_exe().ok()?.with_file_name(name);
    viewer.is_file().then_some(viewer)
}

#[cfg(unix)]
fn run(command: &mut Command) -> io::Result<ExitCode> {
    Err(std::os::unix::process::CommandExt::exec(command))
}

#[cfg(not(unix))]
fn run(command: &mut Command) -> io::Result<ExitCode> {
    let code = command.status()?.code().unwrap_or(2);
    std::process::exit(code)
}
