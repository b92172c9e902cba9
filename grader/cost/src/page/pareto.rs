//! Accuracy against time with its error, and the Pareto front of the kernels.

use super::canvas::{Canvas, DrawResult, Label, Position, svg};
use super::formatting::{name, tick};
use super::front::front;
use super::pareto_caption::caption;
use super::plot::{Axis, Plot};
use super::style::{self, INK, Marker, SeriesStyle};
use crate::report::{KernelFamily, KernelRow, Precision, Shape};
use grader::error::GraderError;

const WIDTH: f64 = 860.0;
const PLOT: [f64; 2] = [560.0, 380.0];
const LINE: f64 = 15.5;

/// Area in square points of the markers of a kernel that is never wrong and of one that is always
/// wrong.
const AREA: [f64; 2] = [26.0, 420.0];

/// Font size of the numbers beside markers.
const NUMBER: f64 = 9.0;

/// Draws the plot; returns the SVG and its caption.
pub(crate) fn figure(family: &KernelFamily) -> Result<(String, String), GraderError> {
    let height = PLOT[1].max(34.0 + LINE * (family.rows.len() + 5) as f64);
    let label = format!("Correct bits against time: {}", family.shape.name());
    let figure_html = svg(WIDTH, height, &label, |canvas| -> DrawResult {
        let times = family.rows.iter().map(|row| row.ranked_time().ratio);
        let times = times.flat_map(|ratio| [ratio.lower, ratio.upper]);
        let x = Axis::log("time / time of the textbook kernel", times, tick);
        let ticks = (0..=5)
            .map(|i| f64::from(10 * i))
            .map(|v| (v, v.to_string()));
        let y = Axis::linear(
            "correct bits of t, mean of ray families",
            0.0,
            56.0,
            ticks.collect(),
        );
        let plot = Plot::new(canvas, "correct bits against time", (0.0, 0.0), PLOT, x, y)?;
        front_line(&plot, family)?;
        for (i, row) in family.rows.iter().enumerate() {
            let ratio = row.ranked_time().ratio;
            let ends = [ratio.lower, ratio.upper];
            plot.time_bar(style_of(i, row), ends, row.mean_correct_bits())?;
        }
        // Large markers first, so that they do not hide small ones.
        let mut order: Vec<usize> = (0..family.rows.len()).collect();
        order.sort_by(|a, b| {
            failure_rate(&family.rows[*b]).total_cmp(&failure_rate(&family.rows[*a]))
        });
        let mut taken: Vec<(Position, f64)> = Vec::new();
        for i in &order {
            let row = &family.rows[*i];
            let (x, y) = at(row);
            let position = plot.at(x, y);
            style::marker(canvas, style_of(*i, row), position, area(row))?;
            taken.push((position, (area(row) / std::f64::consts::PI).sqrt() + 1.0));
        }
        for (i, row) in family.rows.iter().enumerate() {
            let (x, y) = at(row);
            let position = plot.at(x, y);
            number(canvas, i + 1, position, &mut taken)?;
        }
        names(canvas, family)
    })?;
    Ok((figure_html, caption(family)))
}

/// Returns the values that a kernel is drawn at.
fn at(row: &KernelRow) -> (f64, f64) {
    (row.ranked_time().ratio.median, row.mean_correct_bits())
}

/// Returns the fraction of leaks, or for spheres and boxes the fraction of wrong decisions in the
/// worst family of rays.
pub(super) fn failure_rate(row: &KernelRow) -> f64 {
    let wrong = row.by_ray_family.iter().map(|a| a.wrong_per_million());
    row.leaks_per_million.unwrap_or(wrong.fold(0.0, f64::max)) / 1e6
}

fn area(row: &KernelRow) -> f64 {
    AREA[0] + (AREA[1] - AREA[0]) * failure_rate(row).min(1.0)
}

/// Colour and shape show the precision; a hollow marker has no leaks or wrong decisions.
fn style_of(_: usize, row: &KernelRow) -> SeriesStyle {
    let i = match row.precision {
        Precision::F64 => 0,
        Precision::F32 => 1,
        Precision::F32InF64 => 2,
    };
    SeriesStyle {
        marker: if row.student {
            Marker::Star
        } else {
            SeriesStyle::of(i).marker
        },
        hollow: failure_rate(row) == 0.0 && !row.student,
        dashes: None,
        ..SeriesStyle::of(if row.student { 3 } else { i })
    }
}

/// Draws the front as a step function, through the fastest kernel of each step.
fn front_line(plot: &Plot, family: &KernelFamily) -> DrawResult {
    let mut corners: Vec<(f64, f64)> = Vec::new();
    for step in front(&family.rows) {
        let Some(fastest) = step.first() else {
            continue;
        };
        let (x, y) = at(fastest);
        if let Some((_, before)) = corners.last().copied() {
            corners.push((x, before));
        }
        corners.push((x, y));
    }
    let style = SeriesStyle {
        color: INK,
        dashes: Some([4.0, 3.0]),
        ..SeriesStyle::of(0)
    };
    plot.line(style, &corners, 0.9)
}

/// Draws a kernel's number at a free position near its marker, with a thin line to the marker if it
/// is not close.
fn number(
    canvas: &Canvas,
    i: usize,
    (x, y): Position,
    taken: &mut Vec<(Position, f64)>,
) -> DrawResult {
    let half = NUMBER * 0.62;
    // From above on: beside the marker is its error bar.
    let around = (0..6).flat_map(|ring| {
        (0..12).map(move |k| {
            (
                10.0 + 8.0 * f64::from(ring),
                f64::from(k + 3) * std::f64::consts::PI / 6.0,
            )
        })
    });
    let free = around
        .map(|(out, angle)| (x + out * angle.cos(), y - out * angle.sin()))
        .find(|at| {
            taken
                .iter()
                .all(|(other, radius)| (at.0 - other.0).hypot(at.1 - other.1) >= radius + half)
        });
    let at = free.unwrap_or((x, y));
    if (at.0 - x).hypot(at.1 - y) > 16.0 {
        canvas.line(&[(x, y), at], INK, 0.4)?;
        canvas.disc(at, half, plotters::style::WHITE, None)?;
    }
    taken.push((at, half));
    canvas.text(&i.to_string(), at, Label::centered(NUMBER))
}

/// Draws the names of the kernels and the legend of the markers.
fn names(canvas: &Canvas, family: &KernelFamily) -> DrawResult {
    let (x, mut y) = (PLOT[0] + 14.0, 24.0);
    for (i, row) in family.rows.iter().enumerate() {
        canvas.text(
            &(i + 1).to_string(),
            (x + 14.0, y),
            Label::right(NUMBER + 0.5),
        )?;
        style::marker(canvas, style_of(i, row), (x + 26.0, y), AREA[0])?;
        let label = Label::left(NUMBER + 0.5);
        let label = if row.student { label.bold() } else { label };
        canvas.text(&name(row), (x + 36.0, y), label)?;
        y += LINE;
    }
    let failure = match family.shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong decisions (worst family)",
    };
    y += 0.5 * LINE;
    for (share, text) in [
        (None, format!("hollow: no {failure}")),
        (Some(0.1), format!("10 % {failure}")),
        (Some(0.5), format!("50 % {failure}")),
    ] {
        let area = share.map_or(AREA[0], |share| AREA[0] + share * (AREA[1] - AREA[0]));
        let style = SeriesStyle {
            color: INK,
            hollow: share.is_none(),
            ..SeriesStyle::of(0)
        };
        style::marker(canvas, style, (x + 26.0, y), area)?;
        canvas.text(&text, (x + 40.0, y), Label::left(NUMBER + 0.5))?;
        y += LINE * 1.15;
    }
    let label = Label::left(NUMBER);
    canvas.text("dashed: Pareto front", (x + 6.0, y), label)?;
    canvas.text("bars: quartiles of the times", (x + 6.0, y + LINE), label)
}
