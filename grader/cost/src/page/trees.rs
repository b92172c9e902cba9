//! What a better tree costs and when it has paid for itself.

use super::canvas::{Drawn, svg};
use super::look::{self, Look};
use super::plot::{Axis, Plot, legend};
use super::words::{figures, list, tick};
use crate::trees::{Tree, Trees};
use grader::error::GraderError;

const WIDTH: f64 = 860.0;
const PLOT: [f64; 2] = [560.0, 320.0];

/// Rays across: from a thumbnail's to those of a film's frame.
const RAYS: [f64; 2] = [1e4, 1e9];

/// The plot of build and trace times together, and what it shows.
pub(crate) fn figure(trees: &Trees) -> Result<(String, String), GraderError> {
    let drawn = svg(
        WIDTH,
        PLOT[1],
        "Time to build a tree and trace rays",
        |canvas| -> Drawn {
            let x = Axis::log("rays", RAYS, tick);
            let all = trees.by_build.iter();
            let times = all.flat_map(|tree| RAYS.map(|rays| seconds(tree, rays)));
            let y = Axis::log("seconds to build and trace", times, tick);
            let plot = Plot::new(canvas, "building and tracing", (0.0, 0.0), PLOT, x, y)?;
            let mut entries = Vec::new();
            for (k, tree) in trees.by_build.iter().enumerate() {
                let look = Look::of(k);
                // Halves of decades: the sum of a constant and a line bends.
                let places = (0..=10).map(|i| RAYS[0] * 10.0_f64.powf(0.5 * f64::from(i)));
                let line: Vec<(f64, f64)> =
                    places.map(|rays| (rays, seconds(tree, rays))).collect();
                plot.line(look, &line, if tree.student { 2.2 } else { 1.4 })?;
                if let Some(rays) = pays_after(tree) {
                    look::marker(canvas, look, plot.at(rays, seconds(tree, rays)), 40.0)?;
                }
                entries.push((Some(look), tree.name.clone()));
            }
            entries.push((None, "markers: faster than midpoint from here on".into()));
            legend(canvas, (PLOT[0] + 10.0, 34.0), &entries)
        },
    )?;
    Ok((drawn, words(trees)))
}

fn seconds(tree: &Tree, rays: f64) -> f64 {
    tree.build_s + 1e-9 * tree.trace.time.ns_median * rays
}

/// Where the tree has paid for itself, if that is on the plot.
fn pays_after(tree: &Tree) -> Option<f64> {
    tree.pays_after_rays
        .filter(|rays| (RAYS[0]..=RAYS[1]).contains(rays))
}

/// What the numbers say.
fn words(trees: &Trees) -> String {
    let builds: Vec<String> = trees
        .by_build
        .iter()
        .map(|tree| {
            format!(
                "{} takes {} ms to build and {} ns a ray",
                tree.name,
                figures(1e3 * tree.build_s),
                figures(tree.trace.time.ns_median)
            )
        })
        .collect();
    let mut said = format!(
        "Over the {} mesh of {} triangles {}. ",
        trees.mesh,
        trees.triangles,
        list(&builds)
    );
    for tree in &trees.by_build {
        match tree.pays_after_rays {
            Some(rays) if rays > 0.0 => {
                said += &format!(
                    "{} has paid for itself after {} rays. ",
                    tree.name,
                    figures(rays)
                );
            }
            _ => {}
        }
    }
    let walks: Vec<String> = trees
        .by_slack
        .iter()
        .map(|walk| {
            format!(
                "{} ulp of slack {} closest hits in a million are wrong ({} of the time without)",
                walk.slack_ulp,
                figures(walk.trace.wrong_per_million),
                figures(walk.trace.time.ratio_to_textbook)
            )
        })
        .collect();
    if !walks.is_empty() {
        said += &format!("With {}.", list(&walks));
    }
    said
}
