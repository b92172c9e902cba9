//! Builds and runs the programs beside `grader`, such as `grader cost` and `grader review`.
//!
//! Cargo builds each of them on its first use.

use super::programs::LOOK;
use crate::build;
use base::program::{Exit, HELP, help_in};
use base::{GraderError, Workspace, errln, outln};
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

/// The commands whose programs are built in seconds.
const SMALL: [&str; 3] = [LOOK, "start", "handout"];

/// Prints the help of the command that `arguments` name, if they ask for it, without building its
/// program. Returns whether they do.
fn print_help(manifest: &Path, arguments: &[OsString]) -> bool {
    if !arguments.iter().any(|it| it == "--help" || it == "-h") {
        return false;
    }
    let words: Vec<&str> = arguments
        .iter()
        .map_while(|it| it.to_str().filter(|word| !word.starts_with('-')))
        .collect();
    let text = std::fs::read_to_string(manifest.join(HELP)).unwrap_or_default();
    match help_in(&text, &words) {
        Some(help) => outln!("{}", help.trim_end()),
        // A handout.
        None => outln!("This command is for instructors: the course's full checkout has its help."),
    }
    true
}

/// Builds the program of `package` and runs it with `arguments`. On Unix it replaces this process.
pub fn run(package: &str, arguments: Vec<OsString>) -> Result<Exit, GraderError> {
    // The program itself says whether a term's files have to be applied first.
    let workspace = Workspace::above_as_it_is(Path::new("."))?;
    let manifest = workspace.root().join("grader").join(package);
    if !manifest.join("Cargo.toml").is_file() {
        return Err(GraderError::new(format!(
            "{} is a handout, and a handout does not have this command. Run it in the course's full checkout",
            workspace.root().display()
        )));
    }
    if print_help(&manifest, &arguments) {
        return Ok(Exit::Passed);
    }
    if !is_built(package) {
        let is_first = |name| arguments.first().is_some_and(|command| command == name);
        let how_long = match SMALL.iter().any(is_first) {
            true => "ten to thirty seconds",
            false => "one or two minutes",
        };
        errln!(
            "The program of this command is built once, with the libraries that only it needs: {how_long} of processor \
             time. After that it starts at once."
        );
    }
    let program = build::build_program(workspace.root(), package)?
        .map_err(|_| GraderError::new(format!("the package {package} does not compile")))?;
    let mut command = Command::new(&program);
    command.args(arguments);
    exec_or_wait(&mut command).map_err(|e| GraderError::file("run", &program, e))
}

/// Whether the program of `package` was ever built: cargo writes it beside this one.
fn is_built(package: &str) -> bool {
    let file = format!("{package}{}", std::env::consts::EXE_SUFFIX);
    std::env::current_exe().is_ok_and(|ours| ours.with_file_name(file).is_file())
}

#[cfg(unix)]
fn exec_or_wait(command: &mut Command) -> std::io::Result<Exit> {
    Err(std::os::unix::process::CommandExt::exec(command))
}

#[cfg(not(unix))]
fn exec_or_wait(command: &mut Command) -> std::io::Result<Exit> {
    match command.status()?.code() {
        Some(0) => Ok(Exit::Passed),
        Some(1) => Ok(Exit::Failed),
        code => std::process::exit(code.unwrap_or(2)),
    }
}
