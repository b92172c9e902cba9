//! The dialog of the desktop that asks for a file.

use crate::command::Command;
use crate::session::Session;
use crate::task::{Task, Wake};
use std::path::PathBuf;
use std::time::Duration;

/// Asks the user for a file; `None` if no file is chosen. It is called on a thread of its own.
pub type Picker = fn() -> Option<PathBuf>;

/// The dialog, if one is open.
#[derive(Default)]
pub(super) struct FileDialog {
    /// Without one there is no dialog: where there is no display.
    pub(super) picker: Option<Picker>,
    asking: Option<Task<Option<PathBuf>>>,
}

impl FileDialog {
    /// Opens the dialog if the session asks for it, and opens the file that was chosen.
    pub(super) fn update(&mut self, session: &mut Session, wake: Wake) {
        let is_wanted = session.take_file_question() && self.asking.is_none();
        if let Some(picker) = self.picker.filter(|_| is_wanted) {
            self.asking = Some(Task::spawn(wake, move |_| picker()));
        }
        let wait = match session.patience.always_sharp {
            true => session.patience.per_frame,
            false => Duration::ZERO,
        };
        let Some(chosen) = self.asking.as_ref().and_then(|task| task.wait(wait)) else {
            return;
        };
        self.asking = None;
        match chosen {
            Ok(Some(path)) => session.apply(Command::for_file(path)),
            _ => session.say("No file was chosen; a file can be dropped into the window, too"),
        }
    }
}
