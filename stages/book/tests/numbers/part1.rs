//! The worked examples of Part 1.

use super::{Numbers, check};
use kit::{Mat3, Vec2, Vec3};

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
    let volume = |a: Vec3, b: Vec3, c: Vec3| Mat3::from_cols(a, b, c).determinant();
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

#[test]
fn task1() {
    let mut text = Numbers::default();
    let (w, h) = (text.n(4.0), text.n(2.0));
    let (x, y) = (text.n(3.0), text.n(1.0));
    for (pixel, size) in [(x, w), (y, h)] {
        text.n(pixel);
        text.n(0.5);
        text.n(size);
        text.n((pixel + 0.5) / size);
    }
    let samples = [Vec2::new(0.25, 0.5), Vec2::new(0.75, 0.25)];
    for s in samples {
        text.p(s);
    }
    for s in samples {
        let film = text.n(x + s.x) / text.n(w);
        let height = text.n(y + s.y) / text.n(h);
        text.p(Vec2::new(film, height));
    }
    let radiances = [text.n(0.2), text.n(3.0)];
    let sum = text.n(radiances[0]) + text.n(radiances[1]);
    text.n(2.0);
    text.n(sum / 2.0);
    let white = text.n(1.0);
    text.n(radiances.map(|l| l.min(white)).iter().sum::<f64>() / 2.0);
    check("part1/task1.md", text);
}

#[test]
fn task2() {
    let mut text = Numbers::default();
    let (alpha, beta) = (text.n(90.0), text.n(60.0));
    text.n(0.5 * alpha);
    let a = text.n((0.5 * alpha).to_radians().tan());
    text.n(0.5 * beta);
    let b = text.n((0.5 * beta).to_radians().tan());
    text.v(Vec3::new(0.0, 1.0, 5.0));
    let right = text.v(Vec3::Z);
    let up = text.v(Vec3::Y);
    let backward = text.v(-Vec3::X);
    let (u, v) = (text.n(0.75), text.n(0.5));
    text.n(2.0);
    text.n(u);
    text.n(1.0);
    text.n(2.0);
    text.n(v);
    text.n(1.0);
    text.n(-1.0);
    let q = text.v(Vec3::new((2.0 * u - 1.0) * a, (2.0 * v - 1.0) * b, -1.0));
    text.n(q.x);
    text.n(q.y);
    text.n(-q.z);
    let direction = text.v(q.x * right + q.y * up + q.z * backward);
    let square = text.n(direction.dot(direction));
    let length = text.n(square.sqrt());
    text.v(direction / length);
    check("part1/task2.md", text);
}

#[test]
fn task4() {
    let mut text = Numbers::default();
    let m = text.v(Vec3::new(0.0, 0.0, -5.0));
    let r = text.n(2.0);
    let o = text.v(Vec3::new(1.0, 0.0, 1.0));
    let d = text.v(Vec3::new(0.0, 0.0, -2.0));
    let f = text.v(o - m);
    let a = text.n(d.dot(d));
    let b = text.n(-f.dot(d));
    text.n(f.dot(f));
    text.n(r * r);
    let c = text.n(f.dot(f) - r * r);
    text.n(b * b);
    text.n(a * c);
    let disc = text.n(b * b - a * c);
    let root = text.n(disc.sqrt());
    let mut t = [0.0; 2];
    for (t, sign) in t.iter_mut().zip([-1.0, 1.0]) {
        text.n(b);
        text.n(root);
        text.n(a);
        *t = text.n((b + sign * root) / a);
    }
    let middle = text.n(b / a);
    let distance = text.n((o + middle * d - m).length());
    text.n(disc / a);
    text.n(r * r);
    text.n(distance * distance);
    let near = text.v(o + t[0] * d);
    text.v((near - m) / r);
    text.n(2.5);
    let far = text.v(o + t[1] * d);
    text.v((far - m) / r);
    check("part1/task4.md", text);
}
