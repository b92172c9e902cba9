//! Figures of Part 1: triangles.

use super::parts::{Figure, w};
use crate::drawing::{Drawing, Side, View};
use kit::{Ray, Triangle, Vec2, Vec3};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part1-triangle", triangle()),
        ("part1-barycentric", barycentric()),
        ("part1-triangle-mistakes", triangle_mistakes()),
    ]
}

/// A ray that hits a triangle in space, with all symbols of the derivation.
fn triangle() -> String {
    let tri = Triangle::flat(Vec3::ZERO, 3.2 * Vec3::X, 2.6 * Vec3::Y);
    let (o, hit) = (Vec3::new(-1.1, 1.3, 2.6), Vec3::new(0.95, 0.75, 0.0));
    let ray = Ray::new(o, (hit - o) / 3.0);
    let view = View::from(Vec3::new(1.4, 1.0, 2.4), Vec3::Y);
    let (min, max) = (w(-2.3, -0.9), w(2.9, 2.3));
    let mut d = Drawing::new(
        [560.0, 400.0],
        [min, max],
        "A ray with the origin o and the direction d hits the triangle p0 p1 p2 at the distance t. \
         The edges e1 and e2 start at p0, and so does the vector s to the origin of the ray.",
    );
    let [p0, p1, p2, h, o] = [tri.p0, tri.p1, tri.p2, hit, ray.o].map(|p| view.of(p));
    d.polygon(&[p0, p1, p2], "blue");
    d.arrow(p0, p1, "blue");
    d.arrow(p0, p2, "blue");
    d.arrow(p0, o, "green dash");
    d.line(o, h, "ink dash");
    d.arrow(o, view.of(ray.at(1.0)), "ink");
    d.line(h, view.of(ray.at(3.7)), "soft");
    d.dot(h, "red");
    d.dot(o, "ink");
    d.label(p0, Side::Below, "p_0", "blue");
    d.label(p1, Side::Right, "p_1", "blue");
    d.label(p2, Side::Above, "p_2", "blue");
    d.label(0.5 * (p0 + p1), Side::Below, "e_1", "blue");
    d.label(p0 + 0.75 * (p2 - p0), Side::Left, "e_2", "blue");
    d.label(o, Side::Left, "o", "ink");
    d.label(view.of(ray.at(0.6)), Side::Above, "d", "ink");
    d.label(0.45 * (p0 + o), Side::Below, "s", "green");
    d.label(h, Side::Below, "p", "red");
    d.finish()
}

/// The plane of a triangle, divided by the signs of the three weights.
fn barycentric() -> String {
    let (p0, p1, p2) = (Vec2::ZERO, w(3.0, 0.0), w(0.6, 2.2));
    let at = |b1: f64, b2: f64| p0 + b1 * (p1 - p0) + b2 * (p2 - p0);
    let mut d = Drawing::new(
        [560.0, 380.0],
        [w(-1.6, -1.1), w(4.6, 3.1)],
        "The three lines through the edges of a triangle divide its plane into seven regions. Only \
         inside the triangle are all three weights b0, b1 and b2 at least 0.",
    );
    for (a, b) in [(p0, p1), (p1, p2), (p2, p0)] {
        let along = b - a;
        d.line(a - 0.42 * along, b + 0.42 * along, "soft dash");
    }
    d.polygon(&[p0, p1, p2], "blue");
    d.dot(at(0.25, 0.5), "red");
    d.label(at(0.25, 0.5), Side::Below, "(¼, ½)", "red");
    d.label(p0, Side::Left, "p_0", "blue");
    d.label(p1, Side::Below, "p_1", "blue");
    d.label(p2, Side::Left, "p_2", "blue");
    d.note(at(0.62, 0.72), Side::Right, "b0 < 0", "ink");
    d.note(at(-0.38, 0.45), Side::Left, "b1 < 0", "ink");
    d.note(at(0.55, -0.3), Side::Centre, "b2 < 0", "ink");
    d.note(at(0.3, 0.13), Side::Centre, "all ≥ 0: inside", "blue");
    d.finish()
}

/// The shapes that remain of a triangle if one of the three comparisons is missing.
fn triangle_mistakes() -> String {
    let (e1, e2) = (w(1.0, 0.0), w(0.25, 0.8));
    let mut d = Drawing::new(
        [640.0, 250.0],
        [w(-0.1, -0.5), w(6.6, 1.7)],
        "What a triangle becomes if a comparison of its weights is wrong: a wedge without b1 + b2 <= 1, \
         a parallelogram with b2 <= 1 instead, a wedge with its tip at p1 without b1 >= 0.",
    );
    let shape = |d: &mut Drawing, corner: Vec2, points: &[Vec2], words: &str| {
        let at = |w: &Vec2| corner + w.x * e1 + w.y * e2;
        let outline: Vec<Vec2> = points.iter().map(at).collect();
        d.area(&outline, "red");
        let tri = [Vec2::ZERO, Vec2::X, Vec2::Y].map(|w| at(&w));
        d.polygon(&tri, "blue");
        d.note(corner + w(0.5, -0.1), Side::Below, words, "ink");
    };
    shape(
        &mut d,
        Vec2::ZERO,
        &[
            w(0.0, 0.0),
            w(1.8, 0.0),
            w(1.8, 1.2),
            w(1.0, 2.0),
            w(0.0, 2.0),
        ],
        "without b1 + b2 ≤ 1",
    );
    shape(
        &mut d,
        w(2.5, 0.0),
        &[w(0.0, 0.0), w(1.0, 0.0), w(1.0, 1.0), w(0.0, 1.0)],
        "b1 ≤ 1 and b2 ≤ 1",
    );
    shape(
        &mut d,
        w(5.3, 0.0),
        &[w(-0.9, 0.0), w(1.0, 0.0), w(-0.9, 1.9)],
        "without b1 ≥ 0",
    );
    d.finish()
}
