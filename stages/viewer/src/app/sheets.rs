//! Windows over everything: the list of keys, and the question before a render is lost.

use super::text;
use crate::command::Command;
use crate::keys::{self, Binding};
use crate::path_use::PathUse;
use crate::session::{Mode, Session};
use egui::{Context, Grid, Id, Key, Modal, RichText, ScrollArea, TextEdit, Ui};

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
    } else if let Some((path_use, text)) = session.typed_path() {
        let text = text.to_owned();
        path_sheet(ctx, session, path_use, text, commands);
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

/// Asks for the path of a file; to open one, it offers those that are known.
fn path_sheet(
    ctx: &Context,
    session: &mut Session,
    path_use: PathUse,
    mut text: String,
    commands: &mut Vec<Command>,
) {
    let (heading, about, button) = match path_use {
        PathUse::Open => (
            "Open a file",
            "This desktop has no dialog for files (xdg-desktop-portal, or zenity). Type a path, or drop a file into the window: a scene (.dae), a picture, a camera (.txt).",
            "Open (Enter)",
        ),
        PathUse::SaveScene => (
            "Save the scene as",
            "Moved vertices and the camera are written as COLLADA, in world space. An existing file is replaced.",
            "Save (Enter)",
        ),
    };
    let modal = Modal::new(Id::unique("path")).show(ctx, |ui| {
        ui.set_max_width(ctx.content_rect().width().min(560.0) - 60.0);
        let heading = ui.heading(heading).id;
        ui.label(about);
        let field = TextEdit::singleline(&mut text).desired_width(f32::INFINITY);
        let field = ui
            .add(field.hint_text("scenes/dae/cornell_whale.dae"))
            .labelled_by(heading);
        if !field.has_focus() && !field.lost_focus() {
            field.request_focus();
        }
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.horizontal(|ui| {
            if ui.button(button).clicked() || is_entered {
                commands.push(Command::UseTypedPath);
            }
            if ui.button("Close (Esc)").clicked() {
                commands.push(Command::Escape);
            }
        });
        ui.label(RichText::new(session.message()).size(text::SMALL));
        if path_use == PathUse::Open {
            let recent = session.recent();
            let others = session
                .course_scenes()
                .iter()
                .filter(|scene| !recent.contains(scene));
            let known = recent.iter().chain(others);
            ScrollArea::vertical().max_height(180.0).show(ui, |ui| {
                for path in known {
                    if ui.link(path.display().to_string()).clicked() {
                        commands.extend([Command::Escape, Command::Open(path.clone())]);
                    }
                }
            });
        }
    });
    session.type_path(text);
    if modal.should_close() && commands.is_empty() {
        commands.push(Command::Escape);
    }
}

/// The width of a column of keys, in points.
const COLUMN: f32 = 430.0;

fn help(ui: &mut Ui) {
    // Nothing in it can be pressed, so its lines may be close to each other.
    ui.spacing_mut().interact_size.y = 0.0;
    mouse(ui);
    ui.separator();
    // Keys that differ only in their direction have one line.
    let bindings: Vec<Binding> = keys::bindings()
        .into_iter()
        .filter(|binding| !binding.label.is_empty())
        .collect();
    // As many columns as are visible side by side.
    let columns = ((ui.available_width() / COLUMN) as usize).clamp(1, 3);
    let half = bindings.len().div_ceil(columns);
    ui.horizontal_top(|ui| {
        ui.spacing_mut().item_spacing.x = 28.0;
        for (i, column) in bindings.chunks(half).enumerate() {
            Grid::new(("keys", i))
                .num_columns(3)
                .spacing([10.0, 1.0])
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
