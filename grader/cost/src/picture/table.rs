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
    // The name is in the first row of a curve, the slope in the last.
    let columns = Columns::new("picture", |(curve, i, _): &Row| match i {
        0 => curve.name.clone(),
        _ => String::new(),
    })
    .and("samples", |(.., point)| format!("{:.0}", point.samples))
    .and("ms", |(.., point)| {
        plus_minus(&point.seconds.scaled(1e3), 1)
    })
    .and("RMSE %", |(.., point)| share(point.rmse))
    .and("relative %", |(.., point)| share(point.relative_mse.sqrt()))
    .and("slope", |(curve, i, _)| {
        let slope = curve.slope.filter(|_| i + 1 == curve.points.len());
        slope.map_or(String::new(), |slope| format!("{slope:.2}"))
    })
    .and("bias %", |(.., point)| {
        let percent = |bias| format!("{:.1}", 100.0 * bias);
        point.bias.map_or(String::new(), percent)
    })
    .and("mean %", |(.., point)| {
        format!("{:+.1}", 100.0 * point.mean_difference)
    })
    .and("efficiency", |(.., point)| {
        let efficiency = point.relative_efficiency.as_ref();
        efficiency.map_or(String::new(), factor)
    });
    let rows = experiment.curves.iter().flat_map(|curve| {
        let points = curve.points.iter().enumerate();
        points.map(move |(i, point)| (curve, i, point))
    });
    framed(&columns, &rows.collect::<Vec<Row>>())
}

/// A point of a curve, and its number.
type Row<'a> = (&'a Curve, usize, &'a CurvePoint);

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
