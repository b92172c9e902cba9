//! Text whose numbers are short: their other digits are shown over it and copied.

use crate::digits;
use egui::{Label, Response, RichText, Ui};

/// The size of small text.
pub(super) const SMALL: f32 = 12.0;

/// A text with at most six digits in each number. The whole text is shown over it, and its menu
/// copies it.
pub(super) fn short(ui: &mut Ui, full: &str, size: f32) -> Response {
    shown_short(ui, RichText::new(digits::shortened(full)).size(size), full)
}

/// `shown` instead of `full`, which is shown over it and which its menu copies.
pub(super) fn shown_short(ui: &mut Ui, shown: RichText, full: &str) -> Response {
    let is_whole = shown.text().ends_with(full);
    let response = ui.add(Label::new(shown).wrap());
    let response = match is_whole {
        true => response,
        false => response.on_hover_text(full),
    };
    response.context_menu(|ui| {
        if ui.button("Copy").clicked() {
            ui.copy_text(full.to_owned());
            ui.close();
        }
    });
    response
}
