//! `grader bless`: takes what the reference answers now as golden.

use clap::{Arg, ArgAction, ArgMatches, Command};
use grader::cli::Verdict;
use grader::course::Course;
use grader::error::GraderError;
use grader::workspace::Workspace;
use review::bless;
use std::io::{IsTerminal, Write};
use std::path::Path;

pub(crate) fn command() -> Command {
    Command::new("bless")
        .about("For instructors: accepts what the reference computes now as golden, after showing what that changes")
        .arg(
            Arg::new("what")
                .value_name("WHAT")
                .default_value("all")
                .help("Whose goldens: `all`, a part such as `part1`, or a task such as `part1.task3`"),
        )
        .arg(
            Arg::new("yes")
                .long("yes")
                .action(ArgAction::SetTrue)
                .help("Write without asking"),
        )
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Verdict, GraderError> {
    let what = matches
        .get_one::<String>("what")
        .map_or("all", String::as_str);
    let workspace = Workspace::above(Path::new("."))?;
    Course::read(&workspace)?.select(what)?;
    let proposed = bless::propose(&workspace, what)?;
    if proposed.is_empty() {
        println!("The goldens are what the reference answers: nothing changes.");
        return Ok(Verdict::Passed);
    }
    for change in &proposed {
        let golden = change
            .golden
            .strip_prefix(workspace.root())
            .unwrap_or(&change.golden);
        println!("{}: {}", golden.display(), change.meaning);
    }
    if matches.get_flag("yes") || agreed(proposed.len())? {
        bless::accept(&workspace, &proposed)?;
        println!("{} goldens written.", proposed.len());
        return Ok(Verdict::Passed);
    }
    bless::reject(&proposed)?;
    println!("Nothing written.");
    Ok(Verdict::Failed)
}

/// Asks on the terminal; without one nobody can agree.
fn agreed(goldens: usize) -> Result<bool, GraderError> {
    if !std::io::stdin().is_terminal() {
        println!("Say `--yes` to write them without being asked.");
        return Ok(false);
    }
    print!("Write these {goldens} goldens? [y/N] ");
    let mut answer = String::new();
    let asked = std::io::stdout()
        .flush()
        .and_then(|()| std::io::stdin().read_line(&mut answer));
    asked.map_err(|e| GraderError::new(format!("cannot ask: {e}")))?;
    Ok(answer.trim().eq_ignore_ascii_case("y"))
}
