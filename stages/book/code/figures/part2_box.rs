//! Figures of Part 2: ray against box.

use super::parts::{Figure, flat_box, outline, rectangle, w};
use crate::drawing::{Drawing, Side};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part2-slabs", slabs()),
        ("part2-intervals", intervals()),
        ("part2-unswapped", unswapped()),
    ]
}

/// A ray in the plane that crosses an x slab and a y slab.
fn slabs() -> String {
    let b = flat_box(0.0, 0.0, 3.0, 2.0);
    let (o, dir) = (w(-2.6, -0.7), w(1.0, 0.42));
    let at = |t: f64| o + t * dir;
    let mut d = Drawing::new(
        [600.0, 360.0],
        [w(-2.9, -1.1), w(4.6, 3.0)],
        "A ray crosses the slab of x between ex and fx, and the slab of y between ey and fy. It is in the box \
         from the later entry to the earlier exit.",
    );
    d.area(&rectangle(w(0.0, -1.1), w(3.0, 3.0)), "blue");
    d.area(&rectangle(w(-2.9, 0.0), w(4.6, 2.0)), "green");
    d.path(&outline(&b, 0.0), "ink");
    d.line(o, at(7.0), "ink");
    d.arrow(o, at(1.0), "ink");
    let t = |plane: f64, axis: usize| (plane - o[axis]) / dir[axis];
    for (plane, axis, name, side, colour) in [
        (0.0, 0, "e_x", Side::Left, "blue"),
        (3.0, 0, "f_x", Side::Right, "blue"),
        (0.0, 1, "e_y", Side::Below, "green"),
        (2.0, 1, "f_y", Side::Below, "green"),
    ] {
        let p = at(t(plane, axis));
        d.dot(p, colour);
        // Beside the plane, off the ray.
        let off = match side {
            Side::Left => w(0.0, 0.18),
            Side::Right => w(0.0, -0.18),
            _ => w(0.0, 0.0),
        };
        d.label(p + off, side, name, colour);
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
        [640.0, 240.0],
        [w(-0.9, -0.6), w(9.2, 3.1)],
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
    d.area(&rectangle(w(start, -0.2), w(end, 2.8)), "soft");
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

/// A ray to the left through a slab: which plane is the entry.
fn unswapped() -> String {
    let mut d = Drawing::new(
        [640.0, 200.0],
        [w(-0.4, -0.9), w(9.4, 1.5)],
        "A ray that goes to the left reaches the high plane first. Who takes the low plane for the entry gets an entry \
         after the exit, and misses the box.",
    );
    d.area(&rectangle(w(3.0, -0.4), w(5.5, 1.0)), "blue");
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
