//! Figures of Part 3: diffuse surfaces.

use super::parts::{Figure, rectangle, w};
use crate::drawing::{Drawing, Side, View, turn};
use kit::{PixelSampler, Vec2, Vec3, math};
use std::f64::consts::TAU;

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part3-scattering", scattering()),
        ("part3-lambert", lambert()),
        ("part3-malley", malley()),
        ("part3-disk", disk()),
    ]
}

/// Radiance from several directions is scattered towards the viewer.
fn scattering() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-3.6, -0.3), w(3.6, 2.4)],
        "Light Li arrives from many directions at a point of a surface; what is scattered to the viewer is Lo.",
    );
    d.line(w(-3.2, 0.0), w(3.2, 0.0), "ink");
    d.area(&rectangle(w(-3.2, -0.2), w(3.2, 0.0)), "soft");
    for k in [3, 8, 13, 22] {
        let direction = turn(k, 72);
        d.arrow(2.1 * direction, 0.25 * direction, "blue");
    }
    d.label(2.15 * turn(11, 72), Side::Right, "L_i", "blue");
    let out = turn(29, 72);
    d.arrow(0.2 * out, 2.2 * out, "red");
    d.label(2.2 * out, Side::Left, "L_o", "red");
    d.arrow(w(0.0, 0.0), w(0.0, 1.5), "green");
    d.note(w(0.0, 1.5), Side::Above, "normal", "green");
    d.dot(w(0.0, 0.0), "ink");
    d.finish()
}

/// Half a circle above the surface.
fn half_circle(centre: Vec2, radius: f64) -> Vec<Vec2> {
    (0..=36).map(|k| centre + radius * turn(k, 72)).collect()
}

/// The two directions at a diffuse surface, and its lobe.
fn lambert() -> String {
    let mut d = Drawing::new(
        [560.0, 320.0],
        [w(-1.7, -0.25), w(1.7, 1.4)],
        "A surface with its normal z, the direction wi to the light at the angle theta to the normal, and the \
         direction wo to the viewer. The inner circle is the density, in proportion to the cosine.",
    );
    d.line(w(-1.6, 0.0), w(1.6, 0.0), "ink");
    d.path(&half_circle(Vec2::ZERO, 1.0), "soft dash");
    // The cosine as a polar curve: a circle that touches the surface.
    d.circle(w(0.0, 0.5), 0.5, "blue");
    d.arrow(w(0.0, 0.0), w(0.0, 1.3), "green");
    let (wi, wo) = (turn(10, 72), turn(30, 72));
    d.arrow(w(0.0, 0.0), wi, "red");
    d.arrow(w(0.0, 0.0), wo, "ink");
    d.arc(w(0.0, 0.0), 0.4, wi, w(0.0, 1.0), "red");
    d.label(0.4 * turn(14, 72), Side::Above, "θ_i", "red");
    d.label(wi, Side::Right, "ω_i", "red");
    d.label(wo, Side::Left, "ω_o", "ink");
    d.label(w(0.0, 1.3), Side::Right, "z", "green");
    d.label(w(-0.45, 0.75), Side::Above, "p", "blue");
    d.finish()
}

/// Uniform points on a disk and above them on the hemisphere.
fn malley() -> String {
    let mut d = Drawing::new(
        [620.0, 380.0],
        [w(-1.35, -0.55), w(1.35, 1.1)],
        "Points that are uniform on the unit disk, lifted to the hemisphere: they are dense around the normal and \
         rare at the horizon.",
    );
    let view = View::from(Vec3::new(0.3, -2.0, 0.75), Vec3::Z);
    let circle: Vec<Vec2> = (0..=72).map(|k| view.of(turn(k, 72).extend(0.0))).collect();
    d.area(&circle[..72], "blue");
    d.path(&circle, "blue");
    let meridian = |from: Vec2| {
        let at = |k: u32| {
            let t = turn(k, 72);
            view.of((t.x * from).extend(t.y))
        };
        (0..=36).map(at).collect::<Vec<_>>()
    };
    for k in [0, 9, 18, 27] {
        d.path(&meridian(turn(k, 72)), "soft");
    }
    let mut sampler = PixelSampler::new(0, 0, 4);
    for k in 0..90 {
        let u = sampler.get_sample();
        let p = u.x.sqrt() * Vec2::new(math::cos(TAU * u.y), math::sin(TAU * u.y));
        let lifted = p.extend((1.0 - u.x).sqrt());
        if k % 9 == 0 {
            d.line(view.of(p.extend(0.0)), view.of(lifted), "green dash");
            d.dot(view.of(p.extend(0.0)), "blue");
        }
        d.dot(view.of(lifted), if k % 9 == 0 { "green" } else { "red" });
    }
    d.arrow(view.of(Vec3::Z), view.of(1.3 * Vec3::Z), "ink");
    d.label(view.of(1.3 * Vec3::Z), Side::Right, "z", "ink");
    d.finish()
}

/// Points on a disk with a uniform radius, and with its square root.
fn disk() -> String {
    let mut d = Drawing::new(
        [620.0, 320.0],
        [w(-2.4, -1.3), w(2.4, 1.1)],
        "Left: with the square root the points are uniform on the disk. Right: without it they crowd in the middle.",
    );
    for (centre, root, words) in [
        (-1.25, true, "r = √u: uniform"),
        (1.25, false, "r = u: crowded"),
    ] {
        let mut sampler = PixelSampler::new(0, 0, 9);
        d.circle(w(centre, 0.0), 1.0, "soft");
        let points = (0..300).map(|_| {
            let u = sampler.get_sample();
            let r = if root { u.x.sqrt() } else { u.x };
            let (sin, cos) = math::sin_cos(TAU * u.y);
            w(centre, 0.0) + r * w(cos, sin)
        });
        d.dots(
            &points.collect::<Vec<_>>(),
            if root { "green" } else { "red" },
        );
        d.note(w(centre, -1.05), Side::Below, words, "ink");
    }
    d.finish()
}
