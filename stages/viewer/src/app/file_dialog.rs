//! The dialog of the desktop that asks for a file; where there is none, the window asks for a path.

use crate::command::Command;
use crate::session::Session;
use crate::task::{Task, Wake};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Asks the user for a file; `None` if no file is chosen, and at once if there is no dialog. It is
/// called on a thread of its own.
pub type Picker = fn() -> Option<PathBuf>;

/// A dialog that is closed sooner was never open: nobody reads it in that time.
const SOONEST: Duration = Duration::from_millis(400);

/// What was chosen, and when the dialog was closed.
type Answer = (Option<PathBuf>, Instant);

/// The dialog, if one is open.
#[derive(Default)]
pub(super) struct FileDialog {
    /// Without one there is no dialog: where there is no display.
    pub(super) picker: Option<Picker>,
    asking: Option<(Instant, Task<Answer>)>,
}

impl FileDialog {
    /// Opens the dialog if the session asks for it, and opens the file that was chosen.
    pub(super) fn update(&mut self, session: &mut Session, wake: Wake) {
        let is_wanted = session.take_file_question() && self.asking.is_none();
        match self.picker.filter(|_| is_wanted) {
            Some(picker) => {
                let task = Task::spawn(wake, move |_| (picker(), Instant::now()));
                self.asking = Some((Instant::now(), task));
            }
            None if is_wanted => session.ask_for_path(),
            None => {}
        }
        let wait = match session.patience.always_sharp {
            true => session.patience.per_frame,
            false => Duration::ZERO,
        };
        let Some((since, task)) = &self.asking else {
            return;
        };
        let Some(chosen) = task.wait(wait) else {
            return;
        };
        match chosen {
            Ok((Some(path), _)) => session.apply(Command::for_file(path)),
            Ok((None, at)) if at.duration_since(*since) > SOONEST => {
                session.say("No file was chosen; a file can be dropped into the window, too");
            }
            _ => session.ask_for_path(),
        }
        self.asking = None;
    }
}
