//! Windows over everything: the list of keys, and the question before a render is lost.

use crate::command::Command;
use crate::keys::{self, Binding};
use crate::session::{Mode, Session};
use egui::{Context, Grid, Id, Modal, RichText, ScrollArea, Ui};

pub(super) fn show(ctx: &Context, session: &mut Session, commands: &mut Vec<Command>) {
    if session.asks_to_quit() {
        Modal::new(Id::unique("quit")).show(ctx, |ui| {
            ui.heading("The picture is not finished");
            ui.label("Closing the window stops it.");
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                if ui.button("Save and close").clicked() {
                    commands.push(Command::SaveAndQuit);
                }
                if ui.button("Close (Esc)").clicked() {
                    commands.push(Command::Quit);
                }
                if ui.button("Go on").clicked() {
                    commands.push(Command::DoNotQuit);
                }
            });
        });
    } else if session.help() {
        let modal = Modal::new(Id::unique("keys")).show(ctx, |ui| {
            ui.horizontal(|ui| {
                ui.heading("Keys");
                ui.weak("? or Esc closes this sheet");
            });
            let height = ctx.content_rect().height() - 110.0;
            let width = ctx.content_rect().width() - 60.0;
            ScrollArea::both()
                .max_width(width)
                .max_height(height)
                .min_scrolled_width(width)
                .min_scrolled_height(height)
                .show(ui, help);
        });
        if modal.should_close() {
            commands.push(Command::ToggleHelp);
        }
    }
}

/// The width of a column of keys, in points.
const COLUMN: f32 = 400.0;

fn help(ui: &mut Ui) {
    mouse(ui);
    ui.separator();
    // Keys that differ only in their direction have one line.
    let bindings: Vec<Binding> = keys::bindings()
        .into_iter()
        .filter(|binding| !binding.label.is_empty())
        .collect();
    // As many columns as are visible side by side.
    let columns = ((ui.available_width() / COLUMN) as usize).clamp(1, 2);
    let half = bindings.len().div_ceil(columns);
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 28.0;
        for (i, column) in bindings.chunks(half).enumerate() {
            Grid::new(("keys", i))
                .num_columns(3)
                .spacing([10.0, 3.0])
                .show(ui, |ui| {
                    for binding in column {
                        ui.label(RichText::new(binding.label).monospace().strong());
                        ui.label(binding.help);
                        let modes = binding.modes.iter().map(|mode: &Mode| mode.name());
                        ui.weak(modes.collect::<Vec<_>>().join(", "));
                        ui.end_row();
                    }
                });
        }
    });
    ui.weak("In the assignment's program S, D, C and H mean other things in edit mode. Here every key has one meaning.");
}

fn mouse(ui: &mut Ui) {
    Grid::new("mouse")
        .num_columns(2)
        .spacing([10.0, 3.0])
        .show(ui, |ui| {
            for (mouse, help) in [
                (
                    "Left drag",
                    "rotate the view; move a selected vertex; draw a cell; wipe two pictures",
                ),
                ("Right drag", "move the view, or an enlarged picture"),
                ("Wheel", "zoom; in the picture: enlarge it at the mouse"),
                (
                    "Pinch, swipe",
                    "zoom the view; two fingers sideways rotate it",
                ),
                ("Click", "select; in the picture: replay the pixel"),
                (
                    "Drop a file",
                    ".dae: open it; a picture: compare with it; a camera's .txt: set it",
                ),
            ] {
                ui.label(RichText::new(mouse).strong());
                ui.label(help);
                ui.end_row();
            }
        });
}
