//! The plot: what each library answers wrongly, against its speed.

use super::{COLUMNS, Row, WorldReport, table};
use crate::precision::Precision;
use plots::canvas::{Canvas, Label, file, for_both_widths, svg};
use plots::columns::Columns;
use plots::figure::Figure;
use plots::numbers::{figures, grouped};
use plots::plot::{Axis, Plot};
use plots::scatter::{Point, Scatter};
use plots::style::{Marker, SeriesStyle};

/// Sizes in points: of the large plot with its legend, and of a small one.
const WIDTH: f64 = 860.0;
const LARGE: f64 = 460.0;
const SMALL: f64 = 190.0;
const NARROW: f64 = 300.0;

/// Font size of the names beside markers.
const NAME: f64 = 9.0;

/// The axis of the heights.
const WRONG: &str = "wrong in a million";

/// The columns of the small plots.
const PANELS: [&str; 4] = ["round_edge", "needle_vertex", "grid_vertex", "small"];

/// The text of the plot for screen readers.
const LABEL: &str = "Wrong answers against speed of ray casters";

/// Draws the plot with its numbers; `None` if no library was timed.
pub(crate) fn figure(report: &WorldReport) -> Option<Figure> {
    let rows = timed(report);
    let finding = finding(&rows)?;
    let drawing = for_both_widths(
        [WIDTH, LARGE + SMALL],
        [NARROW, LARGE],
        LABEL,
        |canvas, [width, _], is_narrow| {
            large(canvas, width, "worst case against speed", &rows);
            if !is_narrow {
                small(canvas, &rows);
            }
        },
    );
    let all = report.yours.iter().chain(&report.libraries);
    let mut columns = Columns::new("row", |row: &Row| row.name.clone())
        .and("version", |row| row.version.clone())
        .and("precision", |row| row.precision.name().into())
        .and("Mrays/s", |row| {
            row.million_rays.map_or("-".into(), figures)
        });
    for (i, column) in COLUMNS.iter().enumerate() {
        columns = columns.and(column.title, move |row| row.cells[i].to_string());
    }
    let figure = Figure {
        finding: match &report.yours {
            Some(row) => table::verdict(row, &report.libraries).0,
            None => finding,
        },
        drawing,
        caption: "Each point is a library, or one of its interfaces. Further right traces more rays in a second of processor time, \
                  further down answers fewer rays wrongly, and none below the dashed line. Filled markers are f32."
            .into(),
        notes: "A row counts in its worst case of those in which every wrong answer is a fault. The cells are wrong answers in a \
                million; found hits in per cent where a range ends or a ray starts at the surface; wrong counts in per cent; and \
                the largest error of t in units in the last place."
            .into(),
        ..Figure::default()
    };
    Some(columns.table(all, figure))
}

/// The plot alone as an SVG file, with its finding as the title; `None` if no library was timed.
pub(crate) fn svg_file(report: &WorldReport) -> Option<String> {
    let rows = timed(report);
    let finding = finding(&rows)?;
    let drawing = svg(WIDTH, LARGE + SMALL, LABEL, |canvas| {
        large(canvas, WIDTH, &finding, &rows);
        small(canvas, &rows);
    });
    Some(file(&drawing))
}

/// The rows with a speed and an answer.
fn timed(report: &WorldReport) -> Vec<&Row> {
    let rows = report.libraries.iter();
    rows.filter(|row| row.million_rays.is_some() && row.worst().is_some())
        .collect()
}

/// What the plot shows: how many libraries have no fault, and how the fastest of them compares.
fn finding(rows: &[&Row]) -> Option<String> {
    let others = || rows.iter().filter(|row| row.is_of_a_library());
    let right = others().filter(|row| row.is_right()).count();
    let most = others().filter_map(|row| row.worst()).reduce(f64::max)?;
    Some(format!(
        "Of {} interfaces of ray casters, {right} are right in every hard case; the worst is wrong for {} of a million rays in one",
        others().count(),
        grouped(most)
    ))
}

fn style_of(row: &Row) -> SeriesStyle {
    let is_single = row.precision != Precision::F64;
    let is_ours = !row.is_of_a_library();
    let (color, marker) = match (is_ours, is_single) {
        (true, _) => (2, Marker::Star),
        (false, false) => (0, Marker::Disc),
        (false, true) => (1, Marker::Square),
    };
    SeriesStyle::of(color).marked(marker, !is_single && !is_ours)
}

/// A plot; `wrong` returns the height of a row, whose axis is `name_of_y`.
fn panel(rows: &[&Row], name_of_y: &str, wrong: impl Fn(&Row) -> Option<f64>) -> Scatter {
    let points = rows.iter().filter_map(|row| {
        let (style, name) = (style_of(row), row.name.replace('_', " "));
        let at = (row.million_rays?, wrong(row)?);
        Some(Point {
            style,
            area: 60.0,
            at,
            bar: None,
            tip: format!("{name}: {} of a million wrong", grouped(at.1)),
            name,
            label: Label::left(NAME).in_color(style.color),
        })
    });
    let points: Vec<Point> = points.collect();
    let speeds = points.iter().map(|point| point.at.0);
    // The same heights in all plots.
    let heights = points.iter().map(|point| point.at.1).chain([10.0, 1e6]);
    let first = |is: &dyn Fn(&Row) -> bool| rows.iter().find(|row| is(row));
    let is_single = |row: &Row| row.precision != Precision::F64;
    let entries = [
        ("f32", first(&|row| row.is_of_a_library() && is_single(row))),
        (
            "f64",
            first(&|row| row.is_of_a_library() && !is_single(row)),
        ),
        ("First Light's tree", first(&|row| !row.is_of_a_library())),
    ];
    let key = entries.into_iter();
    Scatter {
        axes: [
            // All ticks are powers of ten.
            Axis::log("millions of rays per second", speeds, |x| x.to_string()),
            Axis::log_and_zero(name_of_y, heights, grouped),
        ],
        key: key
            .filter_map(|(text, row)| Some((style_of(row?), 60.0, text.into())))
            .collect(),
        points,
    }
}

fn large(canvas: &Canvas, width: f64, title: &str, rows: &[&Row]) {
    panel(rows, WRONG, Row::worst).draw(canvas, [width, LARGE], title)
}

fn small(canvas: &Canvas, rows: &[&Row]) {
    let width = WIDTH / PANELS.len() as f64;
    for (i, name) in PANELS.into_iter().enumerate() {
        let column = COLUMNS.iter().find(|column| column.name == name);
        let title = column.map_or(name, |column| column.title);
        let (corner, size) = ((i as f64 * width, LARGE), [width, SMALL]);
        // The ticks are close together here, and the large plot names the axis.
        let Scatter { axes, points, .. } = panel(rows, "", |row| row.value(name));
        let [x, y] = axes;
        let plot = Plot::new(canvas, title, corner, size, x, y);
        for point in points {
            plot.marker(point.style, point.at, 24.0);
        }
    }
}
