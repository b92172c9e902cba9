//! The commands `grader course check`, which checks the course before it is handed out, and `grader
//! course diff`, which compares it with another version.

use authoring::{check, diff};
use base::program::Exit;
use base::{GraderError, Workspace, errln, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// After this time without output the program prints that it is still running.
const MAX_SILENCE: Duration = Duration::from_secs(20);

pub(crate) fn command() -> Command {
    let check = Command::new("check")
        .about("Checks the lists of cases and goldens, and the reference's score; then creates, builds and grades every handout")
        .arg(
            Arg::new("quick")
                .long("quick")
                .action(ArgAction::SetTrue)
                .help("Run only the checks that build nothing"),
        );
    let diff = Command::new("diff")
        .about(
            "Lists the cases, points and goldens that changed since another version of the course",
        )
        .arg(
            Arg::new("old")
                .value_name("OLD")
                .required(true)
                .value_parser(value_parser!(PathBuf))
                .help("The top folder of the older version: a checkout, or a handout"),
        );
    Command::new("course")
        .about("For instructors: checks the course itself, compares it with another version")
        .subcommand_required(true)
        .subcommands([check, diff])
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    match matches.subcommand().expect("clap requires it") {
        ("check", matches) => run_check(matches),
        (_, matches) => run_diff(matches),
    }
}

fn run_diff(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let old: &PathBuf = matches.get_one("old").expect("clap requires it");
    let old = Workspace::of_any_version(old)?;
    let new = Workspace::above(Path::new("."))?;
    out!("{}", diff::table(&diff::changes(&old, &new)?, &old, &new));
    Ok(Exit::Passed)
}

fn run_check(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let quick = matches.get_flag("quick");
    let workspace = Workspace::above(Path::new("."))?;
    let start = Instant::now();
    let print = |step: &str| errln!("[{:4} s] {step}", start.elapsed().as_secs());
    let (sender, receiver) = mpsc::channel();
    let problems = thread::scope(|scope| {
        scope.spawn(move || {
            while let Err(RecvTimeoutError::Timeout) = receiver.recv_timeout(MAX_SILENCE) {
                print("  ... still running");
            }
        });
        let problems = check::course(&workspace, !quick, print);
        // The other thread ends when the last sender is dropped.
        drop::<Sender<()>>(sender);
        problems
    })?;
    for problem in &problems {
        outln!("{problem}");
    }
    if problems.is_empty() {
        outln!(
            "The course has no problems ({} s).",
            start.elapsed().as_secs()
        );
        return Ok(Exit::Passed);
    }
    match problems.len() {
        1 => outln!("1 problem found."),
        many => outln!("{many} problems found."),
    }
    Ok(Exit::Failed)
}
