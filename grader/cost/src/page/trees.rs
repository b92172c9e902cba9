//! Build time against tracing time of trees.

use super::canvas::{DrawResult, svg};
use super::formatting::{figures, list, tick};
use super::plot::{Axis, Plot, legend};
use super::style::{self, SeriesStyle};
use crate::quartiles::Quartiles;
use crate::table::plus_minus;
use crate::trees::{BreakEven, SlackRow, TreeReport, TreeRow, WrongHits};
use grader::error::GraderError;

const WIDTH: f64 = 860.0;
const PLOT: [f64; 2] = [560.0, 320.0];

/// Range of the x axis: from the rays of a thumbnail to those of a film frame.
const RAYS: [f64; 2] = [1e4, 1e9];

/// Draws the total of build and tracing time; returns the SVG and its caption.
pub(crate) fn figure(trees: &TreeReport) -> Result<(String, String), GraderError> {
    let figure_html = svg(
        WIDTH,
        PLOT[1],
        "Time to build a tree and to trace rays",
        |canvas| -> DrawResult {
            let x = Axis::log("rays", RAYS, tick);
            let all = trees.by_build.iter();
            let times = all.flat_map(|tree| RAYS.map(|rays| seconds(tree, rays).median));
            let y = Axis::log("seconds to build and trace", times, tick);
            let plot = Plot::new(canvas, "building and tracing", (0.0, 0.0), PLOT, x, y)?;
            let mut entries = Vec::new();
            for (k, tree) in trees.by_build.iter().enumerate() {
                let style = SeriesStyle::of(k);
                // Two points per decade, because the line is curved.
                let ray_counts = (0..=10).map(|i| RAYS[0] * 10.0_f64.powf(0.5 * f64::from(i)));
                let points: Vec<(f64, Quartiles)> =
                    ray_counts.map(|rays| (rays, seconds(tree, rays))).collect();
                let line: Vec<(f64, f64)> =
                    points.iter().map(|(rays, s)| (*rays, s.median)).collect();
                plot.line(style, &line, if tree.student { 2.2 } else { 1.4 })?;
                for (rays, s) in points {
                    plot.error_bar(style, rays, s.lower, s.upper)?;
                }
                if let BreakEven::After {
                    rays,
                    at_least,
                    at_most,
                } = tree.break_even
                    && (RAYS[0]..=RAYS[1]).contains(&rays)
                {
                    let y = seconds(tree, rays).median;
                    plot.time_bar(style, [at_least, at_most], y)?;
                    style::marker(canvas, style, plot.at(rays, y), 40.0)?;
                }
                entries.push((Some(style), tree.name.clone()));
            }
            entries.push((None, "markers: break-even with the first".into()));
            legend(canvas, (PLOT[0] + 10.0, 34.0), &entries)
        },
    )?;
    Ok((figure_html, caption(trees)))
}

/// Returns the seconds to build the tree and to trace `rays` rays.
fn seconds(tree: &TreeRow, rays: f64) -> Quartiles {
    let (build, ns) = (&tree.build_s, &tree.trace.time.ns);
    let total = |build: f64, ns: f64| build + 1e-9 * ns * rays;
    Quartiles {
        lower: total(build.lower, ns.lower),
        median: total(build.median, ns.median),
        upper: total(build.upper, ns.upper),
    }
}

/// Returns the caption, computed from the numbers.
fn caption(trees: &TreeReport) -> String {
    let rows = trees.by_build.iter();
    let builds: Vec<String> = rows
        .map(|tree| {
            format!(
                "{} takes {} ms to build and {} ns per ray",
                tree.name,
                plus_minus(&tree.build_s.scaled(1e3), 1),
                plus_minus(&tree.trace.time.ns, 0)
            )
        })
        .collect();
    let mut text = format!(
        "Trees over the {} mesh of {} triangles: {}. Bars reach from quartile to quartile. ",
        trees.mesh,
        trees.triangles,
        list(&builds)
    );
    for tree in &trees.by_build {
        let ratio = plus_minus(&tree.trace.time.ratio, 2);
        text += &match tree.break_even {
            BreakEven::Base | BreakEven::Never | BreakEven::Immediate => continue,
            BreakEven::WithinNoise => format!(
                "The tracing time of {}, {ratio} times that of the first tree, ties with it. ",
                tree.name
            ),
            BreakEven::After {
                rays,
                at_least,
                at_most,
            } => format!(
                "{} breaks even after {} rays (from {} to {} for the quartiles of its times). ",
                tree.name,
                figures(rays),
                figures(at_least),
                figures(at_most)
            ),
        };
    }
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
