//! Accuracy against time, with the Pareto front of the kernels.

use super::canvas::{Canvas, DrawResult, Label, Position, svg};
use super::formatting::{figures, list, name, percent, tick};
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
    let height = PLOT[1].max(34.0 + LINE * (family.rows.len() + 4) as f64);
    let label = format!("Correct bits against time: {}", family.shape.name());
    let figure_html = svg(WIDTH, height, &label, |canvas| -> DrawResult {
        let times = family.rows.iter().map(|row| row.time.ratio_to_textbook);
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
        // Large markers first, so that they do not hide small ones.
        let mut order: Vec<usize> = (0..family.rows.len()).collect();
        order.sort_by(|a, b| {
            failure_rate(&family.rows[*b]).total_cmp(&failure_rate(&family.rows[*a]))
        });
        let mut taken: Vec<(Position, f64)> = Vec::new();
        for i in &order {
            let row = &family.rows[*i];
            let position = plot.at(row.time.ratio_to_textbook, bits(row));
            style::marker(canvas, style_of(*i, row), position, area(row))?;
            taken.push((position, (area(row) / std::f64::consts::PI).sqrt() + 1.0));
        }
        for (i, row) in family.rows.iter().enumerate() {
            let position = plot.at(row.time.ratio_to_textbook, bits(row));
            number(canvas, i + 1, position, &mut taken)?;
        }
        names(canvas, family)
    })?;
    Ok((figure_html, caption(family)))
}

/// Returns the leading bits of `t` that are correct for half of the rays, averaged over all
/// families of rays. A family with hits in which the kernel finds none counts as 0 bits.
fn bits(row: &KernelRow) -> f64 {
    let bits: kit::Tally = row
        .by_ray_family
        .iter()
        .filter(|a| a.t.is_some() || a.false_misses_per_million > 0.0)
        .map(|a| a.t.map_or(0.0, |t| t.correct_bits()))
        .collect();
    bits.mean()
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

/// Returns the Pareto front: the kernels for which no other kernel is both as fast and as accurate,
/// from the fastest on.
fn front(family: &KernelFamily) -> Vec<&KernelRow> {
    let mut rows: Vec<&KernelRow> = family.rows.iter().collect();
    rows.sort_by(|a, b| {
        a.time
            .ratio_to_textbook
            .total_cmp(&b.time.ratio_to_textbook)
    });
    let mut front: Vec<&KernelRow> = Vec::new();
    for row in rows {
        if front.last().is_none_or(|last| bits(row) > bits(last)) {
            front.push(row);
        }
    }
    front
}

/// Draws the front as a step function.
fn front_line(plot: &Plot, family: &KernelFamily) -> DrawResult {
    let mut corners: Vec<(f64, f64)> = Vec::new();
    for row in front(family) {
        if let Some((_, before)) = corners.last().copied() {
            corners.push((row.time.ratio_to_textbook, before));
        }
        corners.push((row.time.ratio_to_textbook, bits(row)));
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
    canvas.text("dashed: Pareto front", (x + 6.0, y), Label::left(NUMBER))
}

/// Returns the caption, computed from the numbers.
fn caption(family: &KernelFamily) -> String {
    let on_front: Vec<String> = front(family)
        .iter()
        .map(|row| {
            format!(
                "{} ({} times the textbook's time, {:.0} bits{})",
                name(row),
                figures(row.time.ratio_to_textbook),
                bits(row),
                if failure_rate(row) > 0.0 {
                    format!(
                        ", {} {}",
                        failure_name(family.shape),
                        percent(failure_rate(row))
                    )
                } else {
                    String::new()
                }
            )
        })
        .collect();
    let mut text = format!(
        "The Pareto front (no other kernel is both as fast and as accurate), from the fastest on: {}. ",
        list(&on_front)
    );
    let safe = family
        .rows
        .iter()
        .filter(|row| !row.student && failure_rate(row) == 0.0);
    let fastest = safe.min_by(|a, b| {
        a.time
            .ratio_to_textbook
            .total_cmp(&b.time.ratio_to_textbook)
    });
    let without = match family.shape {
        Shape::Triangle => "without leaks",
        Shape::Sphere | Shape::Box => "without wrong decisions",
    };
    text += &match fastest {
        Some(row) => format!(
            "The fastest known kernel {without} is {}: it takes {} times the textbook's time{}. ",
            name(row),
            figures(row.time.ratio_to_textbook),
            if row.time.inside_noise {
                ", a difference within the noise"
            } else {
                ""
            }
        ),
        None => format!("There is no known kernel {without}. "),
    };
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        let better = family.rows.iter().filter(|row| {
            !row.student
                && bits(row) >= bits(yours)
                && row.time.ratio_to_textbook <= yours.time.ratio_to_textbook
        });
        let better: Vec<String> = better.map(name).collect();
        text += &format!(
            "Your code (star) takes {} times the textbook's time and has {:.0} correct bits; {}.",
            figures(yours.time.ratio_to_textbook),
            bits(yours),
            if better.is_empty() {
                "no other kernel is both as fast and as accurate".into()
            } else {
                format!("these are both as fast and as accurate: {}", list(&better))
            }
        );
    }
    text
}

fn failure_name(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong decisions in the worst family:",
    }
}
