//! Figures of Part 2: the traversal of trees.

use super::parts::{Figure, flat_box, outline, w};
use crate::drawing::{Drawing, Side};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part2-traversal", traversal()),
        ("part2-overlap", overlap()),
    ]
}

/// The tree of the worked example of task 3, with entries and hits.
fn traversal() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-0.2, -0.9), w(8.2, 3.0)],
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

/// Two overlapping boxes: the hit in the nearer box is farther than the hit in the other one.
fn overlap() -> String {
    let mut d = Drawing::new(
        [640.0, 270.0],
        [w(-0.5, -0.3), w(9.6, 3.4)],
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
