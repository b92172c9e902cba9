//! The error of pictures against samples and against time.

use super::canvas::{DrawResult, Label, svg};
use super::figure::{Figure, heads};
use super::formatting::{figures, list, percent, tick};
use super::plot::{Axis, Plot, legend};
use super::style::{self, INK, Marker, SeriesStyle};
use crate::picture::{Curve, CurvePoint, Experiment, Thumbnail};
use crate::quartiles::Quartiles;
use crate::table::factor;
use grader::error::GraderError;
use pages::html::{escape, png_data_uri};
use pictures::Image;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 300.0;
/// Width of each of the two plots; the rest is for the legend.
const PLOT: f64 = 345.0;

/// The index of the plot against time.
const TIME: usize = 1;

/// The style of the line of slope -1/2.
const HALF_SLOPE: SeriesStyle = SeriesStyle {
    color: INK,
    marker: Marker::Disc,
    hollow: false,
    dashes: Some([1.5, 3.0]),
};

/// Draws the plots of one experiment, and pictures that took equal times.
pub(crate) fn figure(experiment: &Experiment) -> Result<Figure, GraderError> {
    let label = format!("Error of pictures: {}", experiment.title);
    let drawing = svg(WIDTH, HEIGHT, &label, |canvas| -> DrawResult {
        let points = || experiment.curves.iter().flat_map(|curve| &curve.points);
        let error = |p: &CurvePoint| p.error(experiment.is_relative);
        let errors: Vec<f64> = points()
            .flat_map(|p| [error(p).value, error(p).high])
            .collect();
        let y_name = if experiment.is_relative {
            "relative RMSE of a pixel"
        } else {
            "RMSE / mean of the picture"
        };
        let seconds = points().flat_map(|p| [p.seconds.lower, p.seconds.upper]);
        let axes = [
            (
                "error against samples",
                Axis::log(&experiment.samples_are, points().map(|p| p.samples), tick),
                (|p| p.samples) as fn(&CurvePoint) -> f64,
            ),
            (
                "error against time",
                Axis::log("seconds on one thread", seconds, tick),
                (|p| p.seconds.median) as fn(&CurvePoint) -> f64,
            ),
        ];
        for (i, (title, x, of)) in axes.into_iter().enumerate() {
            let y = Axis::log(y_name, errors.iter().copied(), tick);
            let plot = Plot::new(canvas, title, (i as f64 * PLOT, 0.0), [PLOT, HEIGHT], x, y)?;
            half_slope_line(&plot, experiment, of)?;
            for (k, curve) in experiment.curves.iter().enumerate() {
                let style = SeriesStyle::of(k);
                let mut values: Vec<(f64, f64)> = curve
                    .points
                    .iter()
                    .map(|p| (of(p), error(p).value))
                    .collect();
                values.sort_by(|a, b| a.0.total_cmp(&b.0));
                plot.line(style, &values, 1.4)?;
                for point in &curve.points {
                    plot.error_bar(style, of(point), error(point).low, error(point).high)?;
                    if i == TIME {
                        let ends = [point.seconds.lower, point.seconds.upper];
                        plot.time_bar(style, ends, error(point).value)?;
                    }
                    plot.marker(style, (of(point), error(point).value), 30.0)?;
                    let at = plot.at(of(point), error(point).value);
                    canvas.tip(at, 6.0, &tip(curve, point, experiment.is_relative));
                }
            }
        }
        let of_curve = |(k, curve): (usize, &Curve)| (Some(SeriesStyle::of(k)), curve.name.clone());
        let entries: Vec<_> = experiment.curves.iter().enumerate().map(of_curve).collect();
        let corner = (2.0 * PLOT + 8.0, 34.0);
        legend(canvas, corner, &entries)?;
        let below = corner.1 + 15.0 * entries.len() as f64;
        style::line(
            canvas,
            HALF_SLOPE,
            &[(corner.0, below), (corner.0 + 26.0, below)],
            1.0,
        )?;
        canvas.text("slope -1/2", (corner.0 + 32.0, below), Label::left(9.5))
    })?;
    let last = |curve: &Curve| curve.points.last().cloned();
    let rows = experiment.curves.iter().map(|curve| {
        let last = last(curve);
        let number = |of: &dyn Fn(&CurvePoint) -> Option<String>| {
            last.as_ref().and_then(of).unwrap_or("–".into())
        };
        vec![
            curve.name.clone(),
            number(&|p| Some(figures(p.samples))),
            number(&|p| Some(percent(error_of(p, experiment.is_relative)))),
            number(&|p| Some(figures(p.seconds.median))),
            curve
                .slope
                .map_or("–".into(), |slope| format!("{slope:.2}")),
            number(&|p| p.bias.map(percent)),
            number(&|p| p.relative_efficiency.as_ref().map(factor)),
        ]
    });
    Ok(Figure {
        finding: finding(experiment),
        drawing: drawing + &thumbnails(experiment),
        caption: format!(
            "The error of {} against {} and against time, with 95 % confidence intervals over {} pictures{}.",
            experiment.scene,
            experiment.samples_are,
            experiment.seeds,
            match experiment.reference {
                Some(_) => "; below, pictures that took about the same time",
                None => "",
            }
        ),
        notes: caption(experiment),
        head: heads(&[
            "method",
            &experiment.samples_are,
            "error",
            "seconds",
            "slope",
            "bias",
            "efficiency, ratio",
        ]),
        rows: rows.collect(),
    })
}

fn error_of(point: &CurvePoint, is_relative: bool) -> f64 {
    point.error(is_relative).value
}

fn tip(curve: &Curve, point: &CurvePoint, is_relative: bool) -> String {
    format!(
        "{}, {}: error {}, {} s",
        curve.name,
        point.flags,
        percent(error_of(point, is_relative)),
        figures(point.seconds.median)
    )
}

/// What the plot shows: the method that reaches an equal error in the least time.
fn finding(experiment: &Experiment) -> String {
    let title = &experiment.title;
    let Some((base, others)) = experiment.curves.split_first() else {
        return title.clone();
    };
    let compared = others
        .iter()
        .filter_map(|curve| Some((curve, to_equal_error(experiment, base, curve)?)));
    let faster = compared.filter(|(_, to)| !to.ties && to.speedup > 1.0);
    if let Some((curve, to)) = faster.max_by(|a, b| a.1.speedup.total_cmp(&b.1.speedup)) {
        return format!(
            "{title}: {} reaches the same error as {} {} times as fast",
            curve.name,
            base.name,
            figures(to.speedup)
        );
    }
    // Errors that have nothing in common are compared where the times are alike.
    let at_equal_time = |curve: &Curve| {
        let (point, _) = curve.at_equal_time.as_ref()?;
        Some(error_of(curve.points.get(*point)?, experiment.is_relative))
    };
    let smallest = others
        .iter()
        .filter_map(|curve| Some((curve, at_equal_time(curve)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1));
    match smallest.zip(at_equal_time(base)) {
        Some(((curve, error), of_base)) if of_base > CLEARLY * error => format!(
            "{title}: {} has {} of the error of {} after about the same time",
            curve.name,
            percent(error / of_base),
            base.name
        ),
        _ => format!("{title}: no method is clearly better than {}", base.name),
    }
}

/// Errors that differ by less than this factor are not told apart in a heading.
const CLEARLY: f64 = 1.5;

/// The converged picture, and one of each method: those whose times are most alike.
fn thumbnails(experiment: &Experiment) -> String {
    let Some(reference) = &experiment.reference else {
        return String::new();
    };
    let figure = |picture: &Thumbnail, text: &str| {
        let [w, h] = picture.size;
        let mut pixels = picture.pixels.iter();
        let image = Image::from_fn([w, h], |_, _| pixels.next().copied().unwrap_or_default());
        let text = escape(text);
        format!(
            "<figure><img src=\"{}\" alt=\"{text}\"><figcaption>{text}</figcaption></figure>",
            png_data_uri(&image)
        )
    };
    let mut html = format!(
        "<div class=\"thumbnails\">{}",
        figure(reference, "converged")
    );
    for curve in &experiment.curves {
        if let Some((point, picture)) = &curve.at_equal_time
            && let Some(point) = curve.points.get(*point)
        {
            let text = format!(
                "{}: {} s, error {}",
                curve.name,
                figures(point.seconds.median),
                percent(error_of(point, experiment.is_relative))
            );
            html += &figure(picture, &text);
        }
    }
    html + "</div>"
}

/// Draws a line of slope -1/2, the convergence rate of independent samples. It goes through the
/// last random point of the curve whose slope is closest to -1/2. `of` returns the x coordinate of
/// a point.
fn half_slope_line(plot: &Plot, experiment: &Experiment, of: fn(&CurvePoint) -> f64) -> DrawResult {
    let deviation = |curve: &Curve| {
        curve
            .slope
            .map_or(f64::INFINITY, |slope| (slope + 0.5).abs())
    };
    let curves = experiment.curves.iter();
    let nearest = curves.min_by(|a, b| deviation(a).total_cmp(&deviation(b)));
    let Some(last) = nearest.and_then(|curve| curve.points.iter().rfind(|p| p.is_random())) else {
        return Ok(());
    };
    let error = last.error(experiment.is_relative).value;
    // The line is clipped to the plot.
    let x_at = |y: f64| of(last) * (error / y).powi(2);
    let ((from, to), (low, high)) = (plot.x_ends(), plot.y_ends());
    let ends = [from.max(x_at(high)), to.min(x_at(low))];
    let line = ends.map(|x| (x, error * (of(last) / x).sqrt()));
    plot.line(HALF_SLOPE, &line, 1.0)
}

/// Returns the caption, computed from the numbers.
fn caption(experiment: &Experiment) -> String {
    let Experiment { seeds, .. } = experiment;
    let mut text = format!(
        "Each point is the mean over {seeds} pictures of {} with independent random numbers; error bars are 95 % confidence \
         intervals of the mean error, and quartiles of the times. The reference picture has a remaining error of {}. ",
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
        text += &format!(
            "The slope of log(error) against log(samples) is {}. ",
            list(&slopes)
        );
    }
    text += &times_to_equal_error(experiment);
    text += &efficiencies(experiment);
    text += &biases(experiment);
    text
}

/// Returns the sentence about efficiency at the largest number of samples, relative to the first
/// curve.
fn efficiencies(experiment: &Experiment) -> String {
    let [first, others @ ..] = experiment.curves.as_slice() else {
        return String::new();
    };
    let each = others.iter().filter_map(|curve| {
        let ratio = curve.points.last()?.relative_efficiency?;
        Some(format!("{} ({})", factor(&ratio), curve.name))
    });
    let each: Vec<String> = each.collect();
    if each.is_empty() {
        return String::new();
    }
    format!(
        "Efficiency, 1/(MSE · seconds) with the squared bias as a part of the MSE, at the largest number of samples, relative to {}: {}. ",
        first.name,
        list(&each)
    )
}

/// Returns the sentence that compares the times in which the curves reach an equal error, relative
/// to the first curve.
fn times_to_equal_error(experiment: &Experiment) -> String {
    let [first, others @ ..] = experiment.curves.as_slice() else {
        return String::new();
    };
    let mut text = Vec::new();
    for curve in others {
        let to = to_equal_error(experiment, first, curve);
        if let Some(EqualError {
            error,
            speedup,
            ties,
        }) = to
        {
            text.push(if ties {
                format!(
                    "{} reaches an error of {} in the same time within the error bars",
                    curve.name,
                    percent(error)
                )
            } else if speedup > 1.0 {
                format!(
                    "{} reaches an error of {} {} times as fast",
                    curve.name,
                    percent(error),
                    figures(speedup)
                )
            } else {
                format!(
                    "{} takes {} times as long to reach an error of {}",
                    curve.name,
                    figures(1.0 / speedup),
                    percent(error)
                )
            });
        }
    }
    if text.is_empty() {
        return String::new();
    }
    format!("Compared with {}: {}. ", first.name, text.join("; "))
}

/// The times of two methods to an equal error.
struct EqualError {
    error: f64,
    /// The time of the first over that of the other.
    speedup: f64,
    /// Whether the times are equal within their errors.
    ties: bool,
}

/// Compares a curve with the first one at the last point of the first whose error the other also
/// reaches.
fn to_equal_error(experiment: &Experiment, first: &Curve, curve: &Curve) -> Option<EqualError> {
    let error = |p: &CurvePoint| error_of(p, experiment.is_relative);
    first.points.iter().rev().find_map(|p| {
        let at = |x: fn(&CurvePoint) -> f64| curve.at_error(error(p), error, x);
        let own = Quartiles {
            lower: at(|p| p.seconds.lower)?,
            median: at(|p| p.seconds.median)?,
            upper: at(|p| p.seconds.upper)?,
        };
        Some(EqualError {
            error: error(p),
            speedup: p.seconds.median / own.median,
            ties: own.lower <= p.seconds.upper && p.seconds.lower <= own.upper,
        })
    })
}

/// Returns the sentences about bias.
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
    let mut text = match centred.filter(|p| !p.is_random()).find_map(|p| p.bias) {
        Some(bias) => format!(
            "A single sample is taken at the centre of the pixel and is not random; its bias is {}. ",
            percent(bias)
        ),
        None => String::new(),
    };
    text += &if biased.is_empty() {
        "No curve has a significant bias at its largest number of samples.".to_string()
    } else {
        format!(
            "The bias is the part of the error that more samples do not reduce. At the largest number of samples of a curve it is {}. \
             The other curves have no significant bias.",
            list(&biased)
        )
    };
    text
}
