//! The command `grader watch`: the desk of [`crate::watch`] is the terminal and the stages'
//! folders.

use super::grade::{GradedRun, hint, hint_argument};
use crate::book;
use crate::course::{Course, Task, is_selected};
use crate::grade::GradeRequest;
use crate::progress::next_task::{self, Known};
use crate::report::screen::Context;
use crate::report::terminal::Page;
use crate::report::{HintLevel, Report, links};
use crate::watch::files::WatchedFiles;
use crate::watch::{self, Desk, Event};
use base::keys::SingleKeys;
use base::program::Exit;
use base::{GraderError, Workspace, browser, errln, out, print};
use clap::{Arg, ArgMatches, Command};
use std::io::{BufRead, IsTerminal, Read};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

pub(super) fn command() -> Command {
    Command::new("watch")
        .about("Grades what you save, each time you save it, and shows what to do next")
        .arg(
            Arg::new("limit")
                .value_name("WHAT")
                .help("Grade only a part, such as `part1`, or a task, such as `part1.task3`"),
        )
        .arg(hint_argument(HintLevel::Findings))
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let limit = matches.get_one::<String>("limit").map(String::as_str);
    if let Some(limit) = limit {
        course.select(limit)?;
    }
    let known = next_task::known(&workspace, &course)?;
    let complete = known
        .iter()
        .filter(|known| known.is_complete())
        .map(|known| known.place.key.clone())
        .collect();
    let single_keys = SingleKeys::start();
    let mut terminal = Terminal {
        files: WatchedFiles::new(&workspace, &course.stages()),
        typed: read_keys(single_keys.is_some()),
        single_keys,
        workspace,
        course: course.clone(),
    };
    let page = Page::of_stdout();
    let ended = watch::run(&mut terminal, &course, limit, hint(matches), complete, page)?;
    if let Some(why) = ended.why() {
        errln!("{why}");
    }
    Ok(Exit::Passed)
}

/// How often the files are looked at.
const INTERVAL: Duration = Duration::from_millis(200);

/// The terminal and the stages' folders.
struct Terminal {
    workspace: Workspace,
    course: Course,
    files: WatchedFiles,
    /// `None` where a key counts only after Enter.
    single_keys: Option<SingleKeys>,
    /// The keys that are pressed, or the lines that are typed.
    typed: Receiver<String>,
}

/// What Ctrl-D sends where the terminal passes on single keys.
const END_OF_INPUT: u8 = 4;

/// Reads stdin in a thread of its own: `single` keys, or else lines. The channel is closed at its
/// end.
fn read_keys(single: bool) -> Receiver<String> {
    let (sender, typed) = mpsc::channel();
    std::thread::spawn(move || {
        let stdin = std::io::stdin().lock();
        let mut keys: Box<dyn Iterator<Item = std::io::Result<String>>> = match single {
            true => {
                let keys = stdin
                    .bytes()
                    .take_while(|key| !matches!(key, Ok(END_OF_INPUT)));
                Box::new(keys.map(|key| Ok(char::from(key?).to_string())))
            }
            false => Box::new(stdin.lines()),
        };
        while let Some(Ok(key)) = keys.next() {
            if sender.send(key).is_err() {
                return;
            }
        }
    });
    typed
}

impl Desk for Terminal {
    fn next_event(&mut self) -> Result<Event, GraderError> {
        loop {
            if print::is_closed() {
                return Ok(Event::Unread);
            }
            let mut saved = self.files.saved();
            if !saved.is_empty() {
                // An editor may write several files, or one in steps: wait until it is done.
                loop {
                    std::thread::sleep(INTERVAL / 2);
                    let more = self.files.saved();
                    if more.is_empty() {
                        return Ok(Event::Saved(saved));
                    }
                    saved.extend(more);
                }
            }
            match self.typed.recv_timeout(INTERVAL) {
                Ok(key) => return Ok(Event::Typed(key)),
                Err(RecvTimeoutError::Disconnected) => return Ok(Event::Closed),
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    fn grade(&mut self, what: &str) -> Result<(Report, Context), GraderError> {
        let request = GradeRequest {
            what: what.to_owned(),
            seed: 0,
        };
        let run = GradedRun::new(&self.workspace, &request, false, true)?;
        let context = run.context(&self.workspace, what)?;
        Ok((run.graded.report, context))
    }

    fn next_open(
        &mut self,
        limit: Option<&str>,
        but: &[&Task],
    ) -> Result<Option<String>, GraderError> {
        let known: Vec<Known> = next_task::known(&self.workspace, &self.course)?
            .into_iter()
            .filter(|known| limit.is_none_or(|limit| is_selected(&known.place.key, limit)))
            .collect();
        let open = next_task::first_open(&known, but);
        Ok(open.map(|place| place.key.clone()))
    }

    fn needs_enter(&self) -> bool {
        self.single_keys.is_none()
    }

    fn open(&mut self, file: &Path) -> bool {
        let page = book::page_of(&self.workspace, file);
        browser::open(page.unwrap_or_else(|| self.workspace.root().join(file)))
    }

    fn show(&mut self, text: &str) {
        let clear = match std::io::stdout().is_terminal() {
            true => "\x1b[2J\x1b[3J\x1b[H",
            false => "",
        };
        let text = links::for_stdout(text.to_owned(), &self.workspace);
        out!("{clear}{text}");
    }
}
