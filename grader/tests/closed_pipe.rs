//! The program ends quietly if nobody reads what it prints, as in `grader status | head -1`.

use std::process::{Command, Stdio};

/// A pipe whose reader has gone.
fn closed_pipe() -> Stdio {
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    writer.into()
}

#[test]
fn a_closed_pipe_is_no_error() {
    for arguments in [
        &["--help"][..],
        &["--version"],
        &["help", "instructors"],
        &["status"],
        &["explain", "part1.task3"],
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_grader"))
            .args(arguments)
            .stdout(closed_pipe())
            .output()
            .expect("it runs");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {stderr}");
        assert_eq!(stderr, "", "{arguments:?}");
        // Both outputs, as in `grader status 2>&1 | head -1`.
        let status = Command::new(env!("CARGO_BIN_EXE_grader"))
            .args(arguments)
            .stdout(closed_pipe())
            .stderr(closed_pipe())
            .status()
            .expect("it runs");
        assert_eq!(status.code(), Some(0), "{arguments:?}");
    }
}

#[test]
fn the_exit_code_of_an_error_is_the_same_if_nobody_reads_the_error() {
    let status = Command::new(env!("CARGO_BIN_EXE_grader"))
        .arg("part99")
        .stderr(closed_pipe())
        .status()
        .expect("it runs");
    assert_eq!(status.code(), Some(2));
}

/// `/dev/full` is a disk without room.
#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    let full = std::fs::File::options()
        .write(true)
        .open("/dev/full")
        .expect("Linux has it");
    let output = Command::new(env!("CARGO_BIN_EXE_grader"))
        .arg("status")
        .stdout(full)
        .output()
        .expect("it runs");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(
        stderr.starts_with("error: cannot write to the standard output: "),
        "{stderr}"
    );
}
