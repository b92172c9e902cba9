//! Figures of Part 2: building trees.

use super::parts::{Figure, flat_box, outline, w};
use crate::drawing::{Drawing, Side};
use kit::{Aabb, PixelSampler, Vec2, Vec3};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part2-hierarchy", hierarchy()),
        ("part2-levels", levels()),
        ("part2-split", split()),
    ]
}

/// Triangles in boxes in boxes, and a ray that misses most of them.
fn hierarchy() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-0.2, -0.1), w(8.0, 3.4)],
        "Triangles in boxes, two boxes in a larger box, and all in the root. A ray that misses the box on the \
         right misses all that is in it with one test.",
    );
    let corner = |x: f64, y: f64| Vec3::new(x, y, 0.0);
    let groups = [
        [(0.3, 0.3), (1.0, 0.2), (0.7, 0.9)],
        [(0.5, 2.0), (1.3, 2.3), (0.8, 2.9)],
        [(2.3, 1.2), (3.2, 1.0), (2.9, 1.9)],
        [(5.3, 0.4), (6.2, 0.7), (5.6, 1.3)],
        [(6.6, 1.7), (7.5, 1.9), (6.9, 2.6)],
    ];
    let boxes: Vec<Aabb> = groups
        .iter()
        .map(|group| {
            let points: Vec<Vec2> = group.iter().map(|(x, y)| w(*x, *y)).collect();
            d.polygon(&points, "blue");
            Aabb::of(group.iter().map(|(x, y)| corner(*x, *y)))
        })
        .collect();
    for b in &boxes {
        d.path(&outline(b, 0.05), "green");
    }
    let left = boxes[..3].iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
    let right = boxes[3..].iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
    d.path(&outline(&left, 0.12), "red");
    d.path(&outline(&right, 0.12), "red");
    d.path(&outline(&left.union(right), 0.2), "ink");
    d.arrow(w(-0.2, 0.1), w(3.7, 3.35), "ink dash");
    d.note(w(3.4, 2.5), Side::Right, "hit", "red");
    d.note(w(6.4, 2.92), Side::Centre, "missed: 1 test", "red");
    d.finish()
}

/// A node for drawing: its box, and its boxes below.
struct Node {
    bounds: Aabb,
    below: Vec<Node>,
}

/// Halves the widest direction of the centroids until two boxes are left.
fn halve(boxes: &[Aabb]) -> Node {
    let bounds = boxes.iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
    let spread = Aabb::of(boxes.iter().map(Aabb::centroid));
    let axis = spread.extent().max_position();
    let middle = spread.centroid()[axis];
    let is_low = |b: &&Aabb| b.centroid()[axis] < middle;
    let low: Vec<Aabb> = boxes.iter().filter(is_low).copied().collect();
    let high: Vec<Aabb> = boxes.iter().filter(|b| !is_low(b)).copied().collect();
    let below = if boxes.len() <= 2 || low.is_empty() {
        Vec::new()
    } else {
        vec![halve(&low), halve(&high)]
    };
    Node { bounds, below }
}

/// Four levels of a tree over random boxes.
fn levels() -> String {
    let mut sampler = PixelSampler::new(0, 0, 2);
    let boxes: Vec<Aabb> = (0..26)
        .map(|k| {
            let (s, size) = (sampler.get_sample(), sampler.next_2d());
            let centre = if k % 3 == 0 { 0.35 * s + 0.1 } else { s };
            flat_box(
                centre.x * 1.6,
                centre.y,
                0.02 + 0.08 * size.x,
                0.02 + 0.08 * size.y,
            )
        })
        .collect();
    let root = halve(&boxes);
    let mut d = Drawing::new(
        [660.0, 460.0],
        [w(0.0, -0.1), w(3.7, 2.5)],
        "A hierarchy over 26 boxes: the root, and the levels 1, 2 and 4 below it.",
    );
    for (k, level) in [0_u32, 1, 2, 4].into_iter().enumerate() {
        let shift = Vec3::new(1.95 * (k % 2) as f64, 1.32 * (1 - k / 2) as f64, 0.0);
        let moved = |b: &Aabb| Aabb {
            min: b.min + shift,
            max: b.max + shift,
        };
        for b in &boxes {
            d.area(&outline(&moved(b), 0.0)[..4], "blue");
        }
        let mut nodes = vec![&root];
        for _ in 0..level {
            nodes = nodes
                .into_iter()
                .flat_map(|node| {
                    let here = if node.below.is_empty() {
                        vec![node]
                    } else {
                        Vec::new()
                    };
                    node.below.iter().chain(here)
                })
                .collect();
        }
        for (i, node) in nodes.iter().enumerate() {
            let colour = ["red", "green", "ink", "blue"][i % 4];
            d.path(&outline(&moved(&node.bounds), 0.008), colour);
        }
        let middle = w(0.85, -0.02) + shift.truncate();
        d.note(middle, Side::Below, format!("level {level}"), "ink");
    }
    d.finish()
}

/// Boxes on an axis: the midpoint of their centroids, and that of their extent.
fn split() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-0.4, -1.4), w(10.4, 2.9)],
        "Four small boxes and a large one on an axis. Above: the midpoint of the centroids separates them. Below: \
         the midpoint of the extent of the boxes has all centroids on one side.",
    );
    let large = (0.2, 9.8);
    let small = [(5.6, 6.4), (6.7, 7.3), (7.9, 8.6), (9.0, 9.7)];
    let centre = |(a, b): (f64, f64)| 0.5 * (a + b);
    d.path(
        &outline(&flat_box(large.0, 1.2, large.1 - large.0, 0.3), 0.0),
        "blue",
    );
    for b in small {
        d.path(&outline(&flat_box(b.0, 0.5, b.1 - b.0, 0.4), 0.0), "blue");
    }
    let centroids: Vec<f64> = small.iter().chain([&large]).map(|b| centre(*b)).collect();
    for (i, c) in centroids.iter().enumerate() {
        d.dot(w(*c, if i < 4 { 0.7 } else { 1.35 }), "ink");
    }
    let (first, last) = (centroids[4], centroids[3]);
    let m = 0.5 * (first + last);
    d.line(w(m, 0.2), w(m, 2.1), "green");
    d.label(w(m, 2.1), Side::Above, "m", "green");
    for (x, name) in [(first, "x_0"), (last, "x_1")] {
        d.line(w(x, 0.2), w(x, 2.1), "soft dash");
        d.label(w(x, 2.1), Side::Above, name, "ink");
    }
    let wrong = centre(large);
    d.line(w(0.0, -0.2), w(10.2, -0.2), "soft");
    for c in &centroids {
        d.dot(w(*c, -0.2), "ink");
    }
    d.line(w(wrong, -0.6), w(wrong, 0.1), "red");
    d.note(
        w(wrong, -0.6),
        Side::Below,
        "middle of the boxes: no centroid is below it",
        "red",
    );
    d.finish()
}
