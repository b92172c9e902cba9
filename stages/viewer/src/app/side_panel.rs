//! The panel at the side: what belongs to the mode, the inspector, the report.

use super::{inspector_panel, report_panel, settings_panel, text, tree_panel};
use crate::command::Command;
use crate::cut::Cut;
use crate::digits;
use crate::session::{Mode, Session};
use egui::{Grid, RichText, ScrollArea, Ui};
use kit::Vec3;

pub(super) fn show(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if session.mode() == Mode::Report {
            return report_panel::show(ui, session, commands);
        }
        // The replay is what the user looks at: it comes first.
        let replay_first = session.mode() == Mode::Render;
        if replay_first {
            inspector_panel::show(ui, session, commands);
        }
        match session.mode() {
            Mode::Edit => selection(ui, session),
            Mode::Bvh => tree_panel::show(ui, session, commands),
            Mode::Render => settings_panel::progress(ui, session, commands),
            Mode::Report => {}
        }
        if !replay_first {
            inspector_panel::show(ui, session, commands);
        }
        if session.mode() != Mode::Render || session.inspector.inspected().is_some() {
            cut(ui, session, commands);
        }
        if session.scene().is_some() {
            ui.separator();
            settings_panel::settings(ui, session, commands);
        }
        scene_facts(ui, session, commands);
    });
}

/// The selected element.
fn selection(ui: &mut Ui, session: &Session) {
    ui.heading("Selection");
    let Some(info) = session.selection_info() else {
        let text = if session.scene().is_some() && session.topology().is_none() {
            "Finding vertices and edges"
        } else {
            "Click a vertex, an edge or a face. Drag a selected vertex to move it."
        };
        ui.weak(text);
        return;
    };
    let position = session.selected_vertex_position().unwrap_or(info.position);
    facts(
        ui,
        "selection",
        &[
            ("kind", info.kind),
            ("degree", info.degree.to_string()),
            ("position", short(position)),
            (
                "boundary",
                if info.is_boundary { "yes" } else { "no" }.to_owned(),
            ),
            ("node", info.node),
            ("material", info.material),
        ],
    );
}

/// The plane that cuts the scene open.
fn cut(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    if session.scene().is_none() {
        return;
    }
    ui.horizontal(|ui| {
        let name = match session.cut() {
            Some(cut) => format!("Cut: {} (5)", Cut::AXES[cut.axis]),
            None => "Cut open (5)".to_owned(),
        };
        let button = egui::Button::selectable(session.cut().is_some(), name);
        let label = ui.add(button);
        if label.clicked() {
            commands.push(Command::NextCut);
        }
        if let (Some(cut), Some([least, greatest])) = (session.cut(), session.cut_range()) {
            let mut at = cut.at;
            let slider = egui::Slider::new(&mut at, least..=greatest).max_decimals(4);
            if ui.add(slider).labelled_by(label.id).changed() {
                commands.push(Command::MoveCut(at));
            }
            if ui.small_button("flip").clicked() {
                commands.push(Command::FlipCut);
            }
        }
    });
}

/// The scene: counts, warnings, files that were open.
fn scene_facts(ui: &mut Ui, session: &Session, commands: &mut Vec<Command>) {
    let Some(data) = session.scene() else { return };
    ui.separator();
    egui::CollapsingHeader::new("Scene")
        .default_open(false)
        .show(ui, |ui| {
            let scene = data.scene();
            facts(
                ui,
                "scene",
                &[
                    ("triangles", scene.triangles.len().to_string()),
                    ("spheres", scene.spheres.len().to_string()),
                    ("objects", scene.objects.len().to_string()),
                    ("lights", scene.lights.len().to_string()),
                    ("from", short(data.bounds.min)),
                    ("to", short(data.bounds.max)),
                ],
            );
            for warning in &data.source.warnings {
                ui.label(RichText::new(warning).size(text::SMALL));
            }
            if let Some(failure) = &data.missing_accel {
                ui.label(
                    RichText::new(format!("{failure}: a simpler way to find hits is used"))
                        .size(text::SMALL),
                );
            }
            for path in session.recent().iter().skip(1) {
                if ui.link(path.display().to_string()).clicked() {
                    commands.push(Command::Open(path.clone()));
                }
            }
        });
}

/// Names and values in two columns.
pub(super) fn facts(ui: &mut Ui, id: &str, rows: &[(&str, String)]) {
    Grid::new(id)
        .num_columns(2)
        .spacing([12.0, 3.0])
        .show(ui, |ui| {
            for (name, value) in rows {
                ui.weak(*name);
                text::shown_short(ui, RichText::new(digits::shortened(value)), value);
                ui.end_row();
            }
        });
}

/// A vector with a few digits.
pub(super) fn short(v: Vec3) -> String {
    let number = |x: f64| {
        let text = format!("{x:.4}");
        match text.trim_end_matches('0').trim_end_matches('.') {
            "-0" => "0".to_owned(),
            text => text.to_owned(),
        }
    };
    format!("{} {} {}", number(v.x), number(v.y), number(v.z))
}
