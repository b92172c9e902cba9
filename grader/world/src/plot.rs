//! The plot: what each library loses, against its speed.

use crate::columns::{COLUMNS, Measure};
use plots::canvas::{Canvas, Label, file, svg};
use plots::labels::Labels;
use plots::numbers::{figures, grouped};
use plots::plot::{Axis, Plot};
use plots::style::SeriesStyle;
use std::fs;
use std::path::Path;

/// The size in points: the large plot above, the small ones below.
const WIDTH: f64 = 860.0;
const LARGE: f64 = 420.0;
const SMALL: f64 = 190.0;

/// Font size of the names beside markers.
const NAME: f64 = 9.0;

/// The columns of the small plots.
const PANELS: [&str; 4] = ["round_edge", "needle_vertex", "grid_vertex", "small"];

/// A row of the table, as far as the plot shows it.
struct Point {
    name: String,
    is_single: bool,
    is_ours: bool,
    million_rays: f64,
    /// Wrong answers in a million, by column.
    wrong: Vec<(String, f64)>,
}

impl Point {
    /// The most wrong answers in a million of any hard case that every library can answer.
    fn worst(&self) -> f64 {
        self.wrong
            .iter()
            .map(|(_, wrong)| *wrong)
            .fold(0.0, f64::max)
    }

    fn of_column(&self, column: &str) -> Option<f64> {
        let own = self.wrong.iter().find(|(name, _)| name == column);
        own.map(|(_, wrong)| *wrong)
    }

    fn style(&self) -> SeriesStyle {
        SeriesStyle::of(match (self.is_ours, self.is_single) {
            (true, _) => 0,
            (false, true) => 1,
            (false, false) => 2,
        })
    }
}

/// Draws the rows of a table of results.
pub(crate) fn write(results: &Path, to: &Path) -> Result<(), String> {
    let text = fs::read_to_string(results).map_err(|e| format!("{}: {e}", results.display()))?;
    let mut lines = text
        .lines()
        .map(|line| line.split('\t').collect::<Vec<_>>());
    let head = lines.next().ok_or("the table is empty")?;
    let points: Vec<Point> = lines.filter_map(|line| point(&head, &line)).collect();
    let drawing = svg(
        WIDTH,
        LARGE + SMALL,
        "Lost hits against speed of ray casters",
        |canvas| {
            draw(canvas, &points);
        },
    );
    fs::write(to, file(&drawing)).map_err(|e| format!("{}: {e}", to.display()))
}

fn point(head: &[&str], line: &[&str]) -> Option<Point> {
    let value = |name: &str| {
        let at = head.iter().position(|column| *column == name)?;
        line.get(at).copied()
    };
    let wrong = COLUMNS
        .iter()
        .filter(|column| column.measure == Measure::Wrong);
    let wrong = wrong.filter_map(|column| {
        let wrong = value(&format!("{}_wrong_ppm", column.name))?.parse().ok()?;
        Some((column.name.to_string(), wrong))
    });
    let library = value("library")?;
    Some(Point {
        name: value("row")?.replace('_', " "),
        is_single: value("precision")? == "f32",
        is_ours: library == "First Light",
        million_rays: value("million_rays_per_second")?.parse().ok()?,
        wrong: wrong.collect(),
    })
}

fn draw(canvas: &Canvas, points: &[Point]) {
    let worst = |point: &Point| Some(point.worst());
    let title = "wrong answers in the worst hard case, against speed";
    panel(canvas, title, [0.0, 0.0, WIDTH, LARGE], points, worst, true);
    let width = WIDTH / PANELS.len() as f64;
    for (i, name) in PANELS.into_iter().enumerate() {
        let title = COLUMNS.iter().find(|column| column.name == name);
        let title = title.map_or(name, |column| column.title);
        let place = [i as f64 * width, LARGE, width, SMALL];
        panel(
            canvas,
            title,
            place,
            points,
            |point| point.of_column(name),
            false,
        );
    }
}

fn panel(
    canvas: &Canvas,
    title: &str,
    [x, y, width, height]: [f64; 4],
    points: &[Point],
    wrong: impl Fn(&Point) -> Option<f64>,
    has_names: bool,
) {
    let speeds = points.iter().map(|point| point.million_rays);
    let across = Axis::log("millions of rays per second", speeds, figures);
    let lost = points.iter().filter_map(&wrong);
    let up = Axis::log_and_zero("wrong in a million", lost, grouped);
    let plot = Plot::new(canvas, title, (x, y), [width, height], across, up);
    let mut labels = Labels::new(plot.inner());
    let area = if has_names { 60.0 } else { 24.0 };
    for point in points {
        let Some(wrong) = wrong(point) else { continue };
        plot.marker(point.style(), (point.million_rays, wrong), area);
        labels.keep_free(plot.at(point.million_rays, wrong), 6.0);
    }
    for point in points.iter().filter(|_| has_names) {
        let Some(wrong) = wrong(point) else { continue };
        let label = Label::left(NAME).in_color(point.style().color);
        labels.place(
            canvas,
            &point.name,
            plot.at(point.million_rays, wrong),
            label,
        );
    }
}
