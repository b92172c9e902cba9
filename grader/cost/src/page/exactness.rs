//! What exactness costs a tree: speed against lost hits.

use crate::quartiles::Quartiles;
use crate::report::Precision;
use crate::trees::table::by_precision;
use crate::trees::{ExactnessRow, TreeReport};
use plots::canvas::{Label, file, for_both_widths, svg};
use plots::figure::Figure;
use plots::numbers::{figures, grouped};
use plots::plot::Axis;
use plots::scatter::{Point, Scatter};
use plots::style::{Marker, SeriesStyle};

/// Sizes in points: the plot, and the plot on a telephone.
const BROAD: [f64; 2] = [860.0, 424.0];
const NARROW: [f64; 2] = [300.0, 424.0];

/// Area of the markers in square points.
const AREA: f64 = 60.0;

/// The text of the plot for screen readers.
const LABEL: &str = "Lost hits against speed of trees with different tests and precisions";

/// Font size of the names beside markers.
const NAME: f64 = 9.5;

/// Draws the plot; `None` if nothing was measured.
pub(crate) fn figure(trees: &TreeReport) -> Option<Figure> {
    let finding = finding(&trees.by_precision)?;
    let scatter = scatter(&trees.by_precision);
    let drawing = for_both_widths(BROAD, NARROW, LABEL, |canvas, size, _| {
        scatter.draw(canvas, size, "lost hits against speed")
    });
    let first = trees.by_precision.first();
    let (rays, grid_rays) = first.map_or((0, 0), |row| (row.rays, row.grid_rays));
    let figure = Figure {
        finding,
        drawing,
        caption: "One tree, with other tests in another precision at each point; triangles are other trees with the exact tests. Further right \
                  traces more rays, further down loses fewer hits, and none below the dashed line. Filled markers are f32. Bars reach \
                  from quartile to quartile."
            .into(),
        notes: format!(
            "The trees are over the {} mesh of {} triangles. Speed is that of camera rays on one thread. Hits are lost \
             of {} rays that are aimed at random triangles from all directions, every other one at an edge, or of {} rays \
             exactly at vertices, edges and diagonals of an integer terrain; the plot shows the worse of both. A hit is missed if the ray \
             passes through the surface, and wrong if there is none, or if it is too near. The first tree is exact: it finds the hits of \
             brute force. In f32, pbrt uses a pair like Ize's and Woop's tests, Embree's robust mode one like Ize's and Plücker \
             coordinates, and most others slabs with Möller and Trumbore's test; these are the tests alone, in the same traversal. \
             ~ marks a tie with the first tree.",
            trees.mesh,
            grouped(trees.triangles as f64),
            grouped(rays as f64),
            grouped(grid_rays as f64)
        ),
        ..Figure::default()
    };
    Some(by_precision().table(&trees.by_precision, figure))
}

/// Returns the plot alone, with the finding as its title, as an SVG file; `None` if nothing was
/// measured.
pub(crate) fn svg_file(trees: &TreeReport) -> Option<String> {
    let finding = finding(&trees.by_precision)?;
    let [w, h] = BROAD;
    let scatter = scatter(&trees.by_precision);
    let drawing = svg(w, h, LABEL, |canvas| scatter.draw(canvas, BROAD, &finding));
    Some(file(&drawing))
}

/// What the plot shows: what the exact tests give up in speed, in the first tree. `None` without
/// rows.
fn finding(rows: &[ExactnessRow]) -> Option<String> {
    let first = rows.first()?;
    let fastest = |loses: bool| {
        let rows = rows
            .iter()
            .filter(|row| row.split == first.split)
            .filter(|row| row.loses() == loses);
        rows.min_by(|a, b| a.time.ratio.median.total_cmp(&b.time.ratio.median))
    };
    let (exact, lossy) = (fastest(false), fastest(true));
    let Some(lossy) = lossy else {
        return exact.map(|_| "No tree loses a hit".into());
    };
    let lost = grouped(lossy.worst_per_million());
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

fn scatter(rows: &[ExactnessRow]) -> Scatter {
    let quartiles = rows.iter().map(ExactnessRow::rate);
    let rates = quartiles.flat_map(|r| [r.lower, r.upper]);
    let lost = rows.iter().map(ExactnessRow::worst_per_million);
    let is_first = |row: &ExactnessRow| rows.first().is_some_and(|first| row.split == first.split);
    let columns = by_precision();
    let points = rows.iter().map(|row| {
        let style = style_of(row, is_first(row));
        let Quartiles {
            lower,
            median,
            upper,
        } = row.rate();
        let test = format!("{} {}", row.triangle_test, row.precision.name());
        Point {
            style,
            area: AREA,
            at: (median, row.worst_per_million()),
            bar: Some([lower, upper]),
            name: match is_first(row) {
                true => format!("{test}\nboxes: {}", row.box_test),
                false => format!("{test}\n{}", row.split),
            },
            label: Label::left(NAME).in_color(style.color).bold(),
            tip: columns.tip(row),
        }
    });
    let single = |row: &&ExactnessRow| row.precision != Precision::F64;
    let entries = [
        (rows.iter().find(|row| is_first(row) && !single(row)), "f64"),
        (rows.iter().find(|row| is_first(row) && single(row)), "f32"),
        (rows.iter().find(|row| !is_first(row)), "another tree"),
    ];
    let key = entries.into_iter();
    Scatter {
        axes: [
            Axis::around("millions of rays per second", rates, figures),
            Axis::log_and_zero("lost hits in a million rays", lost, grouped),
        ],
        points: points.collect(),
        key: key
            .filter_map(|(row, text)| Some((style_of(row?, is_first(row?)), AREA, text.into())))
            .collect(),
    }
}

/// Colour and shape show the precision, as in the plot of triangle tests; trees other than the
/// first have a shape of their own.
fn style_of(row: &ExactnessRow, is_first: bool) -> SeriesStyle {
    let is_single = row.precision != Precision::F64;
    let marker = match (is_first, is_single) {
        (false, _) => Marker::Triangle,
        (true, false) => Marker::Disc,
        (true, true) => Marker::Square,
    };
    SeriesStyle::of(usize::from(is_single)).marked(marker, !is_single)
}
