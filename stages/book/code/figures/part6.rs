//! Figures of Part 6: eight at a time.

use super::parts::{Figure, graph, rectangle, w};
use crate::drawing::{Drawing, Side};
use kit::Vec2;

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part6-lanes", lanes()),
        ("part6-collapse", collapse()),
        ("part6-busy", busy()),
    ]
}

/// The number of lanes.
const LANES: u32 = 8;

/// A square of size 1 with its lower left corner at `at`.
fn cell(at: Vec2) -> [Vec2; 4] {
    rectangle(at, at + 1.0)
}

/// A scalar addition and eight in one instruction.
fn lanes() -> String {
    let mut d = Drawing::new(
        [640.0, 240.0],
        [w(-4.4, -0.4), w(9.2, 4.6)],
        "Above: a scalar addition uses one lane, seven are idle. Below: one instruction adds eight numbers to eight others.",
    );
    for lane in 0..LANES {
        let x = f64::from(lane) * 1.1;
        let colour = if lane == 0 { "blue" } else { "soft" };
        d.polygon(&cell(w(x, 3.2)), colour);
        d.polygon(&cell(w(x, 0.9)), "blue");
        d.note(w(x + 0.5, 1.4), Side::Centre, format!("x{lane}"), "ink");
        d.note(w(x + 0.5, 0.2), Side::Centre, lane, "soft");
    }
    d.note(w(0.5, 3.7), Side::Centre, "x", "ink");
    d.note(w(-0.2, 3.7), Side::Left, "one instruction", "ink");
    d.note(w(-0.2, 1.4), Side::Left, "one instruction", "ink");
    d.note(w(-0.2, 0.2), Side::Left, "lane", "soft");
    d.finish()
}

/// Three levels of a binary tree, and the node that they become.
fn collapse() -> String {
    let mut d = Drawing::new(
        [640.0, 230.0],
        [w(-0.6, -0.7), w(17.6, 4.6)],
        "Left: a binary tree with seven inner nodes on three levels and eight leaves. Right: one node with the same eight \
         leaves as children.",
    );
    let at = |level: u32, i: u32| {
        let width = 8.0 / f64::from(1 << level);
        w((f64::from(i) + 0.5) * width, 3.9 - 1.3 * f64::from(level))
    };
    for level in 0..3 {
        for i in 0..1 << level {
            for child in [2 * i, 2 * i + 1] {
                d.line(at(level, i), at(level + 1, child), "ink");
            }
            d.dot(at(level, i), "blue");
        }
    }
    let root = w(13.3, 3.9);
    for i in 0..LANES {
        d.dot(at(3, i), "green");
        let leaf = w(9.3 + 1.14 * f64::from(i), 0.0);
        d.line(root, leaf, "ink");
        d.dot(leaf, "green");
    }
    d.dot(root, "blue");
    d.note(w(4.0, 0.0), Side::Below, "7 nodes, 3 levels", "ink");
    d.note(w(13.3, 0.0), Side::Below, "1 node, 1 level", "ink");
    d.finish()
}

/// The share of busy lanes if eight paths stay together until the last one ends.
fn together(q: f64) -> f64 {
    let steps = (0..2000).map(|i| 1.0 - (1.0 - q.powi(i)).powi(LANES as i32));
    1.0 / (1.0 - q) / steps.sum::<f64>()
}

/// The share of busy lanes if the living paths of a batch move up before each bounce.
fn moved_up(q: f64, batch: u32) -> f64 {
    let (mut paths, mut lanes) = (0.0, 0.0);
    for bounce in 0..2000 {
        let alive = q.powi(bounce);
        paths += f64::from(batch) * alive;
        lanes += f64::from(LANES) * packets(batch, alive);
        if alive * f64::from(batch) < 1e-9 {
            break;
        }
    }
    paths / lanes
}

/// The expected number of packets of the paths that live, each with the probability `alive`.
fn packets(batch: u32, alive: f64) -> f64 {
    if alive >= 1.0 {
        return f64::from(batch.div_ceil(LANES));
    }
    let mut probability = (1.0 - alive).powi(batch as i32);
    let mut expected = 0.0;
    for k in 1..=batch {
        probability *= f64::from(batch - k + 1) / f64::from(k) * alive / (1.0 - alive);
        expected += probability * f64::from(k.div_ceil(LANES));
    }
    expected
}

/// Both shares against the probability to go on.
fn busy() -> String {
    let shares = |share: &dyn Fn(f64) -> f64| {
        let [start, half, most] = [0.0, 0.5, 0.9].map(share);
        format!("{start} at q = 0, {half:.2} at 0.5, {most:.2} at 0.9")
    };
    let mut d = Drawing::graph(
        [640.0, 300.0],
        [w(-0.08, -0.12), w(1.14, 1.05)],
        &format!(
            "Share of busy lanes against the probability q that a path goes on. Eight paths that stay together: {}. A \
             batch of 64 whose living paths move up: {}.",
            shares(&together),
            shares(&|q| moved_up(q, 64))
        ),
    );
    d.levels([0.0, 1.0], [0.0, 0.5, 1.0].map(|y| (y, y)));
    for q in [0.0, 0.25, 0.5, 0.75, 1.0] {
        d.note(w(q, 0.0), Side::Below, format!("q = {q}"), "ink");
    }
    let ends = [
        ("red", graph(together, [0.0, 0.95], 38), "8 together"),
        (
            "blue",
            graph(|q| moved_up(q, 64), [0.0, 0.95], 38),
            "64, moved up",
        ),
    ];
    for (colour, points, words) in ends {
        d.path(&points, colour);
        d.note(points[points.len() - 1], Side::Right, words, colour);
    }
    d.finish()
}
