//! The command `grader book`: opens the chapter of a task in the browser.

use crate::book;
use crate::course::Course;
use crate::progress::next_task;
use base::program::Exit;
use base::{GraderError, Workspace, browser, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use std::path::Path;

/// The name of the command.
pub(super) const NAME: &str = "book";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Opens the book at the chapter of a task, in the browser; needs no network")
        .arg(Arg::new("chapter").value_name("TASK[#SECTION]").help(
            "A task such as `part1.task3`, a part, or another chapter such as `hard-cases` [default: the next open task]",
        ))
        .arg(
            Arg::new("print-path")
                .long("print-path")
                .action(ArgAction::SetTrue)
                .help("Print the path of the page without opening it"),
        )
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let what = match matches.get_one::<String>("chapter") {
        Some(what) => what.clone(),
        None => {
            let course = Course::read(&workspace)?;
            next_task::or_last(&workspace, &course)?.key.clone()
        }
    };
    let folder = book::make_current(&workspace)?;
    let name = what.split('#').next().unwrap_or_default();
    let page = folder.join(book::page(name));
    if !page.is_file() {
        let chapters = book::chapters(&folder)?.join(", ");
        return Err(GraderError::new(format!(
            "the book has no chapter `{name}`. Its chapters: {chapters}"
        )));
    }
    let place = folder.join(book::page(&what));
    if matches.get_flag("print-path") {
        outln!("{}", place.display());
    } else if browser::open(book::address(&place)) {
        outln!("opened {}", workspace.relative(&place).display());
    } else {
        outln!("found no browser here; the page is {}", place.display());
    }
    Ok(Exit::Passed)
}
