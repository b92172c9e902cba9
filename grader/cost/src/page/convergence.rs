//! How the error of pictures falls with samples and with time.

use super::canvas::{Drawn, Label, svg};
use super::look::{self, INK, Look, Marker};
use super::plot::{Axis, Plot, legend};
use super::words::{figures, list, percent, tick};
use crate::picture::{Curve, Experiment, Point};
use grader::error::GraderError;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 300.0;
/// Width of each of the two plots; the legend has the rest.
const PLOT: f64 = 345.0;

/// The line that independent samples keep to.
const HALF: Look = Look {
    color: INK,
    marker: Marker::Disc,
    hollow: false,
    dashes: Some([1.5, 3.0]),
};

/// Two curves are said to differ in efficiency from this factor on: times scatter.
const DIFFERENT: f64 = 1.1;

/// The plots of one question, and what they show.
pub(crate) fn figure(experiment: &Experiment) -> Result<(String, String), GraderError> {
    let says = format!("Error of pictures: {}", experiment.title);
    let drawn = svg(WIDTH, HEIGHT, &says, |canvas| -> Drawn {
        let points = || experiment.curves.iter().flat_map(|curve| &curve.points);
        let error = |p: &Point| p.error(experiment.is_relative);
        let errors: Vec<f64> = points()
            .flat_map(|p| [error(p).value, error(p).high])
            .collect();
        let y_name = if experiment.is_relative {
            "relative error of a pixel"
        } else {
            "RMSE, share of the mean"
        };
        let axes = [
            (
                "error against samples",
                Axis::log("samples a pixel", points().map(|p| p.samples), tick),
                (|p| p.samples) as fn(&Point) -> f64,
            ),
            (
                "error against time",
                Axis::log("seconds on one thread", points().map(|p| p.seconds), tick),
                (|p| p.seconds) as fn(&Point) -> f64,
            ),
        ];
        for (i, (title, x, of)) in axes.into_iter().enumerate() {
            let y = Axis::log(y_name, errors.iter().copied(), tick);
            let plot = Plot::new(canvas, title, (i as f64 * PLOT, 0.0), [PLOT, HEIGHT], x, y)?;
            half_line(&plot, experiment, of)?;
            for (k, curve) in experiment.curves.iter().enumerate() {
                let look = Look::of(k);
                let mut values: Vec<(f64, f64)> = curve
                    .points
                    .iter()
                    .map(|p| (of(p), error(p).value))
                    .collect();
                values.sort_by(|a, b| a.0.total_cmp(&b.0));
                plot.line(look, &values, 1.4)?;
                for point in &curve.points {
                    plot.error_bar(look, of(point), error(point).low, error(point).high)?;
                    plot.marker(look, (of(point), error(point).value), 30.0)?;
                }
            }
        }
        let of_curve = |(k, curve): (usize, &Curve)| (Some(Look::of(k)), curve.name.clone());
        let entries: Vec<_> = experiment.curves.iter().enumerate().map(of_curve).collect();
        let corner = (2.0 * PLOT + 8.0, 34.0);
        legend(canvas, corner, &entries)?;
        let below = corner.1 + 15.0 * entries.len() as f64;
        look::line(
            canvas,
            HALF,
            &[(corner.0, below), (corner.0 + 26.0, below)],
            1.0,
        )?;
        canvas.text(
            "falls as n^(-1/2)",
            (corner.0 + 32.0, below),
            Label::left(9.5),
        )
    })?;
    Ok((drawn, words(experiment)))
}

/// The line that independent samples keep to, through the last point of the curve that comes nearest to it. `of` is what is
/// drawn across.
fn half_line(plot: &Plot, experiment: &Experiment, of: fn(&Point) -> f64) -> Drawn {
    let off = |curve: &Curve| {
        curve
            .slope
            .map_or(f64::INFINITY, |slope| (slope + 0.5).abs())
    };
    let curves = experiment.curves.iter();
    let nearest = curves.min_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(last) = nearest.and_then(|curve| curve.points.iter().rfind(|p| p.is_random())) else {
        return Ok(());
    };
    let error = last.error(experiment.is_relative).value;
    // From where it enters the plot to where it leaves it.
    let reaches = |height: f64| of(last) * (error / height).powi(2);
    let ((from, to), (low, high)) = (plot.x_ends(), plot.y_ends());
    let ends = [from.max(reaches(high)), to.min(reaches(low))];
    let line = ends.map(|x| (x, error * (of(last) / x).sqrt()));
    plot.line(HALF, &line, 1.0)
}

/// What the numbers say.
fn words(experiment: &Experiment) -> String {
    let Experiment { seeds, .. } = experiment;
    let mut said = format!(
        "Each point is the mean of {seeds} pictures of {} with random numbers of their own; bars reach as far as the mean \
         error may be with 95 % confidence. The pictures that they are held against still have an error of {}. ",
        experiment.scene,
        percent(experiment.converged_rmse),
    );
    let slopes: Vec<String> = experiment
        .curves
        .iter()
        .filter_map(|curve| {
            let slope = curve.slope?;
            Some(format!("{slope:.2} ({})", curve.name))
        })
        .collect();
    if !slopes.is_empty() {
        said += &format!(
            "The error falls as the number of samples to the power of {}. ",
            list(&slopes)
        );
    }
    said += &against_the_first(experiment);
    said += &efficiencies(experiment);
    said += &biases(experiment);
    said
}

/// 1/(variance · seconds) of the longest pictures, against the first way's.
fn efficiencies(experiment: &Experiment) -> String {
    let of = |curve: &Curve| curve.points.iter().rev().find_map(|p| p.efficiency);
    let [first, others @ ..] = experiment.curves.as_slice() else {
        return String::new();
    };
    let Some(one) = of(first) else {
        return String::new();
    };
    let each = others.iter().filter_map(|curve| {
        let times = figures(of(curve)? / one);
        Some(format!("{times} ({})", curve.name))
    });
    let each: Vec<String> = each.collect();
    if each.is_empty() {
        return String::new();
    }
    format!(
        "Efficiency, 1/(variance · seconds), of the longest pictures, where that of {} is 1: {}. ",
        first.name,
        list(&each)
    )
}

/// Time to an equal error, way by way, against the first.
fn against_the_first(experiment: &Experiment) -> String {
    let [first, others @ ..] = experiment.curves.as_slice() else {
        return String::new();
    };
    let error = |p: &Point| p.error(experiment.is_relative).value;
    // The error of the first way's longest picture that others reach, too, within their plots.
    let gain = |curve: &Curve| {
        first.points.iter().rev().find_map(|p| {
            let seconds = curve.at_error(error(p), error, |p| p.seconds)?;
            Some((error(p), p.seconds / seconds))
        })
    };
    let mut said = Vec::new();
    for curve in others {
        if let Some((error, gain)) = gain(curve) {
            said.push(if (1.0 / DIFFERENT..DIFFERENT).contains(&gain) {
                format!(
                    "{} takes as long to an error of {}",
                    curve.name,
                    percent(error)
                )
            } else if gain > 1.0 {
                format!(
                    "{} comes to an error of {} {} times as fast",
                    curve.name,
                    percent(error),
                    figures(gain)
                )
            } else {
                format!(
                    "{} takes {} times as long to an error of {}",
                    curve.name,
                    figures(1.0 / gain),
                    percent(error)
                )
            });
        }
    }
    if said.is_empty() {
        return String::new();
    }
    format!("Against {}: {}. ", first.name, said.join("; "))
}

/// What more samples will not mend.
fn biases(experiment: &Experiment) -> String {
    let biased: Vec<String> = experiment
        .curves
        .iter()
        .filter_map(|curve| {
            let longest = curve
                .points
                .iter()
                .max_by(|a, b| a.samples.total_cmp(&b.samples))?;
            Some(format!("{} ({})", percent(longest.bias?), curve.name))
        })
        .collect();
    let centred = experiment.curves.iter().flat_map(|curve| &curve.points);
    let mut said = match centred.filter(|p| !p.is_random()).find_map(|p| p.bias) {
        Some(bias) => format!(
            "A single sample goes through the centre of its pixel, so nothing is random about it, and it is {} off. ",
            percent(bias)
        ),
        None => String::new(),
    };
    said += &if biased.is_empty() {
        "At the right end no way is off on average by more than chance explains.".to_string()
    } else {
        format!(
            "What no number of samples mends, at the right end of each curve: {}. The others are not off by more than chance explains.",
            list(&biased)
        )
    };
    said
}
