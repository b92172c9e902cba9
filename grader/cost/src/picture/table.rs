//! The results for pictures as text tables.

use super::curve::{ConfidenceInterval, Curve, CurvePoint, Experiment, PictureReport};
use crate::cells::{factor, framed, plus_minus};
use comfy_table::Table;
use plots::columns::Columns;
use std::fmt::Write;

/// Explains the columns.
const LEGEND: &str = "\
Errors are in % of the picture's mean (RMSE) and of each pixel's own value (relative); in brackets the 95 % confidence\n\
interval of the mean error. Slope: exponent of the error as a power of the samples. Bias: significant difference of the\n\
mean picture from the converged one, pixel by pixel; mean: that of its mean value, which noise may hide. Efficiency:\n\
1/(MSE x seconds), relative to the first method's picture of the same round; the squared bias is a part of the MSE (in\n\
adaptive sampling, of the relative one). ± reaches the farther quartile.\n";

/// Formats all experiments.
pub fn show(pictures: &PictureReport) -> String {
    let mut text = String::new();
    for experiment in &pictures.experiments {
        let [_, _, w, h] = experiment.cell;
        let _ = writeln!(
            text,
            "\n{}: {}, {w} x {h} pixels, {} pictures per row",
            experiment.title, experiment.scene, experiment.seeds
        );
        if !experiment.curves.is_empty() {
            let _ = writeln!(text, "{}", table(experiment));
        }
        if let Some(missing) = &experiment.missing {
            let _ = writeln!(text, "Incomplete: {missing}.");
        }
    }
    match &pictures.missing {
        Some(missing) => {
            let _ = writeln!(text, "\nNo pictures: {missing}.");
        }
        None => text.push_str(LEGEND),
    }
    text
}

fn table(experiment: &Experiment) -> Table {
    let columns = Columns::new("picture", |row: &Row| match row.is_first {
        true => row.curve.name.clone(),
        false => String::new(),
    })
    .and("samples", |row| format!("{:.0}", row.point.samples))
    .and("ms", |row| plus_minus(&row.point.seconds.scaled(1e3), 1))
    .and("RMSE %", |row| share(row.point.rmse))
    .and("relative %", |row| share(row.point.relative_mse.sqrt()))
    .and("slope", |row| {
        let slope = row.curve.slope.filter(|_| row.is_last);
        slope.map_or(String::new(), |slope| format!("{slope:.2}"))
    })
    .and("bias %", |row| {
        let bias = row.point.bias;
        bias.map_or(String::new(), |bias| format!("{:.1}", 100.0 * bias))
    })
    .and("mean %", |row| {
        format!("{:+.1}", 100.0 * row.point.mean_difference)
    })
    .and("efficiency", |row| {
        let efficiency = row.point.relative_efficiency.as_ref();
        efficiency.map_or(String::new(), factor)
    });
    let rows = experiment.curves.iter().flat_map(|curve| {
        let points = curve.points.iter().enumerate();
        points.map(move |(i, point)| Row {
            curve,
            point,
            is_first: i == 0,
            is_last: i + 1 == curve.points.len(),
        })
    });
    framed(&columns, &rows.collect::<Vec<_>>())
}

/// A point of a curve, whose name is in its first row, and whose slope is in its last.
struct Row<'a> {
    curve: &'a Curve,
    point: &'a CurvePoint,
    is_first: bool,
    is_last: bool,
}

fn share(error: ConfidenceInterval) -> String {
    let [value, low, high] = [error.value, error.low, error.high].map(|e| percent(100.0 * e));
    format!("{value} [{low}, {high}]")
}

/// Formats with two decimals, from ten on with one.
fn percent(number: f64) -> String {
    if number < 9.995 {
        format!("{number:.2}")
    } else {
        format!("{number:.1}")
    }
}
