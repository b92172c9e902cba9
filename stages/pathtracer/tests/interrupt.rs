//! Ctrl-C while the `pathtracer` program renders.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Spheres to render for hours.
const SCENE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../scenes/dae/cornell_spheres.dae"
);

/// From the last line before the rendering until it has certainly begun.
const START: Duration = Duration::from_millis(500);

/// Longer than a program takes that ends after its first signal.
const LIMIT: Duration = Duration::from_secs(60);

/// Starts a long rendering to `folder/a.png`.
fn start(folder: &Path) -> Child {
    let mut program = Command::new(env!("CARGO_BIN_EXE_pathtracer"))
        .current_dir(folder)
        .args(["-s", "1048576", "-r", "64", "64", "-f", "a.png", SCENE])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    // The rest of the output has room in the pipe.
    let output = BufReader::new(program.stdout.as_mut().expect("a pipe"));
    let mut lines = output.lines().map_while(Result::ok);
    assert!(
        lines.any(|line| line.contains("BVH")),
        "the tree is reported"
    );
    sleep(START);
    program
}

fn interrupt(program: &Child) {
    let id = program.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("the program `kill`").success());
}

fn end(mut program: Child) -> ExitStatus {
    let start = Instant::now();
    while start.elapsed() < LIMIT {
        if let Some(status) = program.try_wait().expect("a child") {
            return status;
        }
        sleep(Duration::from_millis(10));
    }
    program.kill().expect("a child");
    panic!("Ctrl-C does not end the program");
}

/// The second signal is the same Ctrl-C: `timeout -s INT` sends two.
#[test]
fn two_signals_at_once_are_one_ctrl_c() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = start(folder.path());
    interrupt(&program);
    interrupt(&program);
    assert_eq!(end(program).code(), Some(130));
    let picture = fs::metadata(folder.path().join("a.png")).expect("a picture");
    assert!(picture.len() > 0);
}
