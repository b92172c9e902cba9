//! The colours of the window.

use egui::{Color32, Context, Ui};
use kit::Spectrum;
use pathtracer::RayRole;

/// Sets spacing and text sizes, the same in light and dark.
pub(super) fn set_style(ctx: &Context) {
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        style.interaction.selectable_labels = false;
    });
}

/// The background of views and pictures.
pub(super) fn backdrop(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode {
        Color32::from_gray(32)
    } else {
        Color32::from_gray(214)
    }
}

/// Lines on the background.
pub(super) fn line(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode {
        Color32::from_gray(120)
    } else {
        Color32::from_gray(110)
    }
}

/// The selected element or node: the assignment's program's (1, 0.25, 0).
pub(super) const SELECTED: Color32 = Color32::from_rgb(255, 64, 0);
/// The element under the mouse.
pub(super) const HOVERED: Color32 = Color32::from_rgb(255, 190, 60);
/// What is right.
pub(super) const RIGHT: Color32 = Color32::from_rgb(60, 180, 90);
/// What is wrong.
pub(super) const WRONG: Color32 = Color32::from_rgb(230, 60, 70);

/// The colour of a ray.
pub(super) fn ray(role: RayRole) -> Color32 {
    match role {
        RayRole::Camera => Color32::from_rgb(90, 160, 255),
        RayRole::Bounce => Color32::from_rgb(190, 110, 240),
        RayRole::Shadow => Color32::from_rgb(235, 190, 50),
        RayRole::Light => Color32::from_rgb(240, 140, 50),
    }
}

/// The colour of a spectrum whose channels are bytes over 255.
pub(super) fn of(color: Spectrum) -> Color32 {
    let [r, g, b] = color.to_array().map(|c| (255.0 * c) as u8);
    Color32::from_rgb(r, g, b)
}

/// A coloured dot in a line of text.
pub(super) fn dot(ui: &mut Ui, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(egui::Vec2::splat(10.0), egui::Sense::hover());
    ui.painter().circle_filled(rect.center(), 4.0, color);
}

/// A value from 0 to 1 as a colour from black over blue, red and yellow to white.
pub(super) fn heat(value: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 5] = [
        [0.0, 0.0, 0.0],
        [30.0, 40.0, 150.0],
        [210.0, 40.0, 70.0],
        [250.0, 200.0, 50.0],
        [255.0, 255.0, 255.0],
    ];
    let at = value.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let i = (at as usize).min(STOPS.len() - 2);
    let share = at - i as f64;
    [0, 1, 2].map(|c| (STOPS[i][c] + share * (STOPS[i + 1][c] - STOPS[i][c])).round() as u8)
}
