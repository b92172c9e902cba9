//! The command `grader bless`: stores the reference's current answers as goldens.

use clap::{Arg, ArgAction, ArgMatches, Command};
use grader::cli::Verdict;
use grader::course::Course;
use grader::error::GraderError;
use grader::workspace::Workspace;
use judge::plural;
use review::bless::{self, Change};
use std::io::{IsTerminal, Write};
use std::path::Path;

pub(crate) fn command() -> Command {
    Command::new("bless")
        .about("For instructors: shows how the reference's results differ from the goldens, then stores them as new goldens")
        .arg(
            Arg::new("what")
                .value_name("WHAT")
                .default_value("all")
                .help("The goldens to update: `all`, a part such as `part1`, or a task such as `part1.task3`"),
        )
        .arg(
            Arg::new("yes")
                .long("yes")
                .action(ArgAction::SetTrue)
                .help("Write the goldens without asking for confirmation"),
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
        println!("The goldens are up to date.");
        return Ok(Verdict::Passed);
    }
    for change in &proposed {
        let golden = change
            .golden
            .strip_prefix(workspace.root())
            .unwrap_or(&change.golden);
        println!("{}: {}", golden.display(), change.meaning);
        for aspect in &change.not_judged {
            println!("  not judged: {aspect}");
        }
    }
    println!("{}", verdict(&proposed));
    if matches.get_flag("yes") || confirmed(proposed.len())? {
        bless::accept(&workspace, &proposed)?;
        println!("{} goldens written.", proposed.len());
        return Ok(Verdict::Passed);
    }
    bless::reject(&proposed)?;
    println!("No golden was written.");
    Ok(Verdict::Failed)
}

/// What the exact oracle says about the new answers.
fn verdict(proposed: &[Change]) -> String {
    let open = proposed
        .iter()
        .filter(|change| !change.not_judged.is_empty());
    match open.count() {
        0 => "The exact oracle confirms every answer of these cases.".into(),
        open => format!(
            "The exact oracle finds no answer wrong, but it does not judge all aspects of {}: look at \
             what is listed as not judged yourself, with `grader review`.",
            plural(open, "golden", "goldens")
        ),
    }
}

/// Asks for confirmation on the terminal. Without a terminal the answer is no.
fn confirmed(goldens: usize) -> Result<bool, GraderError> {
    if !std::io::stdin().is_terminal() {
        println!("Add `--yes` to write them without confirmation.");
        return Ok(false);
    }
    print!("Write these {goldens} goldens? [y/N] ");
    let mut answer = String::new();
    let prompted = std::io::stdout()
        .flush()
        .and_then(|()| std::io::stdin().read_line(&mut answer));
    prompted.map_err(|e| GraderError::new(format!("cannot ask for confirmation: {e}")))?;
    Ok(answer.trim().eq_ignore_ascii_case("y"))
}
