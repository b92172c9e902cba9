//! A path that is typed, where the desktop has no dialog for files.

use super::Session;
use crate::command::Command;
use std::path::PathBuf;

impl Session {
    /// The path that is being typed; `None` if the window does not ask for one.
    pub fn typed_path(&self) -> Option<&str> {
        self.typed_path.as_deref()
    }

    /// Asks for a path in the window.
    pub fn ask_for_path(&mut self) {
        self.help = false;
        self.typed_path = Some(String::new());
    }

    /// Takes over what was typed.
    pub fn type_path(&mut self, text: String) {
        self.typed_path = Some(text);
    }

    /// Opens the file that was typed. A path that is none stays to be corrected.
    pub(super) fn open_typed(&mut self) {
        let Some(text) = self.typed_path.take() else {
            return;
        };
        let path = PathBuf::from(text.trim());
        if path.is_file() {
            return self.apply(Command::for_file(path));
        }
        self.say(match text.trim() {
            "" => "Type the path of a file".to_owned(),
            name => {
                format!("There is no file {name}: its path starts at the folder of the program")
            }
        });
        self.typed_path = Some(text);
    }
}
