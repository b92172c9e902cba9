//! The worked examples of Part 1.

use crate::{Numbers, check};
use kit::Vec3;

#[test]
fn task3() {
    let mut text = Numbers::default();
    let p0 = text.v(Vec3::ZERO);
    let p1 = text.v(Vec3::new(4.0, 0.0, 0.0));
    let p2 = text.v(Vec3::new(0.0, 4.0, 0.0));
    let o = text.v(Vec3::new(3.0, 3.0, 4.0));
    let d = text.v(Vec3::new(-1.0, -0.5, -2.0));
    let (e1, e2) = (text.v(p1 - p0), text.v(p2 - p0));
    let s = text.v(o - p0);
    // Independent of the derivation: volumes as determinants of columns.
    let volume = |a: Vec3, b: Vec3, c: Vec3| kit::Mat3::from_cols(a, b, c).determinant();
    let h = text.v(d.cross(e2));
    text.v(h);
    let det = text.n(volume(e1, d, e2));
    text.v(e1.cross(e2).normalize());
    text.v(h);
    text.n(volume(s, d, e2));
    text.n(det);
    let b1 = text.n(volume(s, d, e2) / det);
    let q = text.v(s.cross(e1));
    text.v(q);
    text.n(volume(d, s, e1));
    text.n(det);
    let b2 = text.n(volume(d, s, e1) / det);
    text.v(q);
    text.n(volume(e2, s, e1));
    text.n(det);
    let t = text.n(volume(e2, s, e1) / det);
    text.n(b1 + b2);
    text.v(o + t * d);
    text.v(b1 * p1 + b2 * p2);
    let n0 = text.v(Vec3::Z);
    let n1 = text.v(Vec3::new(0.6, 0.0, 0.8));
    let n2 = text.v(Vec3::new(0.0, 0.6, 0.8));
    let b0 = text.n(1.0 - b1 - b2);
    let mixed = text.v(b0 * n0 + b1 * n1 + b2 * n2);
    let length = text.n(mixed.length());
    text.v(mixed / length);
    check("part1/task3.md", text);
}
