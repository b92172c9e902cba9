//! What exactness costs a tree: speed against lost hits.

use crate::quartiles::Quartiles;
use crate::report::Precision;
use crate::table::plus_minus;
use crate::trees::{ExactnessRow, TreeReport, in_a_million};
use plots::canvas::{Canvas, Label, Position, file, for_both_widths, svg};
use plots::figure::{Figure, heads};
use plots::labels::Labels;
use plots::numbers::{figures, grouped};
use plots::plot::{Axis, Plot};
use plots::style::{self, Marker, SeriesStyle};

/// Sizes in points: the plot, and the plot on a telephone.
const BROAD: [f64; 2] = [860.0, 400.0 + KEY];
const NARROW: [f64; 2] = [300.0, 400.0 + KEY];

/// Height of the legend below the plot, in points.
const KEY: f64 = 24.0;

/// Area of the markers in square points.
const AREA: f64 = 60.0;

/// The text of the plot for screen readers.
const LABEL: &str = "Lost hits against speed of trees with different tests and precisions";

/// Font size of the names beside markers.
const NAME: f64 = 9.5;

/// Draws the plot; `None` if nothing was measured.
pub(crate) fn figure(trees: &TreeReport) -> Option<Figure> {
    let finding = finding(&trees.by_precision)?;
    let drawing = for_both_widths(BROAD, NARROW, LABEL, |canvas, size, _| {
        draw(canvas, size, "lost hits against speed", &trees.by_precision)
    });
    let rays = trees.by_precision.first().map_or(0, |row| row.rays);
    Some(Figure {
        finding,
        drawing,
        caption: "One tree, with other tests in another precision at each point; triangles are other trees with the exact tests. Further right \
                  traces more rays, further down loses fewer hits, and none below the dashed line. Filled markers are f32. Bars reach \
                  from quartile to quartile."
            .into(),
        notes: format!(
            "The trees are over the {} mesh of {} triangles. Speed is that of camera rays on one thread. Hits are lost \
             of {} rays that are aimed at random triangles from all directions, every other one at an edge. A hit is missed if the ray \
             passes through the surface, and wrong if there is none, or if it is too near. The first tree is exact: it finds the hits of \
             brute force. In f32, pbrt uses a pair like Ize's and Woop's tests, Embree's robust mode one like Ize's and Plücker \
             coordinates, and most others slabs with Möller and Trumbore's test; these are the tests alone, in the same traversal.",
            trees.mesh,
            grouped(trees.triangles as f64),
            grouped(rays as f64)
        ),
        head: heads(&[
            "split",
            "test of triangles",
            "of boxes",
            "slack, ulp",
            "Mrays/s",
            "time / exact",
            "missed in a million",
            "wrong in a million",
        ]),
        rows: trees
            .by_precision
            .iter()
            .map(|row| {
                vec![
                    row.split.clone(),
                    format!("{} {}", row.triangle_test, row.precision.name()),
                    row.box_test.clone(),
                    row.slack_ulp.to_string(),
                    plus_minus(&rate(row), 2),
                    plus_minus(&row.time.ratio, 2),
                    grouped(in_a_million(row.missed, row.rays)),
                    grouped(in_a_million(row.wrong, row.rays)),
                ]
            })
            .collect(),
    })
}

/// Returns the plot alone, with the finding as its title, as an SVG file; `None` if nothing was
/// measured.
pub(crate) fn svg_file(trees: &TreeReport) -> Option<String> {
    let finding = finding(&trees.by_precision)?;
    let [w, h] = BROAD;
    let drawing = svg(w, h, LABEL, |canvas| {
        draw(canvas, BROAD, &finding, &trees.by_precision)
    });
    Some(file(&drawing))
}

/// Millions of rays per second.
fn rate(row: &ExactnessRow) -> Quartiles {
    let Quartiles {
        lower,
        median,
        upper,
    } = row.time.ns;
    Quartiles {
        lower: 1e3 / upper,
        median: 1e3 / median,
        upper: 1e3 / lower,
    }
}

/// What the plot shows: what the exact tests give up in speed, in the first tree. `None` without
/// rows.
fn finding(rows: &[ExactnessRow]) -> Option<String> {
    let first = rows.first()?;
    let fastest = |loses: bool| {
        let rows = rows
            .iter()
            .filter(|row| row.split == first.split)
            .filter(|row| (row.lost_per_million() > 0.0) == loses);
        rows.min_by(|a, b| a.time.ratio.median.total_cmp(&b.time.ratio.median))
    };
    let (exact, lossy) = (fastest(false), fastest(true));
    let Some(lossy) = lossy else {
        return exact.map(|_| "No tree loses a hit".into());
    };
    let lost = grouped(lossy.lost_per_million());
    let name = format!("{} in {}", lossy.triangle_test, lossy.precision.name());
    let Some(exact) = exact else {
        return Some(format!(
            "Every tree loses hits; the fastest, with {name}, {lost} in a million"
        ));
    };
    let times = exact.time.ratio.median / lossy.time.ratio.median;
    Some(if exact.time.ties_with(&lossy.time) {
        format!(
            "Exact hits cost no time: the fastest tree that loses hits, {lost} in a million, is not faster"
        )
    } else if times < 1.0 {
        format!(
            "The exact tree is the fastest; the next, with {name}, loses {lost} hits in a million"
        )
    } else {
        format!(
            "In the same tree, exact hits cost {} % more time than {name}, which loses {lost} in a million",
            figures(100.0 * (times - 1.0))
        )
    })
}

fn draw(canvas: &Canvas, size: [f64; 2], title: &str, rows: &[ExactnessRow]) {
    let rates = rows.iter().map(rate).flat_map(|r| [r.lower, r.upper]);
    let x = Axis::around("millions of rays per second", rates, figures);
    let lost = rows.iter().map(ExactnessRow::lost_per_million);
    let y = Axis::log_and_zero("lost hits in a million rays", lost, grouped);
    let plot = Plot::new(canvas, title, (0.0, 0.0), [size[0], size[1] - KEY], x, y);
    let is_first = |row: &ExactnessRow| rows.first().is_some_and(|first| row.split == first.split);
    let mut labels = Labels::new(plot.inner());
    if let Some(y) = plot.separator() {
        let [left, _, right, _] = plot.inner();
        labels.keep_box_free([left, y - 1.0, right, y + 1.0]);
    }
    let place =
        |row: &ExactnessRow| -> Position { plot.at(rate(row).median, row.lost_per_million()) };
    for row in rows {
        let Quartiles { lower, upper, .. } = rate(row);
        plot.time_bar(
            style_of(row, is_first(row)),
            [lower, upper],
            row.lost_per_million(),
        );
        let y = place(row).1;
        let [from, to] = [lower, upper].map(|x| plot.at(x, row.lost_per_million()).0);
        labels.keep_box_free([from, y - 2.0, to, y + 2.0]);
        labels.keep_free(place(row), 6.0);
    }
    for row in rows {
        let at = (rate(row).median, row.lost_per_million());
        plot.marker(style_of(row, is_first(row)), at, AREA);
        canvas.tip(place(row), 9.0, &tip(row));
    }
    for row in rows {
        let label = Label::left(NAME).in_color(style_of(row, is_first(row)).color);
        let test = format!("{} {}", row.triangle_test, row.precision.name());
        let text = match is_first(row) {
            true => format!("{test}\nboxes: {}", row.box_test),
            false => format!("{test}\n{}", row.split),
        };
        labels.place(canvas, &text, place(row), label.bold());
    }
    key(canvas, size, rows, is_first)
}

/// Draws the legend of the markers below the plot: of those that it has.
fn key(
    canvas: &Canvas,
    size: [f64; 2],
    rows: &[ExactnessRow],
    is_first: impl Fn(&ExactnessRow) -> bool,
) {
    let single = |row: &&ExactnessRow| row.precision != Precision::F64;
    let entries = [
        (rows.iter().find(|row| is_first(row) && !single(row)), "f64"),
        (rows.iter().find(|row| is_first(row) && single(row)), "f32"),
        (rows.iter().find(|row| !is_first(row)), "another tree"),
    ];
    let (mut x, y) = (48.0, size[1] - 0.5 * KEY);
    for (row, text) in entries {
        let Some(row) = row else { continue };
        style::marker(canvas, style_of(row, is_first(row)), (x, y), AREA);
        let label = Label::left(NAME);
        canvas.text(text, (x + 14.0, y), label);
        x += 36.0 + label.width(text);
    }
}

fn tip(row: &ExactnessRow) -> String {
    format!(
        "{}: {} {}, boxes: {}, slack of {} ulp: {} million rays per second, {} of a million missed and {} wrong",
        row.split,
        row.triangle_test,
        row.precision.name(),
        row.box_test,
        row.slack_ulp,
        plus_minus(&rate(row), 2),
        grouped(in_a_million(row.missed, row.rays)),
        grouped(in_a_million(row.wrong, row.rays))
    )
}

/// Colour and shape show the precision, as in the plot of triangle tests; trees other than the
/// first have a shape of their own.
fn style_of(row: &ExactnessRow, is_first: bool) -> SeriesStyle {
    let is_single = row.precision != Precision::F64;
    SeriesStyle {
        marker: match (is_first, is_single) {
            (false, _) => Marker::Triangle,
            (true, false) => Marker::Disc,
            (true, true) => Marker::Square,
        },
        hollow: !is_single,
        dashes: None,
        ..SeriesStyle::of(usize::from(is_single))
    }
}
