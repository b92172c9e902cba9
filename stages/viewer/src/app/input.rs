//! Keys and dropped files.

use crate::command::Command;
use crate::keys;
use crate::session::Mode;
use egui::{Context, Event};

/// The commands of the keys that were pressed and the files that were dropped. Keys belong to a
/// text field while it is edited.
pub(super) fn commands(ctx: &Context, mode: Mode) -> Vec<Command> {
    let is_typing = ctx.egui_wants_keyboard_input();
    ctx.input(|input| {
        let mut commands = Vec::new();
        let mut mode = mode;
        for event in &input.events {
            if let Event::Key {
                key,
                pressed: true,
                modifiers,
                repeat: _,
                ..
            } = event
                && !is_typing
                && !modifiers.mac_cmd
                && let Some(command) = keys::command(mode, keys::canonical(*key), *modifiers)
            {
                if let Command::Mode(next) = command {
                    mode = next;
                }
                commands.push(command);
            }
        }
        let dropped = input
            .raw
            .dropped_files
            .iter()
            .map(|file| file.path().to_owned());
        commands.extend(dropped.map(Command::for_file));
        commands
    })
}
