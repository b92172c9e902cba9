//! The error of pictures against samples and against time.

use super::convergence_caption::{caption, finding};
use crate::cells::factor;
use crate::picture::{Curve, CurvePoint, Experiment, Thumbnail};
use pages::html::png_data_uri;
use pictures::Image;
use plots::canvas::{Label, for_both_widths};
use plots::columns::Columns;
use plots::figure::{Figure, prose};
use plots::numbers::{figures, percent, tick};
use plots::plot::{Axis, Plot, legend};
use plots::style::{self, INK, Marker, SeriesStyle};

const WIDTH: f64 = 860.0;
/// Size of each of the two plots, with the legend beside them.
const PLOT: [f64; 2] = [345.0, 300.0];
/// Size of each of the two plots on a telephone, one below the other, with the legend below them.
const NARROW_PLOT: [f64; 2] = [300.0, 270.0];

/// Distance of the lines of the legend.
const LINE: f64 = 15.0;

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
pub(crate) fn figure(experiment: &Experiment) -> Figure {
    let label = format!("Error of pictures: {}", experiment.title);
    let entries = experiment.curves.len() + 1;
    let narrow_height = 2.0 * NARROW_PLOT[1] + LINE * (entries as f64 + 1.0);
    let sizes = [[WIDTH, PLOT[1]], [NARROW_PLOT[0], narrow_height]];
    let columns = columns(experiment);
    let drawing = for_both_widths(sizes[0], sizes[1], &label, |canvas, _, is_narrow| {
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
            let (corner, size) = match is_narrow {
                false => ((i as f64 * PLOT[0], 0.0), PLOT),
                true => ((0.0, i as f64 * NARROW_PLOT[1]), NARROW_PLOT),
            };
            let plot = Plot::new(canvas, title, corner, size, x, y);
            half_slope_line(&plot, experiment, of);
            for (k, curve) in experiment.curves.iter().enumerate() {
                let style = SeriesStyle::of(k);
                let mut values: Vec<(f64, f64)> = curve
                    .points
                    .iter()
                    .map(|p| (of(p), error(p).value))
                    .collect();
                values.sort_by(|a, b| a.0.total_cmp(&b.0));
                plot.line(style, &values, 1.4);
                for point in &curve.points {
                    plot.error_bar(style, of(point), error(point).low, error(point).high);
                    if i == TIME {
                        let ends = [point.seconds.lower, point.seconds.upper];
                        plot.time_bar(style, ends, error(point).value);
                    }
                    plot.marker(style, (of(point), error(point).value), 30.0);
                    let at = plot.at(of(point), error(point).value);
                    canvas.tip(at, 6.0, &columns.tip(&(curve, point)));
                }
            }
        }
        let of_curve = |(k, curve): (usize, &Curve)| (Some(SeriesStyle::of(k)), curve.name.clone());
        let entries: Vec<_> = experiment.curves.iter().enumerate().map(of_curve).collect();
        let corner = match is_narrow {
            false => (2.0 * PLOT[0] + 8.0, 34.0),
            true => (12.0, 2.0 * NARROW_PLOT[1] + LINE),
        };
        legend(canvas, corner, &entries);
        let below = corner.1 + LINE * entries.len() as f64;
        style::line(
            canvas,
            HALF_SLOPE,
            &[(corner.0, below), (corner.0 + 26.0, below)],
            1.0,
        );
        canvas.text("slope −1/2", (corner.0 + 32.0, below), Label::left(9.5))
    });
    let figure = Figure {
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
        ..Figure::default()
    };
    let curves = experiment.curves.iter();
    let last: Vec<Row> = curves
        .filter_map(|curve| Some((curve, curve.points.last()?)))
        .collect();
    columns.table(&last, figure)
}

/// A point of a curve.
type Row<'a> = (&'a Curve, &'a CurvePoint);

/// The numbers of a point.
fn columns(experiment: &Experiment) -> Columns<'_, Row<'_>> {
    let is_relative = experiment.is_relative;
    let or_none = |number: Option<String>| number.unwrap_or("–".into());
    Columns::new("method", |(curve, point): &Row<'_>| {
        format!("{}, {}", curve.name, point.flags)
    })
    .and(&experiment.samples_are, |(_, point)| figures(point.samples))
    .and("error", move |(_, point)| {
        percent(error_of(point, is_relative))
    })
    .and("seconds", |(_, point)| figures(point.seconds.median))
    .and("slope", move |(curve, _)| {
        or_none(curve.slope.map(|slope| format!("{slope:.2}")))
    })
    .and("bias", move |(_, point)| or_none(point.bias.map(percent)))
    .and("of the first method's efficiency", move |(_, point)| {
        or_none(point.relative_efficiency.as_ref().map(factor))
    })
}

pub(super) fn error_of(point: &CurvePoint, is_relative: bool) -> f64 {
    point.error(is_relative).value
}

/// The converged picture, and one of each method: those whose times are most alike.
fn thumbnails(experiment: &Experiment) -> String {
    let Some(reference) = &experiment.reference else {
        return String::new();
    };
    let figure = |picture: &Thumbnail, text: &str| {
        let [w, h] = picture.size;
        let mut pixels = picture.pixels.iter();
        let image = Image::from_fn([w, h], |_, _| pixels.next().copied().unwrap_or_default());
        let text = prose(text);
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
fn half_slope_line(plot: &Plot, experiment: &Experiment, of: fn(&CurvePoint) -> f64) {
    let deviation = |curve: &Curve| {
        curve
            .slope
            .map_or(f64::INFINITY, |slope| (slope + 0.5).abs())
    };
    let curves = experiment.curves.iter();
    let nearest = curves.min_by(|a, b| deviation(a).total_cmp(&deviation(b)));
    let Some(last) = nearest.and_then(|curve| curve.points.iter().rfind(|p| p.is_random())) else {
        return;
    };
    let error = last.error(experiment.is_relative).value;
    // The line is clipped to the plot.
    let x_at = |y: f64| of(last) * (error / y).powi(2);
    let ((from, to), (low, high)) = (plot.x_ends(), plot.y_ends());
    let ends = [from.max(x_at(high)), to.min(x_at(low))];
    let line = ends.map(|x| (x, error * (of(last) / x).sqrt()));
    plot.line(HALF_SLOPE, &line, 1.0)
}
