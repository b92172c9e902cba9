//! Build time against tracing time of trees.

use super::canvas::{DrawResult, svg};
use super::formatting::{figures, list, tick};
use super::plot::{Axis, Plot, legend};
use super::style::{self, SeriesStyle};
use crate::trees::{TreeReport, TreeRow};
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
            let times = all.flat_map(|tree| RAYS.map(|rays| seconds(tree, rays)));
            let y = Axis::log("seconds to build and trace", times, tick);
            let plot = Plot::new(canvas, "building and tracing", (0.0, 0.0), PLOT, x, y)?;
            let mut entries = Vec::new();
            for (k, tree) in trees.by_build.iter().enumerate() {
                let style = SeriesStyle::of(k);
                // Two points per decade, because the line is curved.
                let ray_counts = (0..=10).map(|i| RAYS[0] * 10.0_f64.powf(0.5 * f64::from(i)));
                let line: Vec<(f64, f64)> =
                    ray_counts.map(|rays| (rays, seconds(tree, rays))).collect();
                plot.line(style, &line, if tree.student { 2.2 } else { 1.4 })?;
                if let Some(rays) = break_even(tree) {
                    style::marker(canvas, style, plot.at(rays, seconds(tree, rays)), 40.0)?;
                }
                entries.push((Some(style), tree.name.clone()));
            }
            entries.push((None, "markers: break-even with midpoint".into()));
            legend(canvas, (PLOT[0] + 10.0, 34.0), &entries)
        },
    )?;
    Ok((figure_html, caption(trees)))
}

fn seconds(tree: &TreeRow, rays: f64) -> f64 {
    tree.build_s + 1e-9 * tree.trace.time.ns_median * rays
}

/// Returns the number of rays at which the tree breaks even, if that is on the plot.
fn break_even(tree: &TreeRow) -> Option<f64> {
    tree.break_even_rays
        .filter(|rays| (RAYS[0]..=RAYS[1]).contains(rays))
}

/// Returns the caption, computed from the numbers.
fn caption(trees: &TreeReport) -> String {
    let builds: Vec<String> = trees
        .by_build
        .iter()
        .map(|tree| {
            format!(
                "{} takes {} ms to build and {} ns per ray",
                tree.name,
                figures(1e3 * tree.build_s),
                figures(tree.trace.time.ns_median)
            )
        })
        .collect();
    let mut text = format!(
        "Trees over the {} mesh of {} triangles: {}. ",
        trees.mesh,
        trees.triangles,
        list(&builds)
    );
    for tree in &trees.by_build {
        match tree.break_even_rays {
            Some(rays) if rays > 0.0 => {
                text += &format!("{} breaks even after {} rays. ", tree.name, figures(rays));
            }
            _ => {}
        }
    }
    let walks: Vec<String> = trees
        .by_slack
        .iter()
        .map(|row| {
            format!(
                "{} ulp of slack {} closest hits per million are wrong ({} times the tracing time without slack)",
                row.slack_ulp,
                figures(row.trace.wrong_per_million),
                figures(row.trace.time.ratio_to_textbook)
            )
        })
        .collect();
    if !walks.is_empty() {
        text += &format!("With {}.", list(&walks));
    }
    text
}
