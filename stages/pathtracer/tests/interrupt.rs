//! Ctrl-C while the `pathtracer` program renders.
#![cfg(unix)]

use pathtracer::SumsFile;
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

/// A hundred times what a program takes that ends after its first signal, on a slow machine.
const LIMIT: Duration = Duration::from_secs(1000);

/// Starts a long rendering in `folder`, and returns when the program handles Ctrl-C.
fn start(folder: &Path, samples: &str, flags: &[&str]) -> Child {
    let mut program = Command::new(env!("CARGO_BIN_EXE_pathtracer"))
        .current_dir(folder)
        .args(["-s", samples, "-r", "64", "64", SCENE])
        .args(flags)
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
    program
}

/// Sends the signal twice. One shell does, so that nothing comes between.
fn interrupt_twice(program: &Child) {
    let sent = Command::new("sh")
        .args(["-c", "kill -INT $1; kill -INT $1", "sh"])
        .arg(program.id().to_string())
        .status();
    assert!(sent.expect("a shell").success());
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
    let program = start(folder.path(), "1048576", &["-f", "a.png"]);
    interrupt_twice(&program);
    assert_eq!(end(program).code(), Some(130));
    let picture = fs::metadata(folder.path().join("a.png")).expect("a picture");
    assert!(picture.len() > 0);
}

/// Each pixel has samples, those of a first pass at least, and the file can be merged.
#[test]
fn an_adaptive_part_that_is_interrupted_keeps_its_samples() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = start(
        folder.path(),
        "4096",
        &["-a", "64", "0.001", "-f", "a.sums"],
    );
    interrupt_twice(&program);
    assert_eq!(end(program).code(), Some(130));
    let file = SumsFile::read(&folder.path().join("a.sums")).expect("a file of sums");
    assert!(file.head.adaptive && file.head.samples == 4096);
    let samples = file.pixels.iter().map(|pixel| pixel.mean().samples);
    assert_eq!(samples.min(), Some(2));
}
