//! A plot: two axes and the lines and markers between them.

use crate::canvas::{Canvas, Label, Position};
use crate::style::{self, GRID, INK, SeriesStyle};

/// Font size at the axes, in points.
const SMALL: f64 = 9.0;

/// Margins for the tick labels and the names of the axes.
const LEFT: f64 = 52.0;
const BELOW: f64 = 38.0;
const ABOVE: f64 = 20.0;
const RIGHT: f64 = 8.0;

/// Half the length of the strokes at the ends of an error bar, in points.
const CAP: f64 = 2.5;

/// How values become positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Linear,
    Log,
    /// Logarithmic, with 0 apart at the start.
    LogAndZero,
}

/// Where 0 is on a logarithmic axis, and where that axis begins: shares of its length.
const ZERO: f64 = 0.14;
const BEYOND_ZERO: f64 = 0.34;

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What is on the axis, with its unit.
    pub name: String,
    from: f64,
    to: f64,
    scale: Scale,
    /// The ticks: values and their labels.
    ticks: Vec<(f64, String)>,
}

impl Axis {
    /// Creates a linear axis with these ticks.
    pub fn linear(
        name: &str,
        [from, to]: [f64; 2],
        ticks: impl IntoIterator<Item = f64>,
        number: impl Fn(f64) -> String,
    ) -> Axis {
        let ticks = ticks.into_iter().map(|value| (value, number(value)));
        Axis {
            name: name.into(),
            from,
            to,
            scale: Scale::Linear,
            ticks: ticks.collect(),
        }
    }

    /// Creates a logarithmic axis that contains all positive `values`. Its ticks are powers of ten,
    /// with steps of 1, 2, 5 or smaller between them if there are only a few.
    pub fn log(
        name: &str,
        values: impl IntoIterator<Item = f64>,
        number: impl Fn(f64) -> String,
    ) -> Axis {
        let positive = values.into_iter().filter(|v| *v > 0.0 && v.is_finite());
        let (least, most) =
            positive.fold((f64::INFINITY, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
        let (least, most) = if least <= most {
            (least, most)
        } else {
            (0.1, 1.0)
        };
        // A margin, so that no marker is on the frame.
        let air = (most / least).powf(0.04).max(1.12);
        let (from, to) = (least / air, most * air);
        let decades = (to / from).log10();
        let steps: &[f64] = match decades {
            ..0.7 => &[1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0],
            ..2.2 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let every = (decades / 6.0).ceil().max(1.0) as i32;
        let powers = (from.log10().floor() as i32)..=(to.log10().ceil() as i32);
        let ticks = powers
            .filter(|power| power.rem_euclid(every) == 0)
            .flat_map(|power| steps.iter().map(move |step| step * 10.0_f64.powi(power)))
            .filter(|value| (from..=to).contains(value))
            .map(|value| (value, number(value)))
            .collect();
        Axis {
            name: name.into(),
            from,
            to,
            scale: Scale::Log,
            ticks,
        }
    }

    /// Creates a logarithmic axis that contains all positive `values`, and 0 apart from them at its
    /// start.
    pub fn log_and_zero(
        name: &str,
        values: impl IntoIterator<Item = f64>,
        number: impl Fn(f64) -> String,
    ) -> Axis {
        let mut axis = Axis::log(name, values, &number);
        axis.ticks.insert(0, (0.0, number(0.0)));
        axis.scale = Scale::LogAndZero;
        axis
    }

    /// Creates a linear axis that contains all finite `values`, with about five round ticks.
    pub fn around(
        name: &str,
        values: impl IntoIterator<Item = f64>,
        number: impl Fn(f64) -> String,
    ) -> Axis {
        let finite = values.into_iter().filter(|v| v.is_finite());
        let (least, most) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(v), b.max(v))
        });
        let (least, most) = if least < most {
            (least, most)
        } else if least == most {
            (least - 0.5, most + 0.5)
        } else {
            (0.0, 1.0)
        };
        // A margin, so that no marker is on the frame.
        let air = 0.08 * (most - least);
        let (from, to) = (least - air, most + air);
        let power = 10.0_f64.powf(((to - from) / 5.0).log10().floor());
        let fits = |step: &f64| (to - from) / (step * power) <= 6.0;
        let step = power * [1.0, 2.0, 5.0].into_iter().find(fits).unwrap_or(10.0);
        let ticks = (from / step).ceil() as i64..=(to / step).floor() as i64;
        Axis::linear(name, [from, to], ticks.map(|i| i as f64 * step), number)
    }

    /// Returns the position of `value` on the axis, from 0 at the start to 1 at the end.
    fn share(&self, value: f64) -> f64 {
        let log = || (value / self.from).ln() / (self.to / self.from).ln();
        match self.scale {
            Scale::Linear => (value - self.from) / (self.to - self.from),
            Scale::Log => log(),
            Scale::LogAndZero if value <= 0.0 => ZERO,
            Scale::LogAndZero => BEYOND_ZERO + (1.0 - BEYOND_ZERO) * log(),
        }
    }

    /// Returns both ends.
    pub fn ends(&self) -> (f64, f64) {
        (self.from, self.to)
    }
}

/// A plot on a canvas.
pub struct Plot<'a> {
    canvas: &'a Canvas,
    x: Axis,
    y: Axis,
    /// The inner part: left, top, right, bottom.
    inner: [f64; 4],
}

impl<'a> Plot<'a> {
    /// Draws the axes of a plot. `corner` is its top left corner.
    pub fn new(
        canvas: &'a Canvas,
        title: &str,
        corner: Position,
        [w, h]: [f64; 2],
        x: Axis,
        y: Axis,
    ) -> Plot<'a> {
        let inner = [
            corner.0 + LEFT,
            corner.1 + ABOVE,
            corner.0 + w - RIGHT,
            corner.1 + h - BELOW,
        ];
        let plot = Plot {
            canvas,
            x,
            y,
            inner,
        };
        plot.draw_axes(title);
        plot
    }

    fn draw_axes(&self, title: &str) {
        let [left, top, right, bottom] = self.inner;
        let canvas = self.canvas;
        if let Some(y) = self.separator() {
            canvas.dashes(&[(left, y), (right, y)], INK, 0.6, [2.0, 3.0]);
        }
        for (value, _) in &self.x.ticks {
            let (x, _) = self.at(*value, self.y.from);
            canvas.line(&[(x, top), (x, bottom)], GRID, 0.6);
        }
        let label = Label::centered(SMALL).in_color(INK);
        for (x, number) in self.x_numbers(label) {
            canvas.text(number, (x, bottom + 9.0), label);
        }
        for (value, number) in &self.y.ticks {
            let (_, y) = self.at(self.x.from, *value);
            canvas.line(&[(left, y), (right, y)], GRID, 0.6);
            canvas.text(number, (left - 4.0, y), Label::right(SMALL).in_color(INK));
        }
        let frame = [(left, top), (left, bottom), (right, bottom)];
        canvas.line(&frame, INK, 1.0);
        let middle = (0.5 * (left + right), 0.5 * (top + bottom));
        canvas.text(title, (left, top - 10.0), Label::left(SMALL + 1.0).bold());
        canvas.text(
            &self.x.name,
            (middle.0, bottom + 25.0),
            Label::centered(SMALL + 0.5),
        );
        let upright = Label {
            upright: true,
            ..Label::centered(SMALL + 0.5)
        };
        canvas.text(&self.y.name, (left - 43.0, middle.1), upright)
    }

    /// The numbers below the x axis and their places, without those that would touch another one:
    /// powers of ten go first.
    fn x_numbers(&self, label: Label) -> Vec<(f64, &str)> {
        let is_power =
            |value: f64| value > 0.0 && (value.log10() - value.log10().round()).abs() < 1e-9;
        let (powers, others): (Vec<_>, Vec<_>) =
            self.x.ticks.iter().partition(|(value, _)| is_power(*value));
        let mut numbers: Vec<(f64, &str)> = Vec::new();
        for (value, number) in powers.into_iter().chain(others) {
            let (x, _) = self.at(*value, self.y.from);
            let room = |other: &str| 0.5 * (label.width(number) + label.width(other)) + 4.0;
            if numbers
                .iter()
                .all(|(at, other)| (at - x).abs() >= room(other))
            {
                numbers.push((x, number));
            }
        }
        numbers
    }

    /// Returns the position of a value on the canvas.
    pub fn at(&self, x: f64, y: f64) -> Position {
        let [left, top, right, bottom] = self.inner;
        (
            left + self.x.share(x) * (right - left),
            bottom - self.y.share(y) * (bottom - top),
        )
    }

    /// Returns the height of the dashed line between 0 and the positive values of the y axis, if it
    /// is drawn.
    pub fn separator(&self) -> Option<f64> {
        let [_, top, _, bottom] = self.inner;
        let y = bottom - 0.5 * (ZERO + BEYOND_ZERO) * (bottom - top);
        (self.y.scale == Scale::LogAndZero).then_some(y)
    }

    /// Returns the inner part: left, top, right, bottom.
    pub fn inner(&self) -> [f64; 4] {
        self.inner
    }

    /// Returns the ends of the x axis.
    pub fn x_ends(&self) -> (f64, f64) {
        self.x.ends()
    }

    /// Returns the ends of the y axis.
    pub fn y_ends(&self) -> (f64, f64) {
        self.y.ends()
    }

    /// Draws a marker; `area` is in square points.
    pub fn marker(&self, style: SeriesStyle, (x, y): (f64, f64), area: f64) {
        style::marker(self.canvas, style, self.at(x, y), area)
    }

    /// Draws a line through values, clamped to the range of the y axis.
    pub fn line(&self, style: SeriesStyle, values: &[(f64, f64)], width: f64) {
        let (from, to) = self.y.ends();
        let positions: Vec<Position> = values
            .iter()
            .map(|(x, y)| self.at(*x, y.clamp(from, to)))
            .collect();
        style::line(self.canvas, style, &positions, width)
    }

    /// Draws an error bar from `low` to `high` at `x`, clamped to the range of the y axis.
    pub fn error_bar(&self, style: SeriesStyle, x: f64, low: f64, high: f64) {
        let (from, to) = self.y.ends();
        let ends = [low, high].map(|y| self.at(x, y.clamp(from, to)));
        self.canvas.line(&ends, style.color, 1.0)
    }

    /// Draws an error bar from `low` to `high` at `y`, with short strokes at its ends. Clamped to
    /// the range of the x axis.
    pub fn time_bar(&self, style: SeriesStyle, [low, high]: [f64; 2], y: f64) {
        let (from, to) = self.x.ends();
        let ends = [low, high].map(|x| self.at(x.clamp(from, to), y));
        self.canvas.line(&ends, style.color, 1.0);
        for (x, y) in ends {
            let stroke = [(x, y - CAP), (x, y + CAP)];
            self.canvas.line(&stroke, style.color, 1.0);
        }
    }
}

/// Draws a legend from `corner` down: the style of each entry, if it has one, and its text.
pub fn legend(canvas: &Canvas, corner: Position, entries: &[(Option<SeriesStyle>, String)]) {
    let (x, mut y) = corner;
    for (style, text) in entries {
        if let Some(style) = style {
            style::line(canvas, *style, &[(x, y), (x + 26.0, y)], 1.5);
            style::marker(canvas, *style, (x + 13.0, y), 28.0);
        }
        canvas.text(text, (x + 32.0, y), Label::left(SMALL + 0.5));
        y += 15.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_with_few_decades_have_more_ticks() {
        let numbers = |values: &[f64]| -> Vec<f64> {
            let axis = Axis::log("", values.iter().copied(), |v| v.to_string());
            axis.ticks.iter().map(|(value, _)| *value).collect()
        };
        assert_eq!(numbers(&[3.0, 40.0]), [5.0, 10.0, 20.0]);
        assert_eq!(numbers(&[0.01, 0.0, 90.0]), [0.01, 0.1, 1.0, 10.0, 100.0]);
        assert!(numbers(&[1e-17, 1.0]).len() <= 7);
    }

    #[test]
    fn equal_factors_are_equal_distances() {
        let axis = Axis::log("", [1.0, 100.0], |v| v.to_string());
        let [a, b, c] = [1.0, 10.0, 100.0].map(|v| axis.share(v));
        assert!(0.0 < a && c < 1.0 && ((b - a) - (c - b)).abs() < 1e-12);
    }

    #[test]
    fn zero_is_apart_from_the_least_positive_value() {
        let axis = Axis::log_and_zero("", [0.0, 1.0, 1000.0], |v| v.to_string());
        let [zero, least, most] = [0.0, 1.0, 1000.0].map(|v| axis.share(v));
        assert!(0.0 < zero && zero + 0.1 < least && least < most && most < 1.0);
        assert_eq!(axis.ticks[0], (0.0, "0".into()));
    }

    #[test]
    fn linear_axes_have_round_ticks() {
        let ticks = |values: &[f64]| -> Vec<String> {
            let axis = Axis::around("", values.iter().copied(), |v| format!("{v:.1}"));
            axis.ticks.into_iter().map(|(_, text)| text).collect()
        };
        assert_eq!(
            ticks(&[0.0, 10.0]),
            ["0.0", "2.0", "4.0", "6.0", "8.0", "10.0"]
        );
        assert_eq!(
            ticks(&[2.23, 2.71]),
            ["2.2", "2.3", "2.4", "2.5", "2.6", "2.7"]
        );
        assert_eq!(ticks(&[3.0]), ["2.6", "2.8", "3.0", "3.2", "3.4"]);
    }
}
