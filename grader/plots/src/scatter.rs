//! Points with names beside them, and the legend of their markers.

use crate::canvas::{Canvas, Label, Position};
use crate::labels::Labels;
use crate::plot::{Axis, Plot};
use crate::style::{self, SeriesStyle};

/// The least radius around a point in which its text is shown, in points.
const TIP: f64 = 7.0;

/// Distance of the lines of a legend.
const LINE: f64 = 16.0;

/// A point.
pub struct Point {
    /// Its marker.
    pub style: SeriesStyle,
    /// The area of the marker in square points.
    pub area: f64,
    /// Its values.
    pub at: (f64, f64),
    /// The ends of its error bar along the x axis.
    pub bar: Option<[f64; 2]>,
    /// Its name, which may have several lines.
    pub name: String,
    /// Size and colour of the name.
    pub label: Label,
    /// What it shows when the pointer is over it.
    pub tip: String,
}

/// A plot of points with the legend of their markers below it.
pub struct Scatter {
    /// The axes.
    pub axes: [Axis; 2],
    /// The points.
    pub points: Vec<Point>,
    /// The legend: markers with their areas and meanings.
    pub key: Vec<(SeriesStyle, f64, String)>,
}

/// Height of the legend below the plot, in points.
const KEY: f64 = 24.0;

impl Scatter {
    /// Draws it in the top left corner of a canvas, `width` by `height` points large.
    pub fn draw(&self, canvas: &Canvas, [width, height]: [f64; 2], title: &str) {
        let [x, y] = self.axes.clone();
        let size = [width, height - KEY];
        let plot = Plot::new(canvas, title, (0.0, 0.0), size, x, y);
        let mut labels = Labels::new(plot.inner());
        if let Some(y) = plot.separator() {
            let [left, _, right, _] = plot.inner();
            labels.keep_box_free([left, y - 1.0, right, y + 1.0]);
        }
        draw(canvas, &plot, labels, &self.points);
        let start = (48.0, height - 0.5 * KEY);
        key(canvas, start, width, self.key.iter().cloned())
    }
}

/// Draws points where `labels` are free. The names of the first ones are nearest to their points.
pub fn draw(canvas: &Canvas, plot: &Plot, mut labels: Labels, points: &[Point]) {
    for Point { style, at, bar, .. } in points {
        if let Some(ends) = *bar {
            plot.time_bar(*style, ends, at.1);
            let [from, to] = ends.map(|x| plot.at(x, at.1));
            labels.keep_box_free([from.0, from.1 - 2.0, to.0, to.1 + 2.0]);
        }
    }
    let place = |point: &Point| plot.at(point.at.0, point.at.1);
    let radius = |point: &Point| (point.area / std::f64::consts::PI).sqrt() + 1.0;
    // Large markers first, so that they do not hide small ones.
    let mut largest_first: Vec<&Point> = points.iter().collect();
    largest_first.sort_by(|a, b| b.area.total_cmp(&a.area));
    for point in largest_first {
        style::marker(canvas, point.style, place(point), point.area);
        labels.keep_free(place(point), radius(point));
    }
    for point in points {
        canvas.tip(place(point), radius(point).max(TIP), &point.tip);
        labels.place(canvas, &point.name, place(point), point.label);
    }
}

/// Draws a legend from `start` on, in as many lines as the `width` of the canvas needs: markers
/// with their areas and meanings.
pub fn key(
    canvas: &Canvas,
    start: Position,
    width: f64,
    entries: impl IntoIterator<Item = (SeriesStyle, f64, String)>,
) {
    let (mut x, mut y) = start;
    for (style, area, text) in entries {
        let label = Label::left(9.5);
        if x + 14.0 + label.width(&text) > width {
            (x, y) = (start.0, y + LINE);
        }
        style::marker(canvas, style, (x, y), area);
        canvas.text(&text, (x + 14.0, y), label);
        x += 36.0 + label.width(&text);
    }
}
