//! How errors of `t` are distributed, against what may be: the forward error bound.

use super::canvas::{Drawn, Label, svg};
use super::look::{self, BOUND, Look};
use super::plot::{Axis, Plot};
use super::words::{figures, list, name, tick};
use crate::report::{Accuracy, Family, Precision, RayFamily, Row};
use grader::error::GraderError;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 330.0;
const PLOT: f64 = 325.0;
const LINE: f64 = 14.0;

/// Errors below are drawn here: they are 0, or as good as.
const LEAST: f64 = 1e-18;

/// The distributions of a family of kernels, and what they show.
pub(crate) fn figure(family: &Family) -> Result<(String, String), GraderError> {
    let hard = apart(family);
    let says = format!("Distribution of errors of t: {}", family.shape.name());
    let drawn = svg(WIDTH, HEIGHT, &says, |canvas| -> Drawn {
        for (i, rays) in [Some(RayFamily::Ordinary), hard]
            .iter()
            .flatten()
            .enumerate()
        {
            let x = Axis::log("relative error of t", [LEAST, 1.0], tick);
            let ticks = (0..=4)
                .map(|i| f64::from(i) / 4.0)
                .map(|v| (v, format!("{:.0} %", 100.0 * v)));
            let y = Axis::linear("hits with at most this error", 0.0, 1.02, ticks.collect());
            let corner = (i as f64 * PLOT, 0.0);
            let title = format!("rays: {}", rays.name());
            let plot = Plot::new(canvas, &title, corner, [PLOT, HEIGHT], x, y)?;
            for precision in [Precision::F64, Precision::F32] {
                let mut rows = family.rows.iter().filter(|row| row.precision == precision);
                if let Some(bound) = rows
                    .find_map(|row| accuracy(row, *rays).filter(|a| !a.forward_bound.is_empty()))
                {
                    plot.line(bound_look(precision), &steps(&bound.forward_bound), 2.6)?;
                }
            }
            for row in &family.rows {
                if let Some(accuracy) = accuracy(row, *rays).filter(|a| !a.cdf.is_empty()) {
                    plot.line(look_of(family, row), &steps(&accuracy.cdf), width(row))?;
                }
            }
        }
        let x = 2.0 * PLOT + 12.0;
        let mut y = 26.0;
        for precision in [Precision::F64, Precision::F32] {
            let look = bound_look(precision);
            look::line(canvas, look, &[(x, y), (x + 26.0, y)], 2.6)?;
            let text = format!("bound of {}", precision.name());
            canvas.text(&text, (x + 32.0, y), Label::left(9.0))?;
            y += LINE;
        }
        for named in names(family) {
            let rows = || family.rows.iter().filter(|row| row.name == named);
            if let Some(row) = rows().next() {
                look::line(
                    canvas,
                    look_of(family, row),
                    &[(x, y), (x + 26.0, y)],
                    width(row),
                )?;
                let precisions: Vec<&str> = rows().map(|row| row.precision.name()).collect();
                let text = format!("{named} ({})", precisions.join(", "));
                canvas.text(&text, (x + 32.0, y), Label::left(9.0))?;
                y += LINE;
            }
        }
        Ok(())
    })?;
    Ok((drawn, words(family, hard)))
}

/// The kernels' names, each once.
fn names(family: &Family) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for row in &family.rows {
        if !names.contains(&row.name.as_str()) {
            names.push(&row.name);
        }
    }
    names
}

/// A name has a look; its precisions are far enough apart to be told by their place.
fn look_of(family: &Family, row: &Row) -> Look {
    let named = names(family).iter().position(|name| *name == row.name);
    Look::of(named.unwrap_or(0))
}

fn width(row: &Row) -> f64 {
    if row.student { 2.2 } else { 1.2 }
}

fn bound_look(precision: Precision) -> Look {
    Look {
        color: BOUND,
        dashes: (precision != Precision::F64).then_some([8.0, 4.0]),
        ..Look::of(0)
    }
}

fn accuracy(row: &Row, rays: RayFamily) -> Option<&Accuracy> {
    row.by_ray_family.iter().find(|a| a.family == rays)
}

/// A distribution as a line: it starts at no hits, and errors of 0 are drawn at [`LEAST`].
fn steps(distribution: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let shown = distribution
        .iter()
        .map(|(error, share)| (error.max(LEAST), *share));
    let first = shown.clone().next().map(|(error, _)| (error, 0.0));
    let last = shown.clone().next_back().map(|(_, share)| (1.0, share));
    first.into_iter().chain(shown).chain(last).collect()
}

/// The median relative errors of the kernels in f64 on these rays, the smallest and the largest.
fn extremes(family: &Family, rays: RayFamily) -> Option<[(&Row, f64); 2]> {
    let rows = family
        .rows
        .iter()
        .filter(|row| row.precision == Precision::F64);
    let mut errors: Vec<(&Row, f64)> = rows
        .filter_map(|row| Some((row, accuracy(row, rays)?.t?.relative.p50)))
        .collect();
    errors.sort_by(|a, b| a.1.total_cmp(&b.1));
    Some([*errors.first()?, *errors.last()?])
}

/// The family of rays on which the kernels are farthest from each other.
fn apart(family: &Family) -> Option<RayFamily> {
    let distance = |rays: &RayFamily| {
        extremes(family, *rays).map_or(0.0, |[best, worst]| {
            (worst.1.max(LEAST) / best.1.max(LEAST)).ln()
        })
    };
    let hard = family.columns.iter().map(|column| column.family);
    // On the surface t is 0 but for rounding: its relative error says nothing.
    hard.filter(|rays| ![RayFamily::Ordinary, RayFamily::OnTheSurface].contains(rays))
        .max_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// What the numbers say.
fn words(family: &Family, hard: Option<RayFamily>) -> String {
    let mut said = String::new();
    for rays in [Some(RayFamily::Ordinary), hard].into_iter().flatten() {
        if let Some([best, worst]) = extremes(family, rays) {
            said += &format!(
                "On rays of the family “{}” half of the answers of {} are within {} of t, of {} within {}. ",
                rays.name(),
                name(best.0),
                figures(best.1),
                name(worst.0),
                figures(worst.1),
            );
        }
    }
    let beyond = |row: &&Row| {
        let rays = [Some(RayFamily::Ordinary), hard].into_iter().flatten();
        rays.filter_map(|rays| accuracy(row, rays))
            .any(|a| a.beyond_bound_per_million > 0.0)
    };
    let beyond: Vec<String> = family.rows.iter().filter(beyond).map(name).collect();
    said += &if beyond.is_empty() {
        "No answer on either is beyond the bound of its precision (thick grey lines), which allows what a robust kernel may round.".to_string()
    } else {
        format!(
            "Beyond the bound (thick grey lines), which allows what a robust kernel may round, are answers of {}.",
            list(&beyond)
        )
    };
    said
}
