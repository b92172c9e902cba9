//! Accuracy against time with its error, and the Pareto front of the kernels.

use super::canvas::{Canvas, DrawResult, Label, Position, svg};
use super::formatting::{list, name, percent, tick};
use super::front::{beats, bits, front};
use super::plot::{Axis, Plot};
use super::style::{self, INK, Marker, SeriesStyle};
use crate::report::{KernelFamily, KernelRow, Precision, Shape};
use crate::table::plus_minus;
use crate::timing::Timing;
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
fn failure_rate(row: &KernelRow) -> f64 {
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
    let around = (0..6).flat_map(|ring| {
        (0..12).map(move |k| {
            (
                10.0 + 8.0 * f64::from(ring),
                f64::from(k) * std::f64::consts::PI / 6.0,
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

/// Returns the caption, computed from the numbers.
fn caption(family: &KernelFamily) -> String {
    let mut text = format!(
        "Bits: correct bits of t for half of the rays, averaged over the {} families of rays. The Pareto front (no other kernel is as \
         accurate and faster, or more accurate and as fast within the error bars), from the fastest on: {}. ",
        family.columns.len(),
        list(&front_steps(family)),
    );
    text += &fastest_without_failures(family);
    text += &with_and_without_fma(family);
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        let better = family.rows.iter().filter(|row| beats(row, yours));
        let better: Vec<String> = better.map(name).collect();
        text += &format!(
            "Your code (star) takes {} and has {} correct bits; {}.",
            times_as_long(&yours.time),
            bits(yours),
            if better.is_empty() {
                "no other kernel is as accurate and faster, or more accurate and as fast".into()
            } else {
                format!(
                    "these are as accurate and faster, or more accurate and as fast: {}",
                    list(&better)
                )
            }
        );
    }
    text
}

/// Returns each step of the front: its kernels, their times, bits and failures.
fn front_steps(family: &KernelFamily) -> Vec<String> {
    let kernel = |row: &&KernelRow| {
        let failures = match failure_rate(row) {
            0.0 => String::new(),
            rate => format!(", {} {}", failure_name(family.shape), percent(rate)),
        };
        format!(
            "{} ({}, {} bits{failures})",
            name(row),
            times_as_long(row.ranked_time()),
            bits(row)
        )
    };
    let steps = front(&family.rows).into_iter();
    steps
        .map(|step| {
            let kernels: Vec<String> = step.iter().map(kernel).collect();
            match kernels.as_slice() {
                [_, _, ..] => format!("the tie of {}", list(&kernels)),
                _ => list(&kernels),
            }
        })
        .collect()
}

/// Returns the sentence about the fastest kernels without failures.
fn fastest_without_failures(family: &KernelFamily) -> String {
    let without = match family.shape {
        Shape::Triangle => "without leaks",
        Shape::Sphere | Shape::Box => "without wrong decisions",
    };
    let rows = family.rows.iter();
    let mut safe: Vec<&KernelRow> = rows
        .filter(|row| !row.student && failure_rate(row) == 0.0)
        .collect();
    let time = |row: &KernelRow| row.ranked_time().ratio.median;
    safe.sort_by(|a, b| time(a).total_cmp(&time(b)));
    let Some((fastest, others)) = safe.split_first() else {
        return format!("There is no known kernel {without}. ");
    };
    let ties = others
        .iter()
        .filter(|row| row.ranked_time().ties_with(fastest.ranked_time()));
    let ties: Vec<String> = ties.map(|row| name(row)).collect();
    let takes = times_as_long(fastest.ranked_time());
    if ties.is_empty() {
        format!(
            "The fastest known kernel {without} is {}: it takes {takes}. ",
            name(fastest)
        )
    } else {
        format!(
            "The fastest known kernels {without} are {}, which takes {takes}, and within the error bars {}. ",
            name(fastest),
            list(&ties)
        )
    }
}

/// Returns the sentence about the kernels that use fused multiply-adds: both of their times.
fn with_and_without_fma(family: &KernelFamily) -> String {
    let rows = family.rows.iter().filter(|row| row.uses_fma);
    let both = rows.filter_map(|row| {
        let with_fma = plus_minus(&row.time_with_fma?.ratio, 2);
        let build = plus_minus(&row.time.ratio, 2);
        Some(format!("{} {with_fma} (else {build})", name(row)))
    });
    let both: Vec<String> = both.collect();
    if both.is_empty() {
        return String::new();
    }
    format!(
        "Kernels with fused multiply-adds choose AVX2 and FMA at run time, and are compared with the textbook's kernel with the same \
         instructions: {}. ",
        list(&both)
    )
}

/// Formats a ratio with its error.
fn times_as_long(time: &Timing) -> String {
    format!("{} times the textbook's time", plus_minus(&time.ratio, 2))
}

fn failure_name(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong decisions in the worst family:",
    }
}
