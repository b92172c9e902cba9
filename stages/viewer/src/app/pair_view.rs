//! Two pictures in one place: wiped, in turns, one of them, or their difference.

use super::{colors, key_button};
use crate::command::Command;
use crate::picture_pair::{CauseCount, PairDisplay, PairView, PicturePair};
use egui::{
    Align2, Color32, ColorImage, FontId, Key, Pos2, Rect, RichText, Stroke, TextureHandle,
    TextureOptions, Ui,
};
use pictures::Image;
use std::time::Duration;

/// How long each picture is visible while they flicker, in seconds.
const FLICKER: f64 = 0.5;

/// The textures of a pair, and which pair they are of.
#[derive(Default)]
pub(super) struct PairTextures {
    shown: Option<(u64, [TextureHandle; 3])>,
}

impl PairTextures {
    /// The textures of `pair`, whose number is `of`: the first, the second, the difference.
    pub(super) fn of(&mut self, ui: &Ui, of: u64, pair: &PicturePair) -> &[TextureHandle; 3] {
        if self.shown.as_ref().is_none_or(|(shown, _)| *shown != of) {
            let images = [&pair.first, &pair.second, &pair.difference];
            let textures = images.map(|image| {
                ui.ctx()
                    .load_texture("pair", color_image(image), TextureOptions::NEAREST)
            });
            self.shown = Some((of, textures));
        }
        let (_, textures) = self.shown.as_ref().expect("it was set");
        textures
    }
}

/// A picture as egui has it.
pub(super) fn color_image(image: &Image) -> ColorImage {
    let [w, h] = image.size();
    let pixels = image
        .pixels()
        .iter()
        .map(|[r, g, b]| Color32::from_rgb(*r, *g, *b));
    ColorImage::new([w as usize, h as usize], pixels.collect())
}

/// Paints a pair of pictures with these names.
pub(super) fn paint(
    ui: &Ui,
    area: Rect,
    display: PairDisplay,
    [first, second, difference]: &[TextureHandle; 3],
    names: [&str; 2],
) {
    let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    let painter = ui.painter_at(area);
    let image = |texture: &TextureHandle| {
        painter.image(texture.id(), area, whole, Color32::WHITE);
    };
    let mut shown = names[0];
    match display.view {
        PairView::First => image(first),
        PairView::Second => {
            image(second);
            shown = names[1];
        }
        PairView::Difference => {
            image(difference);
            shown = "difference";
        }
        PairView::Flicker => {
            let time = ui.input(|input| input.time);
            let is_first = ((time / FLICKER) as u64).is_multiple_of(2);
            image(if is_first { first } else { second });
            shown = names[usize::from(!is_first)];
            ui.ctx()
                .request_repaint_after(Duration::from_secs_f64(FLICKER - time % FLICKER));
        }
        PairView::Wipe => {
            image(first);
            wipe(ui, area, display.wipe, second);
            label(ui, area.right_top(), Align2::RIGHT_TOP, names[1]);
        }
    }
    label(ui, area.left_top(), Align2::LEFT_TOP, shown);
}

/// The part of `second` to the right of the line at the share `wipe` of the width, and the line.
fn wipe(ui: &Ui, area: Rect, wipe: f32, second: &TextureHandle) {
    let mut right = area;
    right.min.x += wipe * area.width();
    let uv = Rect::from_min_max(Pos2::new(wipe, 0.0), Pos2::new(1.0, 1.0));
    let painter = ui.painter_at(area);
    painter.image(second.id(), right, uv, Color32::WHITE);
    let line = [right.left_top(), right.left_bottom()];
    painter.line_segment(line, Stroke::new(1.5, colors::palette(ui).selected));
    painter.circle_filled(right.left_center(), 5.0, colors::palette(ui).selected);
}

/// A name in a corner of a picture, readable on every colour.
fn label(ui: &Ui, at: Pos2, align: Align2, text: &str) {
    let painter = ui.painter();
    let inset = egui::vec2(
        if align == Align2::RIGHT_TOP {
            -8.0
        } else {
            8.0
        },
        6.0,
    );
    let font = FontId::proportional(13.0);
    let galley = painter.layout_no_wrap(text.to_owned(), font, Color32::WHITE);
    let rect = align.anchor_size(at + inset, galley.size());
    let shade = Color32::from_black_alpha(170);
    painter.rect_filled(rect.expand2(egui::vec2(4.0, 2.0)), 3.0, shade);
    painter.galley(rect.min, galley, Color32::WHITE);
}

/// The share of the width of `area` at which the mouse drags the line.
pub(super) fn dragged_wipe(area: Rect, at: Pos2) -> f32 {
    ((at.x - area.left()) / area.width()).clamp(0.0, 1.0)
}

/// The buttons for the ways to show a pair with these names.
pub(super) fn buttons(ui: &mut Ui, view: PairView, names: [&str; 2], commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for way in PairView::ALL {
            let name = match way {
                PairView::Wipe => "Wipe",
                PairView::Flicker => "Flicker (F)",
                PairView::First => names[0],
                PairView::Second => names[1],
                PairView::Difference => "Difference",
            };
            if ui.selectable_label(view == way, name).clicked() {
                commands.push(Command::ShowPair(way));
            }
        }
        if key_button(ui, "Next", Key::J) {
            commands.push(Command::NextPairView);
        }
    });
}

/// The causes of differences, with their colours and numbers of pixels.
/// `differing` is the number of pixels that are not equal: some differ only within the noise.
pub(super) fn legend(ui: &mut Ui, causes: &[CauseCount], differing: u64) {
    match (causes, differing) {
        ([], 0) => {
            let right = colors::palette(ui).right;
            ui.colored_label(right, "No pixel differs.");
        }
        ([], differing) => {
            ui.label(format!(
                "{differing} pixels differ, none of them beyond the noise."
            ));
        }
        _ => {}
    }
    for cause in causes {
        ui.horizontal(|ui| {
            let [r, g, b] = cause.color;
            colors::dot(ui, Color32::from_rgb(r, g, b));
            ui.label(cause.label);
            ui.label(RichText::new(format!("{} pixels", cause.pixels)).weak());
        });
    }
}
