//! The fast core of the hostile code: some of each kind, run under every level of containment that
//! this machine has. Nothing is built for it: this program is the worker, too, as in
//! `grader/tests/ends.rs`. The launcher starts it with the rights of a submission.
//!
//! `attempts` are ways out, each of which must fail; `spoilers` are ways to spoil the run, each of
//! which must end its own case and no other.

#[cfg(target_os = "linux")]
mod attempts;
#[cfg(target_os = "linux")]
mod linux;
#[cfg(target_os = "linux")]
mod spoilers;

use std::process::ExitCode;

#[cfg(target_os = "linux")]
fn main() -> ExitCode {
    linux::main()
}

#[cfg(not(target_os = "linux"))]
fn main() -> ExitCode {
    println!("this system has none of the means");
    ExitCode::SUCCESS
}
