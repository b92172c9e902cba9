//! The samples of a replayed pixel: where they are in the pixel, and how their mean settles.

use super::colors;
use super::text::SMALL;
use crate::convergence::{Settling, settling};
use crate::inspector::{Inspected, Inspector};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, RichText, Sense, Stroke, StrokeKind, Ui};

/// The edge of the square that is the pixel, in points.
const EDGE: f32 = 104.0;

/// Both plots, side by side.
pub(super) fn show(ui: &mut Ui, inspector: &Inspector) {
    let Some(inspected) = inspector.inspected() else {
        return;
    };
    egui::CollapsingHeader::new("Samples in the pixel, and their mean")
        .default_open(false)
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                positions(ui, inspector, inspected);
                let batch = inspected.light.adaptive.map(|(batch, _)| batch);
                mean(ui, &settling(&inspected.replay, batch));
            });
            ui.label(RichText::new(sentence(inspected)).size(SMALL));
        });
}

/// How many samples the pixel took, and when it stopped.
pub(super) fn sentence(inspected: &Inspected) -> String {
    let took = inspected.replay.samples.len();
    let most = inspected.most_samples();
    match inspected.light.adaptive {
        Some((batch, _)) if took < most => {
            format!("The pixel stopped after {took} of {most} samples, in batches of {batch}.")
        }
        Some((batch, _)) => {
            format!("The pixel took all {most} samples: no batch of {batch} was enough.")
        }
        None => format!("All {took} samples; the band is the standard error of the mean."),
    }
}

/// The positions of the samples in their pixel.
fn positions(ui: &mut Ui, inspector: &Inspector, inspected: &Inspected) {
    let (response, painter) = ui.allocate_painter(egui::Vec2::splat(EDGE), Sense::hover());
    let rect = response.rect.shrink(2.0);
    frame(ui, &painter, rect);
    let palette = colors::palette(ui);
    let (selected, ..) = inspector.position();
    let at = |share: kit::Vec2| {
        let y = rect.bottom() - rect.height() * share.y as f32;
        Pos2::new(rect.left() + rect.width() * share.x as f32, y)
    };
    for (i, share) in inspected.positions().enumerate() {
        if i != selected {
            painter.circle_filled(at(share), 1.5, palette.ray(pathtracer::RayRole::Camera));
        }
    }
    if let Some(share) = inspected.positions().nth(selected) {
        painter.circle_stroke(at(share), 4.0, Stroke::new(2.0, palette.selected));
    }
}

/// The mean of the luminances over the number of samples, with its standard error.
fn mean(ui: &mut Ui, points: &[Settling]) {
    let width = ui.available_width().clamp(80.0, 240.0);
    let (response, painter) = ui.allocate_painter(egui::vec2(width, EDGE), Sense::hover());
    let rect = response.rect.shrink(2.0);
    frame(ui, &painter, rect);
    let Some(last) = points.last() else { return };
    // The first points may be far off: the scale is that of the last ones and of a third of all.
    let shown = points.iter().skip(points.len() / 3);
    let bounded = |x: f64| if x.is_finite() { x } else { 0.0 };
    let highest = shown
        .map(|point| bounded(point.mean + point.error))
        .fold(1e-9, f64::max)
        * 1.1;
    let at = |samples: u64, value: f64| {
        let x = samples as f32 / last.samples.max(1) as f32;
        let y = (value / highest).clamp(0.0, 1.0) as f32;
        Pos2::new(
            rect.left() + rect.width() * x,
            rect.bottom() - rect.height() * y,
        )
    };
    let palette = colors::palette(ui);
    let camera = palette.ray(pathtracer::RayRole::Camera);
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let ends = [at(a.samples, a.mean), at(b.samples, b.mean)];
        painter.line_segment(ends, Stroke::new(2.0, camera));
    }
    for point in points {
        let error = bounded(point.error);
        let ends = [point.mean - error, point.mean + error].map(|y| at(point.samples, y));
        painter.line_segment(ends, Stroke::new(1.0, palette.attention));
    }
    let text = |at: Pos2, align: Align2, text: String, color: Color32| {
        painter.text(at, align, text, FontId::proportional(SMALL), color);
    };
    let color = ui.visuals().text_color();
    text(
        rect.left_top() + egui::vec2(3.0, 1.0),
        Align2::LEFT_TOP,
        format!("{highest:.3}"),
        color,
    );
    text(
        rect.right_bottom() - egui::vec2(3.0, 1.0),
        Align2::RIGHT_BOTTOM,
        format!("{} samples", last.samples),
        color,
    );
}

fn frame(ui: &Ui, painter: &Painter, rect: Rect) {
    painter.rect_filled(rect, 0.0, colors::backdrop(ui));
    let stroke = Stroke::new(1.0, colors::line(ui));
    painter.rect_stroke(rect, 0.0, stroke, StrokeKind::Inside);
}
