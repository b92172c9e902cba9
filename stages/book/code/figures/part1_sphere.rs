//! Figures of Part 1: spheres.

use super::parts::{Figure, log10, w};
use crate::drawing::{Drawing, Side};
use kit::{Sphere, Vec2, Vec3};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part1-sphere", sphere()),
        ("part1-roots", roots()),
        ("part1-cancellation", cancellation()),
    ]
}

/// A sphere, cut in the plane of the ray.
fn sphere() -> String {
    let ball = Sphere {
        center: Vec3::ZERO,
        radius: 1.5,
    };
    let (height, start) = (0.9, -4.2);
    let half_chord = (ball.radius * ball.radius - height * height).sqrt();
    let mut d = Drawing::new(
        [640.0, 330.0],
        [w(-4.4, -1.7), w(2.9, 1.9)],
        "The line of the ray passes the centre m at the distance l and meets the sphere at t1 and t2. The middle \
         of both is b/a. The vector f goes from the centre to the origin o; the normal n points outwards.",
    );
    d.circle(Vec2::ZERO, ball.radius, "blue");
    let o = w(start, height);
    d.line(w(-4.2, height), w(2.8, height), "soft");
    d.arrow(o, w(start + 1.2, height), "ink");
    d.arrow(Vec2::ZERO, o, "green dash");
    d.line(Vec2::ZERO, w(0.0, height), "ink dash");
    let hit = w(-half_chord, height);
    d.line(Vec2::ZERO, hit, "blue");
    d.arrow(hit, hit + 0.75 * hit.normalize(), "red");
    for p in [hit, w(half_chord, height)] {
        d.dot(p, "red");
    }
    d.dot(w(0.0, height), "ink");
    d.dot(o, "ink");
    d.dot(Vec2::ZERO, "blue");
    d.label(o, Side::Above, "o", "ink");
    d.label(w(start + 0.8, height), Side::Above, "d", "ink");
    d.label(0.55 * o, Side::Below, "f", "green");
    d.label(Vec2::ZERO, Side::Below, "m", "blue");
    d.label(0.45 * hit, Side::Left, "r", "blue");
    d.label(w(0.0, 0.5 * height), Side::Right, "ℓ", "ink");
    d.label(hit + w(0.3, 0.0), Side::Above, "t_1", "red");
    d.label(w(half_chord + 0.2, height), Side::Above, "t_2", "red");
    d.note(w(0.0, height), Side::Above, "t = b/a", "ink");
    d.label(hit + 0.75 * hit.normalize(), Side::Left, "n", "red");
    d.finish()
}

/// Rays that start before, inside and behind a sphere, and one whose range starts inside.
fn roots() -> String {
    let mut d = Drawing::new(
        [640.0, 280.0],
        [w(-4.6, -1.7), w(4.9, 1.6)],
        "Four rays through a sphere: from outside the near root is the hit; from inside and with a range that begins \
         between the roots it is the far one; from behind the sphere there is none.",
    );
    d.circle(Vec2::ZERO, 1.4, "blue");
    let rows = [
        (0.9, -4.0, -4.0, "outside"),
        (0.3, -0.4, -0.4, "inside"),
        (-0.3, -4.0, 0.1, "begins inside"),
        (-0.9, 2.2, 2.2, "behind"),
    ];
    for (y, start, begin, words) in rows {
        let half = f64::sqrt(1.4 * 1.4 - y * y);
        let at = |x: f64| w(x, y);
        if begin > start {
            d.line(at(start), at(begin), "soft dash");
        }
        d.arrow(at(begin), at(3.4), "ink");
        d.dot(at(start), "ink");
        let hit = [-half, half].into_iter().find(|x| *x >= begin);
        for x in [-half, half] {
            d.circle(at(x), 0.07, "soft");
        }
        if let Some(x) = hit {
            d.dot(at(x), "red");
        }
        d.note(at(3.4), Side::Right, words, "ink");
    }
    d.finish()
}

/// Powers of ten: the distances of [`TEXTBOOK`] and [`HAINES`], in radii.
pub const EXPONENTS: [i32; 9] = [1, 2, 3, 4, 5, 6, 7, 8, 9];

/// The median relative error of the squared half chord from b² - ac, over rays in random directions.
/// `tests/numbers/sphere_error.rs` measures it.
pub const TEXTBOOK: [f64; 9] = [
    1.9e-14, 1.6e-12, 2e-10, 2e-8, 2e-6, 1.7e-4, 1.6e-2, 2.8, 220.0,
];

/// The same from r² - ℓ².
pub const HAINES: [f64; 9] = [
    1.7e-16, 2.4e-15, 2.7e-14, 2.2e-13, 2.8e-12, 2.3e-11, 2.6e-10, 2.5e-9, 2.7e-8,
];

/// The relative error of the squared half chord of a sphere of radius 1, against its distance.
fn cancellation() -> String {
    let mut d = Drawing::graph(
        [640.0, 330.0],
        [w(0.0, -17.0), w(10.0, 1.0)],
        "The relative error of the squared half chord from b*b - a*c grows with the square of the distance, \
         from 10 to the power of -14 at 10 radii to 1 at 10 to the power of 8. From r*r - l*l it grows with the distance, \
         from 10 to the power of -16 to 10 to the power of -8.",
    );
    let curve = |errors: &[f64]| -> Vec<Vec2> {
        let points = EXPONENTS.iter().zip(errors);
        points
            .map(|(exponent, error)| w(f64::from(*exponent), log10(error.min(10.0))))
            .collect()
    };
    let (textbook, stable) = (curve(&TEXTBOOK), curve(&HAINES));
    let levels = [-16, -12, -8, -4, 0].map(|power| (f64::from(power), format!("1e{power}")));
    d.levels([1.0, 9.5], levels);
    for power in [1, 3, 5, 7, 9] {
        let below = w(f64::from(power), -16.6);
        d.note(below, Side::Below, format!("1e{power}"), "ink");
    }
    d.path(&textbook, "red");
    d.path(&stable, "green");
    d.note(w(4.3, -6.0), Side::Left, "b·b - a·c", "red");
    d.note(w(6.5, -14.7), Side::Above, "r·r - ℓ·ℓ", "green");
    d.note(w(9.5, -15.4), Side::Above, "distance", "ink");
    d.note(w(1.0, 0.9), Side::Right, "relative error of Δ/a", "ink");
    d.finish()
}
