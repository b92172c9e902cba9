//! What is drawn of samples in a case: those of a pixel, those of a surface, those of a plot.

use super::case_lines::Sample;
use super::colors::{self, Palette, Pattern};
use super::lines::{Hidden, Lines};
use crate::report::pixel_case::{NEIGHBOURS, PixelCase};
use crate::report::plot_case::{PlotCase, WIDTH};
use crate::report::scatter_case::ScatterCase;
use egui::{Color32, Stroke, Ui};
use kit::Vec3;
use pathtracer::RayRole;

/// A line of a legend.
type Entry = (Sample, Color32, &'static str);

/// The most samples that are drawn.
const MAX_SAMPLES: usize = 4000;
/// The most sampled directions that are drawn: more would cover the lobe.
const MAX_DIRECTIONS: usize = 500;
/// A name so far below a line of a plot of height 1 does not touch it, even in a small window.
const BELOW: f64 = 0.24;
/// Directions that are closer than this look alike.
const SAME_DIRECTION: f64 = 1e-3;

pub(super) fn pixel_legend(case: &PixelCase, palette: &Palette) -> Vec<Entry> {
    let mut legend = vec![
        (
            Sample::Dot,
            palette.ray(RayRole::Camera),
            "your samples in the pixel",
        ),
        (Sample::Cross, palette.wrong, "your samples beside it"),
    ];
    if !case.checks.is_empty() {
        let calls = "your calls of the stopping rule, upwards";
        let dashed = Sample::Line(Pattern::Dashed);
        legend.push((dashed, palette.attention, calls));
        let solid = Sample::Line(Pattern::Solid);
        legend.push((solid, palette.selected, "the pixel stopped"));
    }
    legend
}

/// The square of the pixel between its neighbours, and its samples; above it what came later.
pub(super) fn pixel(lines: &Lines<'_>, ui: &Ui, case: &PixelCase) {
    let thin = Stroke::new(1.0, colors::line(ui));
    let at = |x: f64, y: f64, height: f64| case.seen(Vec3::new(x, y, height));
    let (low, high) = (-NEIGHBOURS, 1.0 + NEIGHBOURS);
    for edge in [0.0, 1.0] {
        for ends in [[(edge, low), (edge, high)], [(low, edge), (high, edge)]] {
            let [from, to] = ends.map(|(x, y)| at(x, y, 0.0));
            lines.line(from, to, thin, Hidden::Shown);
        }
    }
    let bold = Stroke::new(2.5, ui.visuals().strong_text_color());
    square(lines, case, 0.0, bold, Pattern::Solid);
    if !case.checks.is_empty() {
        let edges = Stroke::new(1.0, colors::line(ui));
        for (x, y) in CORNERS {
            let [from, to] = [0.0, 1.0].map(|height| at(x, y, height));
            lines.line(from, to, edges, Hidden::Shown);
        }
        square(lines, case, 1.0, edges, Pattern::Solid);
        let top = at(1.0, 1.0, 1.0);
        let name = format!("{} samples, the most", case.most);
        lines.name_at(top, ui.visuals().text_color(), &name);
        for &samples in &case.checks {
            let stroke = Stroke::new(1.2, lines.palette.attention);
            square(lines, case, case.height(samples), stroke, Pattern::Dashed);
        }
        let stop = case.height(u64::from(case.taken));
        let stroke = Stroke::new(3.0, lines.palette.selected);
        square(lines, case, stop, stroke, Pattern::Solid);
        let name = format!("stopped after {}", case.taken);
        lines.name_at(at(0.0, 0.0, stop), lines.palette.selected, &name);
    }
    for &sample in case.samples.iter().take(MAX_SAMPLES) {
        match PixelCase::is_inside(sample) {
            true => lines.disc(case.seen(sample), 3.0, lines.palette.ray(RayRole::Camera)),
            false => lines.cross(case.seen(sample), lines.palette.wrong),
        }
    }
}

const CORNERS: [(f64, f64); 4] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];

/// The square of the pixel at a height.
fn square(lines: &Lines<'_>, case: &PixelCase, height: f64, stroke: Stroke, pattern: Pattern) {
    let corners = CORNERS.map(|(x, y)| case.seen(Vec3::new(x, y, height)));
    lines.outline(&corners, stroke, Hidden::Shown, pattern);
}

pub(super) fn scatter_legend(case: &ScatterCase, palette: &Palette) -> Vec<Entry> {
    let (solid, dashed) = (Sample::Line(Pattern::Solid), Sample::Line(Pattern::Dashed));
    let mut legend = vec![(solid, palette.ray(RayRole::Camera), "to the viewer")];
    if case.wi.is_some() {
        legend.push((solid, palette.ray(RayRole::Bounce), "to the light"));
    }
    if case.expected.is_some() {
        legend.push((solid, palette.right, "the exact direction"));
    }
    legend.push((dashed, palette.wrong, "your direction"));
    if !case.curves.is_empty() {
        legend.push((solid, palette.right, "the lobe: the right density"));
        let samples = "your samples, as far as your density";
        legend.push((Sample::Dot, palette.ray(RayRole::Light), samples));
    }
    legend
}

/// A surface, its normal, the directions of the call, and its lobe with the samples of all calls.
pub(super) fn scatter(lines: &Lines<'_>, ui: &Ui, case: &ScatterCase) {
    let thin = Stroke::new(1.0, colors::line(ui));
    lines.circle(Vec3::ZERO, [Vec3::X, Vec3::Z], thin);
    for &sample in case.samples.iter().take(MAX_DIRECTIONS) {
        lines.disc(sample, 2.0, lines.palette.ray(RayRole::Light));
    }
    let lobe = Stroke::new(1.5, lines.palette.right);
    for curve in &case.curves {
        lines.path(curve, lobe, Hidden::Shown, Pattern::Solid);
    }
    let o = Vec3::ZERO;
    lines.arrow(o, Vec3::Y, 1.0, ui.visuals().strong_text_color(), "n");
    let viewer = lines.palette.ray(RayRole::Camera);
    lines.arrow(o, case.wo, 1.0, viewer, "wo");
    if let Some(wi) = case.wi {
        lines.arrow(o, wi, 1.0, lines.palette.ray(RayRole::Bounce), "wi");
    }
    let is_alike = |yours: &Vec3| {
        let exact = case.expected;
        exact.is_some_and(|exact| exact.distance(*yours) < SAME_DIRECTION)
    };
    if let Some(exact) = case.expected {
        let name = match case.yours.as_ref().is_some_and(is_alike) {
            true => "exact, and yours",
            false => "exact",
        };
        lines.arrow(o, exact, 1.0, lines.palette.right, name);
    }
    if let Some(yours) = case.yours.filter(|yours| !is_alike(yours)) {
        // Its length may be what is wrong.
        let shown = yours.clamp_length_max(1.5);
        lines.patterned_arrow(o, shown, lines.palette.wrong, "yours", Pattern::Dashed);
    }
}

pub(super) fn plot_legend(case: &PlotCase, palette: &Palette) -> Vec<Entry> {
    let (solid, dashed) = (Sample::Line(Pattern::Solid), Sample::Line(Pattern::Dashed));
    let dots = (Sample::Dot, palette.ray(RayRole::Camera), "your answers");
    match case.dots.is_empty() {
        _ if !case.right.is_empty() => vec![
            dots,
            (dashed, palette.right, "what is right"),
            (solid, palette.wrong, "your answer to this call"),
        ],
        true => vec![
            (solid, palette.ray(RayRole::Camera), "the mean so far"),
            (solid, palette.attention, "its standard error"),
            (dashed, palette.right, "the tolerance"),
        ],
        false => vec![
            dots,
            (dashed, palette.right, "what their mean must be"),
            (solid, palette.wrong, "their mean"),
        ],
    }
}

/// A plot with its axes.
pub(super) fn plot(lines: &Lines<'_>, ui: &Ui, case: &PlotCase) {
    let axis = Stroke::new(1.5, ui.visuals().text_color());
    let (o, right, up) = (Vec3::ZERO, Vec3::new(WIDTH, 0.0, 0.0), Vec3::Y);
    lines.line(o, right, axis, Hidden::Shown);
    lines.line(o, up, axis, Hidden::Shown);
    let [x, y] = case.axes;
    let text = ui.visuals().text_color();
    lines.name_at(Vec3::new(0.5 * WIDTH, -BELOW, 0.0), text, x);
    lines.name_at(Vec3::new(0.2 * WIDTH, 1.04, 0.0), text, y);
    let color = lines.palette.ray(RayRole::Camera);
    for [low, high] in &case.bars {
        let stroke = Stroke::new(1.0, lines.palette.attention);
        lines.line(*low, *high, stroke, Hidden::Shown);
    }
    let [mean, right] = [color, lines.palette.right].map(|color| Stroke::new(2.0, color));
    lines.path(&case.curve, mean, Hidden::Shown, Pattern::Solid);
    lines.path(&case.right, right, Hidden::Shown, Pattern::Dashed);
    for &dot in case.dots.iter().take(MAX_SAMPLES) {
        lines.disc(dot, 2.0, color);
    }
    for level in &case.levels {
        let (color, pattern) = match level.is_right {
            true => (lines.palette.right, Pattern::Dashed),
            false => (lines.palette.wrong, Pattern::Solid),
        };
        let [from, to] = [0.0, WIDTH].map(|x| Vec3::new(x, level.y, 0.0));
        let stroke = Stroke::new(1.5, color);
        lines.patterned(from, to, stroke, Hidden::Shown, pattern);
        // Two names at one height stand beside each other, and that of a lower bound below it.
        let share = if level.is_right { 0.75 } else { 0.25 };
        let mut rights = case.levels.iter().filter(|other| other.is_right);
        let is_lower = level.is_right && rights.any(|other| other.y > level.y);
        let y = if is_lower { level.y - BELOW } else { level.y };
        lines.name_at(Vec3::new(share * WIDTH, y, 0.0), color, &level.name);
    }
}
