//! Figures of Part 4.

use super::parts::{Figure, graph, rectangle, w};
use crate::drawing::{Drawing, Side, turn};
use kit::{PixelSampler, math};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part4-path", path()),
        ("part4-snell", snell()),
        ("part4-mistakes", mistakes()),
        ("part4-fresnel", fresnel()),
        ("part4-series", series()),
        ("part4-roulette", roulette()),
        ("part4-game", game()),
    ]
}

/// A path in a room, with a shadow ray to the lamp from each surface.
fn path() -> String {
    let mut d = Drawing::new(
        [640.0, 370.0],
        [w(-1.6, -0.3), w(5.6, 3.4)],
        "A path from the camera: it hits the floor at x1, a wall at x2 and the other wall at x3. From each of them \
         a shadow ray goes to the lamp at the ceiling.",
    );
    d.path(
        &[
            w(-0.2, 3.2),
            w(-0.2, 0.0),
            w(5.2, 0.0),
            w(5.2, 3.2),
            w(-0.2, 3.2),
        ],
        "ink",
    );
    let lamp = w(2.6, 3.2);
    d.line(lamp - w(0.5, 0.0), lamp + w(0.5, 0.0), "red");
    d.area(
        &[
            lamp - w(0.5, 0.0),
            lamp + w(0.5, 0.0),
            lamp + w(0.4, -0.12),
            lamp + w(-0.4, -0.12),
        ],
        "red",
    );
    let camera = w(-1.3, 1.3);
    let points = [w(1.7, 0.0), w(5.2, 1.5), w(-0.2, 2.1)];
    let names = [
        ("x_1", Side::Below),
        ("x_2", Side::Right),
        ("x_3", Side::Left),
    ];
    let mut from = camera;
    for (p, (name, side)) in points.into_iter().zip(names) {
        d.arrow(from, p, "blue");
        d.line(p, lamp, "red dash");
        d.label(p, side, name, "blue");
        from = p;
    }
    for p in points {
        d.dot(p, "blue");
    }
    d.dot(camera, "ink");
    d.note(camera, Side::Below, "camera", "ink");
    d.note(lamp, Side::Above, "lamp", "red");
    d.label(w(3.6, 0.6), Side::Below, "β_2 = w_1", "blue");
    d.label(w(3.2, 1.62), Side::Below, "β_3 = w_1 w_2", "blue");
    d.finish()
}

/// The directions of mirror and refraction for an index of 1.5.
fn snell() -> String {
    let mut d = Drawing::new(
        [560.0, 400.0],
        [w(-1.5, -1.4), w(1.5, 1.4)],
        "A boundary with glass below. The direction to the viewer, the mirrored direction at the same angle, and \
         the refracted direction at a smaller angle on the other side.",
    );
    d.area(&rectangle(w(-1.5, -1.4), w(1.5, 0.0)), "blue");
    d.line(w(-1.5, 0.0), w(1.5, 0.0), "ink");
    d.arrow(w(0.0, 0.0), w(0.0, 1.3), "green");
    d.line(w(0.0, 0.0), w(0.0, -1.3), "soft dash");
    let sin = 0.75;
    let up = |s: f64| w(s, (1.0 - s * s).sqrt());
    let wo = up(-sin);
    let mirrored = up(sin);
    let refracted = -up(-sin / 1.5);
    d.arrow(w(0.0, 0.0), 1.2 * wo, "ink");
    d.arrow(w(0.0, 0.0), 1.2 * mirrored, "blue");
    d.arrow(w(0.0, 0.0), 1.2 * refracted, "red");
    d.arc(w(0.0, 0.0), 0.45, wo, w(0.0, 1.0), "ink");
    d.arc(w(0.0, 0.0), 0.45, refracted, w(0.0, -1.0), "red");
    d.label(0.5 * turn(44, 144), Side::Above, "θ_o", "ink");
    d.label(w(0.17, -0.45), Side::Below, "θ_i", "red");
    d.label(1.2 * wo, Side::Left, "ω_o", "ink");
    d.label(1.2 * mirrored, Side::Right, "ω_i", "blue");
    d.note(1.2 * mirrored - w(0.0, 0.05), Side::Below, "mirror", "blue");
    d.label(1.2 * refracted, Side::Right, "ω_i", "red");
    d.note(1.2 * refracted, Side::Left, "refraction", "red");
    d.label(w(0.0, 1.3), Side::Right, "m", "green");
    d.label(w(-1.5, 0.12), Side::Right, "n_o = 1", "ink");
    d.label(w(-1.5, -0.15), Side::Right, "n_i = 1.5", "ink");
    d.finish()
}

/// The reflected fraction for glass against the angle, from outside and from inside.
fn fresnel() -> String {
    let fraction = |degrees: f64, eta: f64| {
        let (sin, cos) = math::sin_cos(degrees.to_radians());
        let sin_t = eta * sin;
        if sin_t >= 1.0 || cos <= 0.0 {
            return 1.0;
        }
        // The two amplitudes by Fresnel's sine and tangent laws.
        let (a, b) = (
            math::atan2(sin, cos),
            math::atan2(sin_t, (1.0 - sin_t * sin_t).sqrt()),
        );
        if a == 0.0 {
            let r = (1.0 - eta) / (1.0 + eta);
            return r * r;
        }
        let s = math::sin(a - b) / math::sin(a + b);
        let p = math::tan(a - b) / math::tan(a + b);
        0.5 * (s * s + p * p)
    };
    let mut d = Drawing::graph(
        [440.0, 300.0],
        [w(-8.0, -0.1), w(95.0, 1.05)],
        &format!(
            "The reflected fraction F of glass with the index 1.5 against the angle in degrees: from outside {:.2} head \
             on, {:.2} at 60 degrees and 1 at 90; from inside 1 from the critical angle of 41.8 degrees on.",
            fraction(0.0, 1.0 / 1.5),
            fraction(60.0, 1.0 / 1.5)
        ),
    );
    d.levels([0.0, 90.0], [0.0, 0.5, 1.0].map(|y| (y, y)));
    for x in [0.0, 30.0, 60.0, 90.0] {
        d.note(w(x, 0.0), Side::Below, format!("{x}°"), "ink");
    }
    for (eta, colour, words, at) in [
        (1.0 / 1.5, "blue", "from outside", w(62.0, 0.3)),
        (1.5, "red", "from inside", w(26.0, 0.6)),
    ] {
        let of_glass = graph(|degrees| fraction(degrees, eta), [0.0, 90.0], 360);
        d.path(&of_glass, colour);
        d.note(at, Side::Centre, words, colour);
    }
    let critical = math::atan2(1.0, (1.5 * 1.5 - 1.0_f64).sqrt()).to_degrees();
    d.line(w(critical, 0.0), w(critical, 1.0), "red dash");
    d.note(w(critical, 0.75), Side::Right, "critical angle", "red");
    d.finish()
}

/// The partial sums of a closed room, for three reflectances.
fn series() -> String {
    let mut d = Drawing::graph(
        [640.0, 320.0],
        [w(-0.8, -0.4), w(13.5, 5.2)],
        "Radiance in a closed room against the largest number of rays, for walls that reflect 0.5, 0.7 and 0.8: the \
         sums approach 2, 3.3 and 5.",
    );
    d.line(w(0.0, 0.0), w(12.0, 0.0), "ink");
    for m in [0, 2, 4, 6, 8, 10, 12] {
        let below = w(f64::from(m), 0.0);
        d.note(below, Side::Below, format!("m = {m}"), "ink");
    }
    for (rho, colour) in [(0.5_f64, "blue"), (0.7, "green"), (0.8, "red")] {
        let limit = 1.0 / (1.0 - rho);
        d.line(w(0.0, limit), w(12.0, limit), "soft dash");
        d.note(w(12.0, limit), Side::Right, format!("{limit:.1}"), colour);
        let (mut sum, mut term) = (0.0, 1.0);
        let mut points = Vec::new();
        for m in 0..=12 {
            sum += term;
            term *= rho;
            points.push(w(f64::from(m), sum));
        }
        d.marked_path(&points, colour);
        let below = w(6.3, limit - 0.55);
        d.note(below, Side::Right, format!("ρ = {rho}"), colour);
    }
    d.finish()
}

/// Paths that survive in a room with reflectance 0.6, as bars as long as their throughput.
fn roulette() -> String {
    const PATHS: usize = 24;
    let mut d = Drawing::new(
        [640.0, 330.0],
        [w(-0.2, -2.2), w(13.0, 4.4)],
        "24 paths over eight bounces. Without roulette all survive and get darker; with it fewer and fewer survive, \
         each as bright as at the start.",
    );
    for (base, plays, words) in [
        (2.2, false, "without: all paths, ever darker"),
        (-1.6, true, "with: fewer paths, equally bright"),
    ] {
        let mut sampler = PixelSampler::new(0, 0, 21);
        let mut throughput = [1.0_f64; PATHS];
        for bounce in 0..8 {
            for (i, beta) in throughput.iter_mut().enumerate() {
                if *beta > 0.0 {
                    let x = 1.6 * f64::from(bounce);
                    let y = base + 0.085 * i as f64;
                    d.line(
                        w(x, y),
                        w(x + 1.3 * *beta, y),
                        if plays { "green" } else { "red" },
                    );
                }
                *beta *= 0.6;
                if plays && *beta > 0.0 && bounce >= 1 {
                    let q = beta.min(1.0);
                    *beta = if sampler.get_sample().x < q { 1.0 } else { 0.0 };
                }
            }
        }

        d.note(w(6.4, base - 0.1), Side::Below, words, "ink");
    }
    d.finish()
}

/// The throughput after the game against the random number.
fn game() -> String {
    let mut d = Drawing::graph(
        [560.0, 280.0],
        [w(-0.12, -0.2), w(1.15, 1.25)],
        "The result of the game for a throughput of 0.25: 1 for random numbers below q = 0.25, else 0. The area below \
         the line is 0.25.",
    );
    let q = 0.25;
    d.arrow(w(0.0, 0.0), w(1.1, 0.0), "soft");
    d.arrow(w(0.0, 0.0), w(0.0, 1.2), "soft");
    d.area(&rectangle(w(0.0, 0.0), w(q, 1.0)), "green");
    d.line(w(0.0, 1.0), w(q, 1.0), "green");
    d.line(w(q, 0.0), w(1.0, 0.0), "red");
    d.line(w(0.0, q), w(1.0, q), "blue dash");
    d.label(w(1.1, 0.0), Side::Right, "u", "ink");
    d.label(w(0.0, 1.2), Side::Right, "β'", "ink");
    d.label(w(q, 0.0), Side::Below, "q", "ink");
    d.label(w(1.0, q), Side::Right, "β", "blue");
    d.note(w(q, 1.0), Side::Right, "survives with β / q", "green");
    d.note(w(0.65, 0.0), Side::Below, "ends", "red");
    d.note(w(0.6, q), Side::Above, "the mean", "blue");
    d.finish()
}

/// The refracted direction, and four wrong ones.
fn mistakes() -> String {
    let mut d = Drawing::new(
        [680.0, 230.0],
        [w(-1.0, -1.4), w(11.4, 1.25)],
        "Refraction into glass: right, with the inverse index, straight on, on the wrong side of the normal, and on \
         the side of the viewer.",
    );
    let sin = 0.6;
    let down = |s: f64| w(s, -(1.0 - s * s).sqrt());
    let panels = [
        ("right", down(sin / 1.5), "green"),
        ("inverse index", down(sin * 1.5), "red"),
        ("straight on", down(sin), "red"),
        ("not across", down(-sin / 1.5), "red"),
        ("same side", -down(-sin / 1.5), "red"),
    ];
    for (i, (words, wi, colour)) in panels.into_iter().enumerate() {
        let centre = w(2.6 * i as f64, 0.0);
        d.area(
            &rectangle(centre - w(1.0, 1.05), centre + w(1.0, 0.0)),
            "blue",
        );
        d.line(centre - w(1.0, 0.0), centre + w(1.0, 0.0), "ink");
        d.line(centre - w(0.0, 1.0), centre + w(0.0, 1.0), "soft dash");
        d.arrow(centre, centre - down(sin), "ink");
        d.arrow(centre, centre + wi, colour);
        d.note(centre - w(0.0, 1.05), Side::Below, words, colour);
    }
    d.finish()
}
