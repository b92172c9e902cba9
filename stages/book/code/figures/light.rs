//! Figures of the chapter about light.

use super::parts::{Figure, w};
use crate::drawing::{Drawing, Side};
use kit::Vec2;

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("light-solid-angle", solid_angle()),
        ("light-cosine", cosine()),
        ("light-equation", equation()),
    ]
}

/// A lamp above a point, and the part of the unit circle that it covers.
fn solid_angle() -> String {
    let mut d = Drawing::new(
        [640.0, 320.0],
        [w(-2.6, -0.3), w(3.6, 2.7)],
        "A floor with the point x and its normal n, seen from the side. Around x is the upper half of the unit sphere. A \
         lamp of the area A hangs at the distance r, inclined. The lines from x to its ends cut an arc out of the \
         sphere: the solid angle of the lamp. The angle between the line and the lamp's normal is theta l.",
    );
    let (centre, along) = (w(1.5, 2.0), w(0.6, -0.25));
    let ends = [centre - along, centre + along];
    let arc = ends.map(Vec2::normalize);
    d.line(w(-2.6, 0.0), w(3.6, 0.0), "ink");
    d.arc(Vec2::ZERO, 1.0, w(1.0, 0.0), w(0.0, 1.0), "soft");
    d.arc(Vec2::ZERO, 1.0, w(0.0, 1.0), w(-1.0, 0.0), "soft");
    d.area(&[Vec2::ZERO, ends[0], ends[1]], "blue");
    for end in ends {
        d.line(Vec2::ZERO, end, "blue dash");
    }
    d.arc(Vec2::ZERO, 1.0, arc[0], arc[1], "red");
    d.line(ends[0], ends[1], "green");
    d.arrow(Vec2::ZERO, w(0.0, 1.6), "ink");
    d.line(Vec2::ZERO, centre, "ink");
    let normal = centre + 0.6 * w(along.y, -along.x).normalize();
    d.arrow(centre, normal, "green");
    d.arc(
        centre,
        0.45,
        -centre.normalize(),
        (normal - centre).normalize(),
        "green",
    );
    d.dot(Vec2::ZERO, "ink");
    d.label(Vec2::ZERO, Side::Below, "x", "ink");
    d.label(w(0.0, 1.6), Side::Left, "n", "ink");
    d.label(ends[1], Side::Right, "A", "green");
    d.label(0.72 * centre, Side::Left, "r", "ink");
    d.label(arc[0], Side::Left, "Ω", "red");
    d.label(normal, Side::Below, "θ_l", "green");
    d.note(w(-1.0, 0.0), Side::Below, "1", "soft");
    d.finish()
}

/// The same beam on a floor, at a right angle and at 60 degrees.
fn cosine() -> String {
    let mut d = Drawing::new(
        [640.0, 230.0],
        [w(-1.2, -0.4), w(6.2, 1.9)],
        "Two beams of the same width meet a floor. The left one comes straight down and lights a piece as wide as \
         itself. The right one comes in at 60 degrees to the normal and lights a piece twice as wide.",
    );
    d.line(w(-1.2, 0.0), w(6.2, 0.0), "ink");
    let (sin, cos) = kit::math::sin_cos(std::f64::consts::FRAC_PI_3);
    for (middle, from, half) in [
        (w(0.0, 0.0), w(0.0, 1.0), 0.5),
        (w(3.4, 0.0), w(sin, cos), 0.5 / cos),
    ] {
        let ends = [middle - w(half, 0.0), middle + w(half, 0.0)];
        let far = |p: Vec2| p + (1.7 / from.y.max(0.75)) * from;
        d.area(&[ends[0], ends[1], far(ends[1]), far(ends[0])], "blue");
        d.arrow(far(middle), middle, "blue");
        d.line(ends[0], ends[1], "red");
        d.line(middle, middle + w(0.0, 1.3), "ink dash");
        d.label(middle + w(0.0, 1.3), Side::Left, "n", "ink");
        let wide = format!("{:.0}", 2.0 * half);
        d.note(middle, Side::Below, &wide, "red");
    }
    d.arc(w(3.4, 0.0), 0.6, w(0.0, 1.0), w(sin, cos), "ink");
    d.label(w(3.72, 0.62), Side::Above, "θ_i", "ink");
    d.finish()
}

/// The surface points, the directions and the radiances of the rendering equation.
fn equation() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-3.0, -0.4), w(3.6, 2.6)],
        "A floor with the point x and a wall with the point y. From x, the direction omega i points to y and the \
         direction omega o to the eye. Light comes from y against omega i, and leaves x along omega o.",
    );
    let (x, y, eye) = (Vec2::ZERO, w(3.0, 1.9), w(-2.3, 1.7));
    d.line(w(-3.0, 0.0), w(3.0, 0.0), "ink");
    d.line(w(3.0, 0.0), w(3.0, 2.6), "ink");
    d.line(x, y, "blue dash");
    d.arrow(x, 0.45 * y, "blue");
    d.arrow(0.95 * y + w(-0.05, 0.12), 0.58 * y + w(-0.05, 0.12), "red");
    d.arrow(x, 0.5 * eye, "green");
    d.line(0.5 * eye, eye, "green dash");
    d.arrow(x, w(0.0, 1.4), "ink");
    d.arc(x, 0.55, w(0.0, 1.0), y.normalize(), "ink");
    d.dot(x, "ink");
    d.dot(y, "ink");
    d.label(x, Side::Below, "x", "ink");
    d.label(y, Side::Right, "y", "ink");
    d.label(w(0.0, 1.4), Side::Left, "n", "ink");
    d.label(0.4 * y + w(0.1, -0.1), Side::Right, "ω_i", "blue");
    d.label(0.42 * eye, Side::Below, "ω_o", "green");
    d.label(w(0.28, 0.5), Side::Above, "θ_i", "ink");
    d.label(0.76 * y + w(-0.1, 0.1), Side::Above, "L_i", "red");
    d.label(0.85 * eye, Side::Above, "L_o", "green");
    d.note(eye, Side::Left, "eye", "green");
    d.finish()
}
