//! The launcher: `sandbox [OPTIONS] -- PROGRAM ARGUMENTS` gives up every right that the options do
//! not name and becomes the program. `sandbox probe` prints which limits hold on this machine.
//!
//! It contains no code of a student's. If a limit cannot be set, nothing is run.

use sandbox::policy::Policy;
use sandbox::{confine, probe};
use std::ffi::OsString;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    if arguments.iter().eq(["probe"]) {
        println!("{}", probe::of_this_machine().to_line());
        return ExitCode::SUCCESS;
    }
    if arguments.iter().eq(["nothing"]) {
        // `probe` starts this as another user.
        return ExitCode::SUCCESS;
    }
    let Err(why) = launch(arguments);
    eprintln!("sandbox: {why}");
    ExitCode::from(probe::LAUNCHER_FAILED)
}

fn launch(arguments: Vec<OsString>) -> Result<std::convert::Infallible, String> {
    let (policy, program) = Policy::from_arguments(arguments.into_iter())?;
    confine::enter(&policy)?;
    let [name, arguments @ ..] = program.as_slice() else {
        return Err("expected a program after `--`".into());
    };
    let mut command = std::process::Command::new(name);
    command.args(arguments);
    become_program(command, &policy)
        .map_err(|e| format!("cannot run {}: {e}", name.to_string_lossy()))
}

#[cfg(unix)]
fn become_program(
    mut command: std::process::Command,
    policy: &Policy,
) -> std::io::Result<std::convert::Infallible> {
    use std::os::unix::process::CommandExt;
    // Its path names folders of the person who grades. A program that starts others looks for them
    // beside itself.
    let name = std::path::Path::new(command.get_program()).file_name();
    if let Some(name) = name.filter(|_| !policy.processes) {
        let name = name.to_owned();
        command.arg0(name);
    }
    if let Some(user) = policy.user {
        command.gid(user).uid(user);
    }
    Err(command.exec())
}

#[cfg(not(unix))]
fn become_program(
    mut command: std::process::Command,
    _: &Policy,
) -> std::io::Result<std::convert::Infallible> {
    let code = command
        .status()?
        .code()
        .unwrap_or(i32::from(probe::LAUNCHER_FAILED));
    std::process::exit(code)
}
