//! A path that is typed: of a file to open, where the desktop has no dialog, or of a scene to save.

use super::Session;
use crate::command::Command;
use crate::path_use::PathUse;
use std::path::PathBuf;

impl Session {
    /// The path that is being typed, and what it is for; `None` if the window does not ask for one.
    pub fn typed_path(&self) -> Option<(PathUse, &str)> {
        let (path_use, text) = self.typed_path.as_ref()?;
        Some((*path_use, text))
    }

    /// Asks for a file to open.
    pub fn ask_for_path(&mut self) {
        self.help = false;
        self.typed_path = Some((PathUse::Open, String::new()));
    }

    /// Asks where to save the scene, and proposes a name beside its file.
    pub(super) fn ask_where_to_save(&mut self) {
        let Some(scene) = &self.scene else {
            return self.say("There is no scene to save: open one first");
        };
        let path = &scene.source.path;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let proposed = path.with_file_name(format!("{stem}_edited.dae"));
        self.help = false;
        self.typed_path = Some((PathUse::SaveScene, proposed.display().to_string()));
    }

    /// Takes over what was typed.
    pub fn type_path(&mut self, text: String) {
        if let Some((_, typed)) = &mut self.typed_path {
            *typed = text;
        }
    }

    /// Opens or writes the file that was typed. A path that does not work stays to be corrected.
    pub(super) fn use_typed_path(&mut self) {
        let Some((path_use, text)) = self.typed_path.take() else {
            return;
        };
        let path = PathBuf::from(text.trim());
        let is_done = match path_use {
            PathUse::SaveScene => self.save_scene(&path),
            PathUse::Open if path.is_file() => {
                self.apply(Command::for_file(path));
                true
            }
            PathUse::Open => {
                self.say(match text.trim() {
                    "" => "Type the path of a file".to_owned(),
                    name => {
                        format!(
                            "There is no file {name}: its path starts at the folder of the program"
                        )
                    }
                });
                false
            }
        };
        if !is_done {
            self.typed_path = Some((path_use, text));
        }
    }
}
