//! The text about a scene that was not loaded: the file, the line, and what was expected.

use super::colors;
use crate::command::Command;
use egui::{Label, RichText, ScrollArea, Ui};

pub(super) fn show(ui: &mut Ui, problem: &str, commands: &mut Vec<Command>) {
    egui::Panel::top("problem").show(ui, |ui| {
        ui.horizontal(|ui| {
            let wrong = colors::palette(ui).wrong;
            ui.label(
                RichText::new("The scene is not loaded")
                    .strong()
                    .color(wrong),
            );
            if ui.button("Close").clicked() {
                commands.push(Command::CloseProblem);
            }
            if ui.button("Copy").clicked() {
                ui.copy_text(problem.to_owned());
            }
        });
        ScrollArea::both()
            .id_salt("problem")
            .max_height(220.0)
            .auto_shrink([false, true])
            .show(ui, |ui| {
                let text = RichText::new(problem.trim_end()).monospace();
                ui.add(Label::new(text).extend());
            });
    });
}
