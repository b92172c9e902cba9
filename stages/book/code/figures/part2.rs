//! Figures of Part 2.

use super::Figure;
use crate::drawing::{Drawing, Side};
use kit::{Aabb, PixelSampler, Vec2, Vec3};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part2-hierarchy", hierarchy()),
        ("part2-levels", levels()),
        ("part2-split", split()),
        ("part2-slabs", slabs()),
        ("part2-intervals", intervals()),
        ("part2-unswapped", unswapped()),
        ("part2-traversal", traversal()),
        ("part2-overlap", overlap()),
    ]
}

fn w(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The outline of a box in the xy plane, with a gap around it.
fn outline(b: &Aabb, gap: f64) -> Vec<Vec2> {
    let (low, high) = (b.min - gap, b.max + gap);
    vec![
        w(low.x, low.y),
        w(high.x, low.y),
        w(high.x, high.y),
        w(low.x, high.y),
        w(low.x, low.y),
    ]
}

fn flat_box(x: f64, y: f64, width: f64, height: f64) -> Aabb {
    let min = Vec3::new(x, y, 0.0);
    Aabb {
        min,
        max: min + Vec3::new(width, height, 0.0),
    }
}

/// Triangles in boxes in boxes, and a ray that misses most of them.
fn hierarchy() -> String {
    let mut d = Drawing::new(
        640.0,
        300.0,
        w(-0.2, -0.1),
        w(8.0, 3.4),
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
        660.0,
        460.0,
        w(0.0, -0.1),
        w(3.7, 2.5),
        "A hierarchy over 26 boxes: the root, and the levels 1, 2 and 4 below it.",
    );
    for (k, level) in [0_u32, 1, 2, 4].into_iter().enumerate() {
        let shift = Vec3::new(1.95 * (k % 2) as f64, 1.32 * (1 - k / 2) as f64, 0.0);
        let moved = |b: &Aabb| Aabb {
            min: b.min + shift,
            max: b.max + shift,
        };
        for b in &boxes {
            let mut corners = outline(&moved(b), 0.0);
            corners.pop();
            d.area(&corners, "blue");
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
        d.note(middle, Side::Below, &format!("level {level}"), "ink");
    }
    d.finish()
}

/// Boxes on an axis: the midpoint of their centroids, and that of their extent.
fn split() -> String {
    let mut d = Drawing::new(
        640.0,
        300.0,
        w(-0.4, -1.4),
        w(10.4, 2.9),
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

/// A ray in the plane that crosses an x slab and a y slab.
fn slabs() -> String {
    let b = flat_box(0.0, 0.0, 3.0, 2.0);
    let (o, dir) = (w(-2.6, -0.7), w(1.0, 0.42));
    let at = |t: f64| o + t * dir;
    let mut d = Drawing::new(
        600.0,
        360.0,
        w(-2.9, -1.1),
        w(4.6, 3.0),
        "A ray crosses the slab of x between ex and fx, and the slab of y between ey and fy. It is in the box \
         from the later entry to the earlier exit.",
    );
    d.area(
        &[w(0.0, -1.1), w(3.0, -1.1), w(3.0, 3.0), w(0.0, 3.0)],
        "blue",
    );
    d.area(
        &[w(-2.9, 0.0), w(4.6, 0.0), w(4.6, 2.0), w(-2.9, 2.0)],
        "green",
    );
    d.path(&outline(&b, 0.0), "ink");
    d.line(o, at(7.0), "ink");
    d.arrow(o, at(1.0), "ink");
    let t = |plane: f64, axis: usize| (plane - o[axis]) / dir[axis];
    for (plane, axis, name, side, colour) in [
        (0.0, 0, "e_x", Side::Above, "blue"),
        (3.0, 0, "f_x", Side::Below, "blue"),
        (0.0, 1, "e_y", Side::Below, "green"),
        (2.0, 1, "f_y", Side::Below, "green"),
    ] {
        let p = at(t(plane, axis));
        d.dot(p, colour);
        d.label(p, side, name, colour);
    }
    d.dot(o, "ink");
    d.label(o, Side::Below, "o", "ink");
    d.label(at(0.7), Side::Above, "d", "ink");
    d.label(w(0.0, 0.0), Side::Below, "l", "ink");
    d.label(w(3.0, 2.0), Side::Above, "h", "ink");
    d.finish()
}

/// The three slabs as intervals on the ray.
fn intervals() -> String {
    let mut d = Drawing::new(
        640.0,
        240.0,
        w(-0.9, -0.6),
        w(9.2, 3.1),
        "Intervals of t: those of the x, y and z slabs and the range of the ray. All overlap from the last start \
         to the first end.",
    );
    let rows = [
        ("x", 2.0, 6.0, "blue"),
        ("y", 0.6, 7.6, "green"),
        ("z", 1.2, 4.8, "red"),
        ("range", 0.0, 9.0, "ink"),
    ];
    let start = rows.iter().map(|row| row.1).fold(0.0, f64::max);
    let end = rows.iter().map(|row| row.2).fold(9.0, f64::min);
    d.area(
        &[w(start, -0.2), w(end, -0.2), w(end, 2.8), w(start, 2.8)],
        "soft",
    );
    for (i, (name, from, to, colour)) in rows.into_iter().enumerate() {
        let y = 2.5 - 0.7 * i as f64;
        d.line(w(from, y), w(to, y), colour);
        d.dot(w(from, y), colour);
        d.dot(w(to, y), colour);
        d.note(w(-0.1, y), Side::Left, name, colour);
    }
    d.label(w(start, -0.2), Side::Below, "t_e", "ink");
    d.label(w(end, -0.2), Side::Below, "t_f", "ink");
    d.finish()
}

/// The tree of the worked example of task 3, with entries and hits.
fn traversal() -> String {
    let mut d = Drawing::new(
        640.0,
        300.0,
        w(-0.2, -0.9),
        w(8.2, 3.0),
        "The tree of the worked example: the root A, the nodes B and C, and the leaves D, E, F and G, each with its \
         entry, the leaves with the distance of their hit. The nearest hit is in F.",
    );
    let nodes = [
        ("A", w(4.0, 2.6), ""),
        ("B", w(2.0, 1.4), "entry 1"),
        ("C", w(6.0, 1.4), "entry 3"),
        ("D", w(1.0, 0.2), "entry 1"),
        ("E", w(3.0, 0.2), "entry 4"),
        ("F", w(5.0, 0.2), "entry 3"),
        ("G", w(7.0, 0.2), "entry 7"),
    ];
    for (from, to) in [(0, 1), (0, 2), (1, 3), (1, 4), (2, 5), (2, 6)] {
        d.line(
            nodes[from].1 - w(0.0, 0.28),
            nodes[to].1 + w(0.0, 0.28),
            "soft",
        );
    }
    for (i, (name, p, entry)) in nodes.into_iter().enumerate() {
        let colour = if i < 3 { "blue" } else { "green" };
        d.circle(p, 0.28, colour);
        d.label(p, Side::Centre, name, colour);
        d.note(p + w(0.25, 0.0), Side::Right, entry, "ink");
    }
    for (leaf, hit, colour) in [
        (3, "hit 6", "ink"),
        (4, "hit 5", "ink"),
        (5, "hit 4.5", "red"),
        (6, "hit 7.5", "ink"),
    ] {
        d.note(nodes[leaf].1 - w(0.0, 0.28), Side::Below, hit, colour);
    }
    d.finish()
}

/// A ray to the left through a slab: which plane is the entry.
fn unswapped() -> String {
    let mut d = Drawing::new(
        640.0,
        200.0,
        w(-0.4, -0.9),
        w(9.4, 1.5),
        "A ray that goes to the left reaches the high plane first. Who takes the low plane for the entry gets an entry \
         after the exit, and misses the box.",
    );
    d.area(
        &[w(3.0, -0.4), w(5.5, -0.4), w(5.5, 1.0), w(3.0, 1.0)],
        "blue",
    );
    d.line(w(3.0, -0.4), w(3.0, 1.0), "blue");
    d.line(w(5.5, -0.4), w(5.5, 1.0), "blue");
    d.arrow(w(8.8, 0.3), w(0.2, 0.3), "ink");
    d.dot(w(8.8, 0.3), "ink");
    d.label(w(8.8, 0.3), Side::Below, "o", "ink");
    d.label(w(3.0, 1.0), Side::Above, "l_x", "blue");
    d.label(w(5.5, 1.0), Side::Above, "h_x", "blue");
    d.dot(w(5.5, 0.3), "green");
    d.dot(w(3.0, 0.3), "red");
    d.note(w(5.95, 0.3), Side::Below, "entry", "green");
    d.note(w(2.65, 0.3), Side::Below, "exit", "red");
    d.finish()
}

/// Two overlapping boxes: the hit in the nearer box is farther than the hit in the other one.
fn overlap() -> String {
    let mut d = Drawing::new(
        640.0,
        270.0,
        w(-0.5, -0.3),
        w(9.6, 3.4),
        "The ray enters the left box first, but the triangle in it is hit at 6. The right box is entered at 3, and its \
         triangle is hit at 4.5. Stopping after the first box would return the wrong triangle.",
    );
    let at = |t: f64| w(0.3 + 1.15 * t, 1.2);
    d.path(&outline(&flat_box(at(1.0).x, 0.1, 5.9, 2.6), 0.0), "blue");
    d.path(&outline(&flat_box(at(3.0).x, 0.5, 4.6, 2.6), 0.0), "green");
    let triangle = |t: f64| {
        [
            at(t) + w(0.0, -0.55),
            at(t) + w(0.12, 0.7),
            at(t) + w(-0.08, 0.75),
        ]
    };
    d.polygon(&triangle(6.0), "blue");
    d.polygon(&triangle(4.5), "green");
    d.arrow(at(0.0), at(7.6), "ink");
    d.dot(at(0.0), "ink");
    for (t, words, side) in [(1.0, "entry 1", Side::Below), (3.0, "entry 3", Side::Below)] {
        d.dot(at(t), "ink");
        d.note(at(t) + w(0.45, 0.0), side, words, "ink");
    }
    d.dot(at(4.5), "red");
    d.note(at(4.5) + w(0.5, 0.0), Side::Below, "hit 4.5", "red");
    d.dot(at(6.0), "ink");
    d.note(at(6.0) + w(0.45, 0.0), Side::Below, "hit 6", "ink");
    d.finish()
}
