//! The scale of the project's colour map, with numbers and bars: legends of false colours.

use super::colors;
use super::text::SMALL;
use crate::luminance::{FIRST_STOP, Histogram, LAST_STOP, place};
use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Ui};
use pathtracer::rate_picture::viridis;

/// The height of the bar of colours, in points.
const COLORS: f32 = 10.0;
/// The height of the bars of a histogram.
const BARS: f32 = 44.0;
/// The height of the numbers.
const NUMBERS: f32 = 16.0;

/// A bar of all colours, with texts at places from 0 to 1.
pub(super) fn legend(ui: &mut Ui, marks: &[(f64, String)]) {
    paint(ui, &[], marks);
}

/// How many pixels have which luminance, above the false colours of the luminances.
pub(super) fn histogram(ui: &mut Ui, histogram: &Histogram) {
    let stops = [FIRST_STOP, -5, 0, LAST_STOP];
    let marks = stops.map(|stop| {
        let luminance = f64::from(stop).exp2();
        let text = match stop {
            0 => "1".to_owned(),
            stop => format!("2^{stop}"),
        };
        (place(luminance).unwrap_or(0.0), text)
    });
    let highest = histogram.highest() as f64;
    // The root: dark rooms have a bar that would hide all others.
    let bars: Vec<f64> = histogram
        .bars
        .iter()
        .map(|n| (*n as f64 / highest).sqrt())
        .collect();
    paint(ui, &bars, &marks);
    let percent = |n: usize| 100.0 * n as f64 / histogram.pixels.max(1) as f64;
    let mut text = format!(
        "{:.1} % black, {:.1} % above 1",
        percent(histogram.black),
        percent(histogram.above_one)
    );
    if histogram.not_a_number > 0 {
        text += &format!(", {} not a number", histogram.not_a_number);
    }
    ui.label(egui::RichText::new(text).size(SMALL));
}

/// Numbers of pixels as bars over their places from 0 to 1, coloured by the place.
pub(super) fn counts(ui: &mut Ui, counts: &[(f64, usize)], marks: &[(f64, String)]) {
    let highest = counts.iter().map(|(_, n)| *n).max().unwrap_or(0).max(1) as f64;
    let mut bars = vec![0.0; STEPS];
    for (place, n) in counts {
        let bar = (place * STEPS as f64).ceil() as usize;
        bars[bar.clamp(1, STEPS) - 1] += *n as f64 / highest;
    }
    paint(ui, &bars, marks);
}

/// The bars of [`counts`].
const STEPS: usize = 64;

fn paint(ui: &mut Ui, bars: &[f64], marks: &[(f64, String)]) {
    let over = if bars.is_empty() { 0.0 } else { BARS };
    let size = egui::vec2(ui.available_width().min(360.0), over + COLORS + NUMBERS);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter_at(rect);
    let x = |share: f64| rect.left() + rect.width() * share as f32;
    let top = rect.top() + over;
    let line = colors::line(ui);
    for (i, bar) in bars.iter().enumerate().filter(|(_, bar)| **bar > 0.0) {
        let of = |i: usize| x(i as f64 / bars.len() as f64);
        // What is there is visible.
        let height = (*bar as f32 * (BARS - 2.0)).clamp(1.0, BARS);
        let bar = Rect::from_min_max(Pos2::new(of(i), top - height), Pos2::new(of(i + 1), top));
        painter.rect_filled(bar, 0.0, line);
    }
    let mut mesh = Mesh::default();
    for i in 0..=32_u32 {
        let share = f64::from(i) / 32.0;
        let [r, g, b] = viridis(share);
        for y in [top, top + COLORS] {
            mesh.colored_vertex(Pos2::new(x(share), y), Color32::from_rgb(r, g, b));
        }
        if i > 0 {
            let first = 2 * (i - 1);
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    painter.add(mesh);
    for (share, text) in marks {
        let align = match *share {
            share if share < 0.1 => Align2::LEFT_BOTTOM,
            share if share > 0.9 => Align2::RIGHT_BOTTOM,
            _ => Align2::CENTER_BOTTOM,
        };
        let at = Pos2::new(x(*share), rect.bottom());
        let font = FontId::proportional(SMALL);
        painter.text(at, align, text, font, ui.visuals().text_color());
    }
}
