//! `grader course check`: does the course keep its word?

use authoring::check;
use clap::{Arg, ArgAction, ArgMatches, Command};
use grader::cli::Verdict;
use grader::error::GraderError;
use grader::workspace::Workspace;
use std::path::Path;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// Whoever hears nothing for so long wonders whether the program lives.
const SILENCE: Duration = Duration::from_secs(20);

pub(crate) fn command() -> Command {
    let check = Command::new("check")
        .about("Checks that the course holds together: lists, goldens, the reference's score, and every handout, built and graded")
        .arg(
            Arg::new("quick")
                .long("quick")
                .action(ArgAction::SetTrue)
                .help("Only what can be checked without building anything"),
        );
    Command::new("course")
        .about("For instructors: checks the course itself")
        .subcommand_required(true)
        .subcommand(check)
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Verdict, GraderError> {
    let (_, matches) = matches.subcommand().expect("clap asks for it");
    let quick = matches.get_flag("quick");
    let workspace = Workspace::above(Path::new("."))?;
    let start = Instant::now();
    let tell = |doing: &str| eprintln!("[{:4} s] {doing}", start.elapsed().as_secs());
    let (done, waits) = mpsc::channel();
    let complaints = thread::scope(|scope| {
        scope.spawn(move || {
            while let Err(RecvTimeoutError::Timeout) = waits.recv_timeout(SILENCE) {
                tell("  ... still at it");
            }
        });
        let complaints = check::course(&workspace, !quick, tell);
        // The other thread waits until nobody is left who could send.
        drop::<Sender<()>>(done);
        complaints
    })?;
    for complaint in &complaints {
        println!("{complaint}");
    }
    if complaints.is_empty() {
        println!(
            "The course holds together ({} s).",
            start.elapsed().as_secs()
        );
        return Ok(Verdict::Passed);
    }
    match complaints.len() {
        1 => println!("1 complaint."),
        many => println!("{many} complaints."),
    }
    Ok(Verdict::Failed)
}
