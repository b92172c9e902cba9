//! Figures of Part 3: direct light.

use super::parts::{Figure, log10, rectangle, w};
use crate::drawing::{Drawing, Side};
use kit::{PixelSampler, Tally, Vec2, Vec3, warp};
use std::f64::consts::{FRAC_1_PI, TAU};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part3-hemisphere", hemisphere()),
        ("part3-noise", noise()),
        ("part3-acne", acne()),
        ("part3-light", light()),
        ("part3-shadow-rays", shadow_rays()),
    ]
}

/// Uniform directions from a point; few meet the lamp.
fn hemisphere() -> String {
    let mut d = Drawing::new(
        [640.0, 340.0],
        [w(-2.6, -0.25), w(2.6, 2.3)],
        "Uniform directions above a point. Only those that meet the lamp bring light; all others are black.",
    );
    d.line(w(-2.5, 0.0), w(2.5, 0.0), "ink");
    let (left, right, height) = (-0.5, 0.5, 2.0);
    d.line(w(left, height), w(right, height), "red");
    d.area(&[w(0.0, 0.0), w(left, height), w(right, height)], "red");
    let mut sampler = PixelSampler::new(0, 0, 6);
    for _ in 0..22 {
        // In the plane: the direction's height and its horizontal part.
        let v = warp::uniform_hemisphere(sampler.get_sample());
        let flat = w(v.x.signum() * (v.x * v.x + v.y * v.y).sqrt(), v.z);
        let meets = (flat.x / flat.y * height).abs() < right;
        let end = if meets { height / flat.y } else { 1.5 };
        d.arrow(w(0.0, 0.0), end * flat, if meets { "red" } else { "soft" });
    }
    d.dot(w(0.0, 0.0), "ink");
    d.label(w(right, height), Side::Right, "L", "red");
    d.label(w(0.0, height), Side::Above, "Ω_l", "red");
    d.note(w(1.9, 0.25), Side::Above, "black", "soft");
    d.finish()
}

/// What the lamp of the worked example sends to the floor by one sample: uniform directions.
fn by_hemisphere(u: Vec2) -> f64 {
    let v = warp::uniform_hemisphere(u);
    let there = 2.0 / v.z * v;
    if there.x.abs() <= 0.5 && there.y.abs() <= 0.5 {
        0.8 * FRAC_1_PI * 10.0 * v.z * TAU
    } else {
        0.0
    }
}

/// The same by a point of the lamp.
fn by_light(u: Vec2) -> f64 {
    let q = Vec3::new(u.x - 0.5, u.y - 0.5, 2.0);
    let cos = q.z / q.length();
    0.8 * FRAC_1_PI * 10.0 * cos * cos / q.length_squared()
}

/// Root mean square error, relative to the exact value, against the number of samples.
fn noise() -> String {
    let mut d = Drawing::graph(
        [640.0, 330.0],
        [w(-0.6, -3.0), w(3.9, 1.2)],
        "Relative error against the number of samples on logarithmic axes: uniform directions begin at 5, points \
         of the lamp at 0.05; both fall as the square root of the number of samples.",
    );
    let counts = [1_u32, 4, 16, 64, 256, 1024];
    // The mean of all samples of all pixels is the exact value up to a small error.
    let mut exact = Tally::default();
    let mut fine = PixelSampler::new(0, 0, 77);
    for _ in 0..20_000 {
        exact.push(by_light(fine.get_sample()));
    }
    for (estimate, colour, words) in [
        (
            by_hemisphere as fn(Vec2) -> f64,
            "red",
            "uniform directions",
        ),
        (by_light, "green", "points of the lamp"),
    ] {
        let mut points = Vec::new();
        for n in counts {
            let mut squares = Tally::default();
            for pixel in 0..400 {
                let mut sampler = PixelSampler::new(pixel, n, 1);
                let mean: Tally = (0..n).map(|_| estimate(sampler.get_sample())).collect();
                let error = mean.mean() / exact.mean() - 1.0;
                squares.push(error * error);
            }
            points.push(w(log10(f64::from(n)), log10(squares.mean().sqrt())));
        }
        d.marked_path(&points, colour);
        d.note(points[2] + w(0.1, 0.3), Side::Right, words, colour);
    }
    let levels = [(-3.0, "0.001"), (-2.0, "0.01"), (-1.0, "0.1"), (0.0, "1")];
    d.levels([0.0, 3.3], levels);
    for n in counts {
        d.note(w(log10(f64::from(n)), -3.0), Side::Below, n, "ink");
    }
    d.note(w(3.3, -2.9), Side::Above, "samples", "ink");
    d.note(w(-0.4, 1.1), Side::Right, "relative error", "ink");
    d.finish()
}

/// A rounded hit point below the surface, with and without an offset.
fn acne() -> String {
    let mut d = Drawing::new(
        [640.0, 230.0],
        [w(-1.0, -0.8), w(9.3, 2.0)],
        "Left: the rounded hit point lies below the surface, and the ray that starts there hits the surface at once. \
         Right: the ray starts above it, by more than the error.",
    );
    for (x, starts_above) in [(0.0, false), (5.0, true)] {
        d.line(w(x, 0.0), w(x + 4.0, 0.0), "ink");
        d.area(&rectangle(w(x, -0.5), w(x + 4.0, 0.0)), "soft");
        let hit = w(x + 1.6, -0.28);
        let start = if starts_above { w(x + 1.6, 0.28) } else { hit };
        let direction = w(0.75, 0.66);
        d.dot(hit, "ink");
        if starts_above {
            d.line(hit, start, "soft dash");
            d.arrow(start, start + 1.9 * direction, "green");
            d.dot(start, "green");
            d.note(start + 1.9 * direction, Side::Right, "leaves", "green");
        } else {
            let blocked = start + (0.28 / 0.66) * direction;
            d.line(blocked, start + 1.9 * direction, "soft dash");
            d.line(start, blocked, "red");
            d.dot(blocked, "red");
            d.note(
                blocked + w(-0.1, 0.25),
                Side::Left,
                "blocked by its own surface",
                "red",
            );
        }
        d.note(hit, Side::Left, "hit point", "ink");
    }
    d.finish()
}

/// A point of a surface and a point of a lamp, with both cosines.
fn light() -> String {
    let mut d = Drawing::new(
        [600.0, 360.0],
        [w(-1.6, -0.5), w(4.0, 2.9)],
        "The point x of a surface and the point q of a lamp at the distance r, with the angle to the normal at each \
         end. The area A of the lamp covers a solid angle.",
    );
    let (x, q) = (w(0.0, 0.0), w(2.0, 2.0));
    let along = w(0.92, -0.39);
    let normal = w(-0.39, -0.92);
    d.line(w(-1.4, 0.0), w(2.2, 0.0), "ink");
    d.area(&[x, q - 0.8 * along, q + 0.8 * along], "red");
    d.line(q - 0.8 * along, q + 0.8 * along, "red");
    d.arrow(x, w(0.0, 1.5), "green");
    d.arrow(q, q + normal, "green");
    d.line(x, q, "ink dash");
    let direction = (q - x).normalize();
    d.arrow(x, 1.2 * direction, "ink");
    d.arc(x, 0.6, direction, w(0.0, 1.0), "blue");
    d.arc(q, 0.5, -direction, normal, "blue");
    d.label(w(0.2, 0.62), Side::Above, "θ_i", "blue");
    d.label(q + normal, Side::Below, "θ_l", "blue");
    d.label(x, Side::Below, "x", "ink");
    d.label(q, Side::Above, "q", "red");
    d.label(q + 0.8 * along, Side::Right, "A", "red");
    d.label(1.2 * direction, Side::Right, "ω_i", "ink");
    d.label(w(1.05, 1.15), Side::Left, "r", "ink");
    d.dot(x, "ink");
    d.dot(q, "red");
    d.finish()
}

/// A shadow ray that ends too late, one that ends at the lamp, and the right one.
fn shadow_rays() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-0.6, -0.7), w(9.6, 4.0)],
        "Three shadow rays from a surface to a lamp: one that goes on behind the lamp and hits the ceiling, one that \
         reaches the lamp itself, and one that ends just before it.",
    );
    d.line(w(-0.4, 0.0), w(9.4, 0.0), "ink");
    d.line(w(-0.4, 3.5), w(9.4, 3.5), "ink");
    for (x, end, colour, words) in [
        (1.2, 3.5, "red", "too long: the ceiling blocks"),
        (4.6, 2.6, "red", "to the lamp: it blocks"),
        (8.0, 2.45, "green", "right: just before it"),
    ] {
        d.line(w(x - 0.8, 2.6), w(x + 0.8, 2.6), "blue");
        d.arrow(w(x, 0.0), w(x, end), colour);
        d.dot(w(x, 0.0), "ink");
        d.note(w(x, 0.0), Side::Below, words, colour);
    }
    d.note(w(9.0, 2.6), Side::Right, "lamp", "blue");
    d.finish()
}
