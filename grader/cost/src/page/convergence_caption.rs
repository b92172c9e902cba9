//! The heading and the notes of the plots of the error of pictures.

use super::convergence::error_of;
use crate::picture::{Curve, CurvePoint, Experiment};
use crate::quartiles::Quartiles;
use plots::numbers::{figures, percent};

/// What the plot shows: the method that reaches an equal error in the least time.
pub(super) fn finding(experiment: &Experiment) -> String {
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

/// Returns the notes, computed from the numbers.
pub(super) fn caption(experiment: &Experiment) -> String {
    let Experiment { seeds, .. } = experiment;
    let mut text = format!(
        "Each point is the mean over {seeds} pictures of {} with independent random numbers; error bars are 95 % confidence \
         intervals of the mean error, and quartiles of the times. The reference picture has a remaining error of {}. ",
        experiment.scene,
        percent(experiment.converged_rmse),
    );
    text += "Slope: of log(error) against log(samples). Bias: the part of the error that more samples do not reduce, if it is \
             significant. Efficiency: 1/(MSE · seconds), with the squared bias as a part of the MSE. ";
    text += &times_to_equal_error(experiment);
    text
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
