//! The comparison of two pictures: which ones, how, their errors and the causes.

use super::side_panel::facts;
use super::{colors, key_button, outlined, pair_view};
use crate::command::Command;
use crate::session::Session;
use egui::{ComboBox, Key, RichText, Ui};

/// The names of A and B on the pictures.
pub(super) const NAMES: [&str; 2] = ["A", "B"];

pub(super) fn show(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    let Some(view) = session.comparison().map(|c| c.display.view) else {
        ui.horizontal_wrapped(|ui| {
            if session.render().is_some() && key_button(ui, "Keep to compare", Key::K) {
                commands.push(Command::KeepForComparison);
            }
            ui.weak("or drop a picture here");
        });
        return;
    };
    ui.separator();
    ui.horizontal(|ui| {
        ui.heading("A and B");
        if key_button(ui, "Swap", Key::Num0) {
            commands.push(Command::SwapCompared);
        }
        if ui.button("End").clicked() {
            commands.push(Command::EndComparison);
        }
    });
    choose(ui, session);
    pair_view::buttons(ui, view, NAMES, commands);
    let Some(compared) = session.compared() else {
        ui.weak("Drop another picture, or render one.");
        return;
    };
    let pair = compared.pair.clone();
    let compared_pixels = compared.errors.map(|errors| errors.pixels as u64);
    match compared.errors {
        None => {
            ui.colored_label(colors::palette(ui).wrong, "The sizes differ.");
        }
        Some(errors) => {
            let mut rows = vec![
                ("pixels", errors.pixels.to_string()),
                ("largest", errors.largest.to_string()),
                ("RMSE", format!("{:.3}", errors.rmse)),
                ("PSNR", format!("{:.2} dB", errors.psnr)),
            ];
            if let Some(error) = errors.relative_mse {
                rows.push(("relative MSE", format!("{error:.3e}")));
            }
            facts(ui, "errors", &rows);
        }
    }
    if let Some(pair) = pair {
        let differing = compared_pixels.unwrap_or(0);
        pair_view::legend(ui, &pair.legend, differing);
    }
    if let Some(comparison) = session.comparison_mut() {
        let name = "every pixel, also within the noise";
        outlined(ui, |ui| ui.checkbox(&mut comparison.each_pixel, name));
    }
}

/// Which pictures are A and B.
fn choose(ui: &mut Ui, session: &mut Session) {
    let kept: Vec<String> = session.kept().iter().map(|one| one.name.clone()).collect();
    let has_render = session.render().is_some();
    let Some(comparison) = session.comparison_mut() else {
        return;
    };
    let name = |first: Option<usize>| match first {
        None => "the render",
        Some(i) => kept.get(i).map_or("", String::as_str),
    };
    egui::Grid::new("pair").num_columns(2).show(ui, |ui| {
        let wide = ui.available_width() - 40.0;
        let label = ui.label(RichText::new("A").strong()).id;
        let first = ComboBox::from_id_salt("first")
            .width(wide)
            .truncate()
            .selected_text(name(comparison.first))
            .show_ui(ui, |ui| {
                if has_render {
                    ui.selectable_value(&mut comparison.first, None, name(None));
                }
                for i in 0..kept.len() {
                    ui.selectable_value(&mut comparison.first, Some(i), name(Some(i)));
                }
            });
        first.response.labelled_by(label);
        ui.end_row();
        let label = ui.label(RichText::new("B").strong()).id;
        let second = ComboBox::from_id_salt("second")
            .width(wide)
            .truncate()
            .selected_text(name(Some(comparison.second)))
            .show_ui(ui, |ui| {
                for i in 0..kept.len() {
                    ui.selectable_value(&mut comparison.second, i, name(Some(i)));
                }
            });
        second.response.labelled_by(label);
        ui.end_row();
    });
}
