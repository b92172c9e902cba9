//! Figures of Part 1: camera rays.

use super::parts::{Figure, w};
use crate::drawing::{Drawing, Side};
use kit::camera;

pub(super) fn figures() -> Vec<Figure> {
    vec![("part1-camera", camera()), ("part1-angles", angles())]
}

/// The camera from the side of its x axis and the sensor at z = -1.
fn camera() -> String {
    let mut d = Drawing::new(
        [600.0, 330.0],
        [w(-0.75, -0.85), w(2.2, 0.95)],
        "The camera seen from above: it looks along -z; the sensor at the distance 1 reaches from -a to a, where \
         a is the tangent of half the field of view.",
    );
    let a = camera::half_tan(70.0);
    // The page's x is -z of camera space, its y is -x: seen from above, with right downwards.
    d.area(&[w(0.0, 0.0), w(1.0, a), w(1.0, -a)], "soft");
    d.arrow(w(0.0, 0.0), w(2.1, 0.0), "soft");
    d.arrow(w(0.0, 0.0), w(-0.55, 0.0), "green");
    d.arrow(w(0.0, 0.0), w(0.0, -0.55), "green");
    d.line(w(0.0, 0.0), w(1.2, 1.2 * a), "soft dash");
    d.line(w(0.0, 0.0), w(1.2, -1.2 * a), "soft dash");
    d.line(w(1.0, a), w(1.0, -a), "blue");
    let q = w(1.0, -0.5 * a);
    d.arrow(w(0.0, 0.0), w(1.9, -0.95 * a), "ink");
    d.dot(q, "red");
    d.dot(w(0.0, 0.0), "ink");
    d.arc(w(0.0, 0.0), 0.38, w(1.0, a), w(1.0, 0.0), "red");
    d.label(w(0.39, 0.16), Side::Right, "α/2", "red");
    d.label(w(0.75, 0.0), Side::Below, "1", "ink");
    d.label(w(1.0, 0.5 * a), Side::Right, "a", "blue");
    d.note(w(1.0, a), Side::Above, "u = 0", "blue");
    d.note(w(1.0, -a), Side::Below, "u = 1", "blue");
    d.note(w(1.0, 0.07), Side::Right, "u = ½", "blue");
    d.label(q - w(0.09, 0.0), Side::Below, "q", "red");
    d.label(w(1.9, -0.95 * a), Side::Right, "d", "ink");
    d.label(w(-0.55, 0.0), Side::Above, "+z", "green");
    d.label(w(0.0, -0.55), Side::Left, "+x", "green");
    d.label(w(2.1, 0.0), Side::Above, "-z", "soft");
    d.finish()
}

/// Equal steps on the sensor and equal angles.
fn angles() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-3.6, -0.3), w(3.6, 1.3)],
        "Left: equal steps on the plane of the sensor, as it must be; the angles get smaller outwards. Right: \
         equal angles; their points on the plane get farther apart outwards, so straight lines appear curved.",
    );
    let half = camera::half_tan(110.0);
    for (centre, by_angle, words) in [
        (-1.9, false, "right: equal steps"),
        (1.9, true, "wrong: equal angles"),
    ] {
        let eye = w(centre, 0.0);
        d.line(eye + w(-half, 1.0), eye + w(half, 1.0), "blue");
        for k in -4..=4 {
            let share = f64::from(k) / 4.0;
            let x = if by_angle {
                kit::math::tan((share * 55.0).to_radians())
            } else {
                share * half
            };
            d.line(eye, eye + w(x, 1.0), "soft");
            d.dot(eye + w(x, 1.0), if by_angle { "red" } else { "green" });
        }
        d.dot(eye, "ink");
        d.note(eye, Side::Below, words, "ink");
    }
    d.finish()
}
