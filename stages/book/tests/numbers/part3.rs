//! The worked examples of Part 3.

use super::{Numbers, check};
use kit::Vec3;
use std::f64::consts::{PI, TAU};

#[test]
fn task1() {
    let mut text = Numbers::default();
    let rho = text.v(Vec3::new(0.9, 0.5, 0.0));
    let f = text.v(rho / PI);
    let u = [text.n(0.25), text.n(0.125)];
    text.n(u[0]);
    let r = text.n(u[0].sqrt());
    text.n(2.0);
    text.n(u[1]);
    let turn = text.n(TAU * u[1]);
    let (x, y) = (text.n(r * turn.cos()), text.n(r * turn.sin()));
    text.n(1.0 - u[0]);
    let z = text.n((1.0 - x * x - y * y).sqrt());
    text.n(z);
    let p = text.n(z / PI);
    text.v(f * (z / p));
    check("part3/task1.md", text);
}

/// Irradiance of a facing square of edge `a` and radiance 1, centred at height `h`: π times the
/// configuration factor of four quarters (Howell, B-3).
fn square_lamp(a: f64, h: f64) -> f64 {
    let x = 0.5 * a / h;
    let root = (1.0 + x * x).sqrt();
    let quarter = (x / root) * (x / root).atan() / PI;
    4.0 * quarter * PI
}

#[test]
fn task2() {
    let mut text = Numbers::default();
    let rho = text.n(0.8);
    let a = text.n(1.0);
    let h = text.n(2.0);
    let radiance = text.n(10.0);
    // The solid angle of a square pyramid.
    let omega = text.n(4.0 * (a * a / (4.0 * h * (h * h + 0.5 * a * a).sqrt())).atan());
    text.n(2.0);
    text.n(TAU);
    let q = text.n(omega / TAU);
    text.n(1.0);
    text.n(((1.0 - q) / q).sqrt());
    let cos = text.n(0.98);
    text.n(2.0);
    text.n(rho);
    text.n(radiance);
    text.n(cos);
    for _ in 0..3 {
        text.n(0.0);
    }
    text.n(4.0);
    let estimate = text.n(TAU * rho / PI * radiance * cos / 4.0);
    let exact = text.n(rho / PI * radiance * square_lamp(a, h));
    assert!((6.5..7.0).contains(&(estimate / exact)), "almost seven");
    text.n(1.0);
    text.n((1.0 - q).powi(4));
    text.n(0.0);
    check("part3/task2.md", text);
}

#[test]
fn task3() {
    let mut text = Numbers::default();
    let x = text.v(Vec3::ZERO);
    let normal = text.v(Vec3::Z);
    let rho = text.n(0.8);
    let h = text.n(2.0);
    let area = text.n(1.0);
    let radiance = text.n(10.0);
    let q = text.v(Vec3::new(0.3, 0.4, h));
    text.n((q - x).length_squared());
    let r = text.n((q - x).length());
    let wi = text.v((q - x) / r);
    let cos = text.n(wi.dot(normal));
    text.n(r * r);
    text.n(cos);
    let p = text.n(r * r / (area * cos));
    text.n(rho / PI);
    text.n(radiance);
    text.n(cos);
    text.n(p);
    let estimate = text.n(rho / PI * radiance * cos / p);
    let exact = text.n(rho / PI * radiance * square_lamp(1.0, h));
    text.n((100.0 * (1.0 - estimate / exact)).round());
    check("part3/task3.md", text);
}
