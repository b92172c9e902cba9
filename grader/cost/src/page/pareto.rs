//! Accuracy against time: which kernels are worth their time.

use super::canvas::{Canvas, Drawn, Label, Place, svg};
use super::look::{self, INK, Look, Marker};
use super::plot::{Axis, Plot};
use super::words::{figures, list, name, percent, tick};
use crate::report::{Family, Precision, Row, Shape};
use grader::error::GraderError;

const WIDTH: f64 = 860.0;
const PLOT: [f64; 2] = [560.0, 380.0];
const LINE: f64 = 15.5;

/// Square points of a marker of a kernel that is never wrong, and of one that always is.
const AREA: [f64; 2] = [26.0, 420.0];

/// Size of the numbers beside markers.
const NUMBER: f64 = 9.0;

/// The plot of a family of kernels, and what it shows.
pub(crate) fn figure(family: &Family) -> Result<(String, String), GraderError> {
    let height = PLOT[1].max(34.0 + LINE * (family.rows.len() + 4) as f64);
    let says = format!("Correct bits against time: {}", family.shape.name());
    let drawn = svg(WIDTH, height, &says, |canvas| -> Drawn {
        let times = family.rows.iter().map(|row| row.time.ratio_to_textbook);
        let x = Axis::log("time, textbook = 1", times, tick);
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
        // Large ones first, so that they do not hide small ones.
        let mut order: Vec<usize> = (0..family.rows.len()).collect();
        order.sort_by(|a, b| harm(&family.rows[*b]).total_cmp(&harm(&family.rows[*a])));
        let mut taken: Vec<(Place, f64)> = Vec::new();
        for i in &order {
            let row = &family.rows[*i];
            let place = plot.at(row.time.ratio_to_textbook, bits(row));
            look::marker(canvas, look_of(*i, row), place, area(row))?;
            taken.push((place, (area(row) / std::f64::consts::PI).sqrt() + 1.0));
        }
        for (i, row) in family.rows.iter().enumerate() {
            let place = plot.at(row.time.ratio_to_textbook, bits(row));
            number(canvas, i + 1, place, &mut taken)?;
        }
        names(canvas, family)
    })?;
    Ok((drawn, words(family)))
}

/// Leading bits of `t` that are right on half of the rays, the mean over all families of rays; a family in which the kernel
/// finds no hit has none.
fn bits(row: &Row) -> f64 {
    let bits: kit::Tally = row
        .by_ray_family
        .iter()
        .filter(|a| a.t.is_some() || a.false_misses_per_million > 0.0)
        .map(|a| a.t.map_or(0.0, |t| t.correct_bits()))
        .collect();
    bits.mean()
}

/// How often it does harm: leaks, or for shapes that make no meshes wrong decisions on the worst family of rays, as a share.
fn harm(row: &Row) -> f64 {
    let wrong = row.by_ray_family.iter().map(|a| a.wrong_per_million());
    row.leaks_per_million.unwrap_or(wrong.fold(0.0, f64::max)) / 1e6
}

fn area(row: &Row) -> f64 {
    AREA[0] + (AREA[1] - AREA[0]) * harm(row).min(1.0)
}

/// Precision is a colour and a shape; a hollow marker has no harm done.
fn look_of(_: usize, row: &Row) -> Look {
    let i = match row.precision {
        Precision::F64 => 0,
        Precision::F32 => 1,
        Precision::F32InF64 => 2,
    };
    Look {
        marker: if row.student {
            Marker::Star
        } else {
            Look::of(i).marker
        },
        hollow: harm(row) == 0.0 && !row.student,
        dashes: None,
        ..Look::of(if row.student { 3 } else { i })
    }
}

/// The kernels that no other one betters in time without being worse in bits, from the fastest on.
fn front(family: &Family) -> Vec<&Row> {
    let mut rows: Vec<&Row> = family.rows.iter().collect();
    rows.sort_by(|a, b| {
        a.time
            .ratio_to_textbook
            .total_cmp(&b.time.ratio_to_textbook)
    });
    let mut front: Vec<&Row> = Vec::new();
    for row in rows {
        if front.last().is_none_or(|last| bits(row) > bits(last)) {
            front.push(row);
        }
    }
    front
}

/// Steps: from each kernel of the front to the right until the next one is better.
fn front_line(plot: &Plot, family: &Family) -> Drawn {
    let mut corners: Vec<(f64, f64)> = Vec::new();
    for row in front(family) {
        if let Some((_, before)) = corners.last().copied() {
            corners.push((row.time.ratio_to_textbook, before));
        }
        corners.push((row.time.ratio_to_textbook, bits(row)));
    }
    let look = Look {
        color: INK,
        dashes: Some([4.0, 3.0]),
        ..Look::of(0)
    };
    plot.line(look, &corners, 0.9)
}

/// Writes a kernel's number beside its marker, where there is room, and a thin line to it if that is away from it.
fn number(canvas: &Canvas, i: usize, (x, y): Place, taken: &mut Vec<(Place, f64)>) -> Drawn {
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

/// What the numbers stand for, and what the markers mean.
fn names(canvas: &Canvas, family: &Family) -> Drawn {
    let (x, mut y) = (PLOT[0] + 14.0, 24.0);
    for (i, row) in family.rows.iter().enumerate() {
        canvas.text(
            &(i + 1).to_string(),
            (x + 14.0, y),
            Label::right(NUMBER + 0.5),
        )?;
        look::marker(canvas, look_of(i, row), (x + 26.0, y), AREA[0])?;
        let label = Label::left(NUMBER + 0.5);
        let label = if row.student { label.bold() } else { label };
        canvas.text(&name(row), (x + 36.0, y), label)?;
        y += LINE;
    }
    let harm = match family.shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "wrong on its worst rays",
    };
    y += 0.5 * LINE;
    for (share, text) in [
        (None, format!("hollow: never {harm}")),
        (Some(0.1), format!("10 % {harm}")),
        (Some(0.5), format!("50 % {harm}")),
    ] {
        let area = share.map_or(AREA[0], |share| AREA[0] + share * (AREA[1] - AREA[0]));
        let look = Look {
            color: INK,
            hollow: share.is_none(),
            ..Look::of(0)
        };
        look::marker(canvas, look, (x + 26.0, y), area)?;
        canvas.text(&text, (x + 40.0, y), Label::left(NUMBER + 0.5))?;
        y += LINE * 1.15;
    }
    canvas.text(
        "dashed: nothing is faster and as exact",
        (x + 6.0, y),
        Label::left(NUMBER),
    )
}

/// What the numbers say.
fn words(family: &Family) -> String {
    let on_front: Vec<String> = front(family)
        .iter()
        .map(|row| {
            format!(
                "{} ({} of the textbook's time, {:.0} bits{})",
                name(row),
                figures(row.time.ratio_to_textbook),
                bits(row),
                if harm(row) > 0.0 {
                    format!(", {} {}", verb(family.shape), percent(harm(row)))
                } else {
                    String::new()
                }
            )
        })
        .collect();
    let mut said = format!(
        "No other kernel is as fast and as exact as these, from the fastest on: {}. ",
        list(&on_front)
    );
    let safe = family
        .rows
        .iter()
        .filter(|row| !row.student && harm(row) == 0.0);
    let fastest = safe.min_by(|a, b| {
        a.time
            .ratio_to_textbook
            .total_cmp(&b.time.ratio_to_textbook)
    });
    let never = match family.shape {
        Shape::Triangle => "never leaks",
        Shape::Sphere | Shape::Box => "never decides wrongly",
    };
    said += &match fastest {
        Some(row) => format!(
            "The fastest that {never} is {}: it takes {} of the textbook's time{}. ",
            name(row),
            figures(row.time.ratio_to_textbook),
            if row.time.inside_noise {
                ", which is within the noise"
            } else {
                ""
            }
        ),
        None => format!("No known kernel {never}. "),
    };
    if let Some(yours) = family.rows.iter().find(|row| row.student) {
        let better = family.rows.iter().filter(|row| {
            !row.student
                && bits(row) >= bits(yours)
                && row.time.ratio_to_textbook <= yours.time.ratio_to_textbook
        });
        let better: Vec<String> = better.map(name).collect();
        said += &format!(
            "Yours (star) takes {} of the textbook's time and has {:.0} bits; {}.",
            figures(yours.time.ratio_to_textbook),
            bits(yours),
            if better.is_empty() {
                "no other is as fast and as exact".into()
            } else {
                format!("as fast and as exact: {}", list(&better))
            }
        );
    }
    said
}

fn verb(shape: Shape) -> &'static str {
    match shape {
        Shape::Triangle => "leaks",
        Shape::Sphere | Shape::Box => "on its worst rays wrong on",
    }
}
