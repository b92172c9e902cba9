//! Pictures as a table.

use super::curve::{Experiment, Interval, Pictures, Point};
use comfy_table::{Cell, CellAlignment, Table, presets};
use std::fmt::Write;

/// What the numbers are.
const LEGEND: &str = "\
Errors are shares of the picture's mean: root mean square, and relative to each pixel's own value; in brackets where\n\
the mean error lies with 95 % confidence. Slope: the error falls as the samples to this power. Bias: what is off on\n\
average and can be told from chance. Efficiency is 1/(variance x seconds), that of the first way being 1.\n";

/// All questions, for people.
pub fn show(pictures: &Pictures) -> String {
    let mut text = String::new();
    for experiment in &pictures.experiments {
        let [_, _, w, h] = experiment.cell;
        let _ = writeln!(
            text,
            "\n{}: {}, {w} x {h} pixels, {} pictures a row",
            experiment.title, experiment.scene, experiment.seeds
        );
        if !experiment.curves.is_empty() {
            let _ = writeln!(text, "{}", table(experiment));
        }
        if let Some(missing) = &experiment.missing {
            let _ = writeln!(text, "Not complete: {missing}.");
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
        "efficiency",
    ]);
    let first = experiment.curves.first();
    for curve in &experiment.curves {
        for (i, point) in curve.points.iter().enumerate() {
            let one = first.and_then(|first| first.points.get(i)?.efficiency);
            let efficiency = point.efficiency.zip(one).map(|(this, one)| this / one);
            let numbers = [
                format!("{:.0}", point.samples),
                milliseconds(point),
                share(point.rmse),
                share(point.relative_mse.sqrt()),
                // Once a curve, where it ends.
                curve
                    .slope
                    .filter(|_| i + 1 == curve.points.len())
                    .map_or(String::new(), |slope| format!("{slope:.2}")),
                point
                    .bias
                    .map_or(String::new(), |bias| format!("{:.1}", 100.0 * bias)),
                efficiency.map_or(String::new(), |times| format!("{times:.2}")),
            ];
            let name = if i == 0 { curve.name.as_str() } else { "" };
            let numbers = numbers.map(|n| Cell::new(n).set_alignment(CellAlignment::Right));
            table.add_row([Cell::new(name)].into_iter().chain(numbers));
        }
    }
    table
}

fn milliseconds(point: &Point) -> String {
    format!(
        "{:.1} ±{:.1}",
        1e3 * point.seconds,
        1e3 * point.seconds_spread
    )
}

fn share(error: Interval) -> String {
    let [value, low, high] = [error.value, error.low, error.high].map(|e| percent(100.0 * e));
    format!("{value} [{low}, {high}]")
}

/// Two decimals, one from ten on.
fn percent(number: f64) -> String {
    if number < 9.995 {
        format!("{number:.2}")
    } else {
        format!("{number:.1}")
    }
}
