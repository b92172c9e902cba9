//! The results for pictures as text tables.

use super::curve::{ConfidenceInterval, Experiment, PictureReport};
use crate::table::{factor, plus_minus};
use comfy_table::{Cell, CellAlignment, Table, presets};
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
    let mut table = Table::new();
    table.load_style(presets::UTF8_BORDERS_ONLY).set_header([
        "picture",
        "samples",
        "ms",
        "RMSE %",
        "relative %",
        "slope",
        "bias %",
        "mean %",
        "efficiency",
    ]);
    for curve in &experiment.curves {
        for (i, point) in curve.points.iter().enumerate() {
            let numbers = [
                format!("{:.0}", point.samples),
                plus_minus(&point.seconds.scaled(1e3), 1),
                share(point.rmse),
                share(point.relative_mse.sqrt()),
                // Once per curve, in its last row.
                curve
                    .slope
                    .filter(|_| i + 1 == curve.points.len())
                    .map_or(String::new(), |slope| format!("{slope:.2}")),
                point
                    .bias
                    .map_or(String::new(), |bias| format!("{:.1}", 100.0 * bias)),
                format!("{:+.1}", 100.0 * point.mean_difference),
                point
                    .relative_efficiency
                    .map_or(String::new(), |ratio| factor(&ratio)),
            ];
            let name = if i == 0 { curve.name.as_str() } else { "" };
            let numbers = numbers.map(|n| Cell::new(n).set_alignment(CellAlignment::Right));
            table.add_row([Cell::new(name)].into_iter().chain(numbers));
        }
    }
    table
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
