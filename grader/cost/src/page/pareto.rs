//! Accuracy against time with its error, and the Pareto front of the kernels.

use super::front::front;
use super::kernel_name::name;
use super::pareto_caption::{caption, finding};
use crate::report::{KernelFamily, KernelRow, Precision, Shape};
use crate::table::plus_minus;
use base::GraderError;
use plots::canvas::{Canvas, DrawResult, Label, Position, svg};
use plots::figure::{Figure, heads};
use plots::labels::Labels;
use plots::numbers::{percent, tick};
use plots::plot::{Axis, Plot};
use plots::style::{self, INK, Marker, SeriesStyle};

const PLOT: [f64; 2] = [860.0, 470.0];
/// Height of the legend below the plot.
const KEY: f64 = 26.0;

/// Area in square points of the markers of a kernel that is never wrong and of one that is always
/// wrong.
const AREA: [f64; 2] = [26.0, 420.0];

/// Font size of the names beside markers.
const NAME: f64 = 9.5;

/// Draws the plot.
pub(crate) fn figure(family: &KernelFamily) -> Result<Figure, GraderError> {
    let label = format!("Correct bits against time: {}", family.shape.name());
    let drawing = svg(PLOT[0], PLOT[1] + KEY, &label, |canvas| -> DrawResult {
        let times = family.rows.iter().map(|row| row.ranked_time().ratio);
        let times = times.flat_map(|ratio| [ratio.lower, ratio.upper]);
        let x_name = format!("time / time of the textbook's test ({})", textbook(family));
        let x = Axis::log(&x_name, times, tick);
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
        let corners = front_line(&plot, family)?;
        for row in &family.rows {
            let ratio = row.ranked_time().ratio;
            let ends = [ratio.lower, ratio.upper];
            plot.time_bar(style_of(row), ends, row.mean_correct_bits())?;
        }
        // Large markers first, so that they do not hide small ones.
        let mut order: Vec<&KernelRow> = family.rows.iter().collect();
        order.sort_by(|a, b| failure_rate(b).total_cmp(&failure_rate(a)));
        let mut labels = Labels::new(plot.inner());
        for row in &order {
            let position = place(&plot, row);
            let radius = (area(row) / std::f64::consts::PI).sqrt() + 1.0;
            style::marker(canvas, style_of(row), position, area(row))?;
            labels.keep_free(position, radius);
            let ratio = row.ranked_time().ratio;
            let [from, to] =
                [ratio.lower, ratio.upper].map(|x| plot.at(x, row.mean_correct_bits()));
            labels.keep_box_free([from.0, from.1 - 2.0, to.0, to.1 + 2.0]);
        }
        for ends in corners.windows(2) {
            let [from, to] = [ends[0], ends[1]].map(|(x, y)| plot.at(x, y));
            labels.keep_box_free([
                from.0.min(to.0) - 1.0,
                from.1.min(to.1) - 1.0,
                from.0.max(to.0) + 1.0,
                from.1.max(to.1) + 1.0,
            ]);
        }
        // The fastest first: the crowd is there, and they are what the plot is about.
        order.sort_by(|a, b| at(a).0.total_cmp(&at(b).0));
        for row in order {
            let radius = (area(row) / std::f64::consts::PI).sqrt() + 1.0;
            canvas.tip(place(&plot, row), radius.max(6.0), &tip(family.shape, row));
            let label = Label::left(NAME).in_color(style_of(row).color);
            let label = if row.student { label.bold() } else { label };
            let text = match (row.student, row.textbook) {
                (true, _) => "yours".to_string(),
                (_, true) => format!("{} (textbook)", row.name),
                _ => row.name.clone(),
            };
            labels.place(canvas, &text, place(&plot, row), label)?;
        }
        key(canvas, family)
    })?;
    Ok(Figure {
        finding: finding(family),
        drawing,
        caption: format!(
            "Further up is more accurate, further left is faster than the textbook's test, {}; bars reach from quartile to quartile of the \
             times, filled markers have {}, larger ones more, and no test is beaten on the dashed line, the Pareto front.",
            textbook(family),
            failures(family.shape)
        ),
        notes: caption(family),
        head: heads(&[
            "test",
            "time / textbook's",
            "ns",
            "correct bits",
            failures(family.shape),
        ]),
        rows: family
            .rows
            .iter()
            .map(|row| {
                let time = row.ranked_time();
                vec![
                    name(row),
                    plus_minus(&time.ratio, 2),
                    plus_minus(&time.ns, 1),
                    format!("{:.0}", row.mean_correct_bits().floor()),
                    percent(failure_rate(row)),
                ]
            })
            .collect(),
    })
}

/// The test that times are compared with.
fn textbook(family: &KernelFamily) -> String {
    let textbook = family.rows.iter().find(|row| row.textbook);
    textbook.map_or("none".into(), name)
}

fn failures(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong decisions in the worst family",
    }
}

fn tip(shape: Shape, row: &KernelRow) -> String {
    format!(
        "{}: {} of the textbook's time, {:.0} correct bits, {} {}",
        name(row),
        plus_minus(&row.ranked_time().ratio, 2),
        row.mean_correct_bits().floor(),
        percent(failure_rate(row)),
        failures(shape)
    )
}

fn place(plot: &Plot, row: &KernelRow) -> Position {
    let (x, y) = at(row);
    plot.at(x, y)
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
fn style_of(row: &KernelRow) -> SeriesStyle {
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

/// Draws the front as a step function, through the fastest kernel of each step. Returns its
/// corners.
fn front_line(plot: &Plot, family: &KernelFamily) -> Result<Vec<(f64, f64)>, GraderError> {
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
    plot.line(style, &corners, 0.9)?;
    Ok(corners)
}

/// Draws the legend of the markers below the plot.
fn key(canvas: &Canvas, family: &KernelFamily) -> DrawResult {
    let failure = match family.shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong",
    };
    let precisions = [Precision::F64, Precision::F32, Precision::F32InF64];
    let mut entries: Vec<(SeriesStyle, f64, String)> = precisions
        .into_iter()
        .filter_map(|precision| {
            let mut rows = family.rows.iter();
            let row = rows.find(|row| row.precision == precision && !row.student)?;
            let style = SeriesStyle {
                hollow: true,
                ..style_of(row)
            };
            Some((style, AREA[0], precision.name().to_string()))
        })
        .collect();
    let black = |hollow| SeriesStyle {
        color: INK,
        hollow,
        ..SeriesStyle::of(0)
    };
    entries.push((black(true), AREA[0], format!("hollow: no {failure}")));
    for share in [0.1, 0.5] {
        let area = AREA[0] + share * (AREA[1] - AREA[0]);
        entries.push((
            black(false),
            area,
            format!("{:.0} % {failure}", 100.0 * share),
        ));
    }
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        entries.push((style_of(yours), AREA[0], "yours".into()));
    }
    let (mut x, y) = (60.0, PLOT[1] + 0.4 * KEY);
    for (style, area, text) in entries {
        style::marker(canvas, style, (x, y), area)?;
        let label = Label::left(NAME);
        canvas.text(&text, (x + 14.0, y), label)?;
        x += 36.0 + label.width(&text);
    }
    Ok(())
}
