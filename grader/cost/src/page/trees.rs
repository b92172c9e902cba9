//! Build time against tracing time of trees.

use crate::cells::plus_minus;
use crate::quartiles::Quartiles;
use crate::trees::table::by_build;
use crate::trees::{BreakEven, SlackRow, TreeReport, TreeRow, WrongHits};
use plots::canvas::{Canvas, Label, for_both_widths};
use plots::figure::Figure;
use plots::line_names::{self, LineName};
use plots::numbers::{figures, grouped, list, rounded, tick};
use plots::plot::{Axis, Plot};
use plots::style::{Marker, SeriesStyle};

/// Sizes in points: the plot with its names, and on a telephone.
const BROAD: [f64; 2] = [860.0, 340.0];
const NARROW: [f64; 2] = [300.0, 320.0];

/// Room for the names of lines, in both.
const NAMES: [f64; 2] = [110.0, 74.0];

/// Font size of the names.
const NAME: f64 = 9.5;

/// Range of the x axis: from the rays of a thumbnail to those of a film frame.
const RAYS: [f64; 2] = [1e4, 1e9];

/// Draws the total of build and tracing time, as a ratio to that of the first tree.
pub(crate) fn figure(trees: &TreeReport) -> Figure {
    let Some(base) = trees.by_build.first() else {
        return Figure::default();
    };
    let label = "Time to build a tree and to trace rays, as a ratio";
    let drawing = for_both_widths(BROAD, NARROW, label, |canvas, size, is_narrow| {
        let size = [size[0] - NAMES[usize::from(is_narrow)], size[1]];
        draw(canvas, size, trees, base)
    });
    let figure = Figure {
        finding: finding(trees, base),
        drawing,
        caption: format!(
            "The time to build a tree and to trace the rays, as a ratio to that of {}: below 1 is faster. Bars reach from quartile to \
             quartile, and rings are where a tree breaks even.",
            base.name
        ),
        notes: caption(trees),
        ..Figure::default()
    };
    by_build("").table(&trees.by_build, figure)
}

/// Draws the plot; the names of the lines are to the right of it.
fn draw(canvas: &Canvas, size: [f64; 2], trees: &TreeReport, base: &TreeRow) {
    let x = Axis::log("rays", RAYS, tick);
    let counts = || ray_counts().flat_map(|rays| trees.by_build.iter().map(move |t| (t, rays)));
    let ratios = counts().flat_map(|(tree, rays)| {
        let Quartiles { lower, upper, .. } = ratio(tree, base, rays);
        [lower, upper]
    });
    let y_name = format!("time to build and trace / that of {}", base.name);
    let y = Axis::log(&y_name, ratios, tick);
    let plot = Plot::new(canvas, "building and tracing", (0.0, 0.0), size, x, y);
    let mut names = Vec::new();
    for (k, tree) in trees.by_build.iter().enumerate() {
        let style = SeriesStyle::of(k);
        let points: Vec<(f64, Quartiles)> = ray_counts()
            .map(|rays| (rays, ratio(tree, base, rays)))
            .collect();
        let line: Vec<(f64, f64)> = points.iter().map(|(rays, r)| (*rays, r.median)).collect();
        plot.line(style, &line, if tree.student { 2.2 } else { 1.4 });
        for (i, (rays, r)) in points.iter().enumerate() {
            if k > 0 {
                plot.error_bar(style, *rays, r.lower, r.upper);
            }
            // Two points per decade, a marker at each decade.
            if i % 2 == 0 {
                plot.marker(style, (*rays, r.median), 26.0);
            }
            let text = format!(
                "{}: {} times the time of {} for {} rays",
                tree.name,
                plus_minus(r, 2),
                base.name,
                figures(*rays)
            );
            canvas.tip(plot.at(*rays, r.median), 6.0, &text);
        }
        names.extend(line.last().map(|&(rays, ratio)| LineName {
            end: plot.at(rays, ratio),
            text: vec![tree.name.clone()],
            label: Label::left(NAME).bold().in_color(style.color),
        }));
    }
    for (k, tree) in trees.by_build.iter().enumerate() {
        if let BreakEven::After {
            rays,
            at_least,
            at_most,
        } = tree.break_even
            && (RAYS[0]..=RAYS[1]).contains(&rays)
        {
            let style = SeriesStyle::of(k);
            plot.time_bar(style, [at_least, at_most], 1.0);
            let ring = SeriesStyle {
                hollow: true,
                marker: Marker::Disc,
                ..style
            };
            plot.marker(ring, (rays, 1.0), 110.0);
            let text = format!("{} breaks even after {} rays", tree.name, figures(rays));
            canvas.tip(plot.at(rays, 1.0), 8.0, &text);
        }
    }
    line_names::draw(canvas, names)
}

/// What the plot shows: which tree is worth its build first.
fn finding(trees: &TreeReport, base: &TreeRow) -> String {
    let after = trees
        .by_build
        .iter()
        .filter_map(|tree| match tree.break_even {
            BreakEven::After { rays, .. } => Some((tree, rays)),
            BreakEven::Immediate => Some((tree, 0.0)),
            _ => None,
        });
    match after.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((tree, 0.0)) => format!(
            "{} is better than {} from the first ray on",
            tree.name, base.name
        ),
        Some((tree, rays)) => format!(
            "{} is worth its build from {} rays on",
            tree.name,
            rounded(rays)
        ),
        None => format!("No tree is better than {}", base.name),
    }
}

/// The numbers of rays of the points: two per decade.
fn ray_counts() -> impl Iterator<Item = f64> {
    (0..=10).map(|i| RAYS[0] * 10.0_f64.powf(0.5 * f64::from(i)))
}

/// The ratio of two trees' times; its quartiles are those of `tree`.
fn ratio(tree: &TreeRow, base: &TreeRow, rays: f64) -> Quartiles {
    seconds(tree, rays).scaled(1.0 / seconds(base, rays).median)
}

/// Returns the seconds to build the tree and to trace `rays` rays.
fn seconds(tree: &TreeRow, rays: f64) -> Quartiles {
    let (build, trace) = (&tree.build_s, tree.trace.time.ns.scaled(1e-9 * rays));
    Quartiles {
        lower: build.lower + trace.lower,
        median: build.median + trace.median,
        upper: build.upper + trace.upper,
    }
}

/// Returns the notes, computed from the numbers.
fn caption(trees: &TreeReport) -> String {
    let mut text = format!(
        "The trees are over the {} mesh of {} triangles. ~ marks a tie with the first one; in brackets are the quartiles. ",
        trees.mesh,
        grouped(trees.triangles as f64)
    );
    let walks: Vec<String> = trees.by_slack.iter().map(slack).collect();
    if !walks.is_empty() {
        text += &format!("With {}.", list(&walks));
    }
    text
}

/// Returns the wrong hits and the time with one value of pruning slack.
fn slack(row: &SlackRow) -> String {
    let wrong = |hits: WrongHits| format!("{} of {}", hits.wrong, hits.rays);
    let crafted = row.trace.crafted.map_or(String::new(), |hits| {
        format!(" and of {} crafted rays", wrong(hits))
    });
    format!(
        "{} ulp of slack the hits of {} timed rays{crafted} are wrong ({} times the tracing time without slack)",
        row.slack_ulp,
        wrong(row.trace.ordinary),
        plus_minus(&row.trace.time.ratio, 2)
    )
}
