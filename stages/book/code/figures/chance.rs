//! Figures of the chapter about chance.

use super::parts::{Figure, rectangle, w};
use crate::drawing::{Drawing, Side};
use kit::{PixelSampler, Vec2};

pub(super) fn figures() -> Vec<Figure> {
    vec![("chance-density", density()), ("chance-means", means())]
}

/// The density of a uniform number and that of its root, with the same probability in both.
fn density() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-0.2, -0.25), w(4.4, 2.1)],
        "Two graphs of a density. On the left the density of u is 1 from 0 to 1; the area from 0.25 to 0.64 is shaded. \
         On the right the density of r, the root of u, is 2 r, a line that rises from 0 to 2; the area from 0.5 to 0.8 \
         is shaded. Both shaded areas are 0.39.",
    );
    let right = w(2.6, 0.0);
    let (low, high) = (0.5, 0.8);
    d.area(&rectangle(w(low * low, 0.0), w(high * high, 1.0)), "blue");
    d.path(&[w(0.0, 1.0), w(1.0, 1.0)], "blue");
    d.area(
        &[
            right + w(low, 0.0),
            right + w(high, 0.0),
            right + w(high, 2.0 * high),
            right + w(low, 2.0 * low),
        ],
        "red",
    );
    d.path(&[right, right + w(1.0, 2.0)], "red");
    for (corner, name) in [(Vec2::ZERO, "u"), (right, "r")] {
        d.arrow(corner, corner + w(1.35, 0.0), "ink");
        d.arrow(corner, corner + w(0.0, 2.05), "ink");
        d.note(corner, Side::Below, "0", "ink");
        d.note(corner + w(1.0, 0.0), Side::Below, "1", "ink");
        d.label(corner + w(1.35, 0.0), Side::Right, name, "ink");
        d.label(corner + w(0.0, 1.95), Side::Left, "p", "ink");
    }
    d.note(w(0.0, 1.0), Side::Left, "1", "ink");
    d.note(right + w(1.0, 2.0), Side::Right, "2 r", "red");
    d.finish()
}

/// The running means of u, 1/sqrt(u) and 1/u.
fn means() -> String {
    const POWERS: u32 = 14;
    let mut d = Drawing::graph(
        [640.0, 320.0],
        [w(0.0, -2.1), w(f64::from(POWERS) + 0.6, 5.0)],
        "Running means of three random numbers against the number of samples, both on logarithmic axes. The mean of u \
         settles quickly at 0.5. The mean of one divided by the root of u settles near 2, with jumps. The mean of one \
         divided by u jumps upwards again and again and does not settle.",
    );
    let log2 = |x: f64| kit::math::ln(x) / std::f64::consts::LN_2;
    type OfU = fn(f64) -> f64;
    let kinds: [(&str, OfU, &str); 3] = [
        ("blue", |u| u, "u"),
        ("green", |u| 1.0 / u.sqrt(), "1 / √u"),
        ("red", |u| 1.0 / u, "1 / u"),
    ];
    for (class, value, name) in kinds {
        let mut sampler = PixelSampler::new(0, 0, 11);
        let mut sum = 0.0;
        let mut points = Vec::new();
        for n in 1..=1_u32 << POWERS {
            // Above 0, where all three are finite.
            sum += value(1.0 - sampler.get_sample().x);
            let step = log2(f64::from(n)) * 12.0;
            if n < 16 || step.floor() > (log2(f64::from(n - 1)) * 12.0).floor() {
                points.push(w(log2(f64::from(n)), log2(sum / f64::from(n))));
            }
        }
        d.path(&points, class);
        let last = points[points.len() - 1];
        d.note(last, Side::Right, name, class);
    }
    d.line(w(0.0, -2.1), w(f64::from(POWERS), -2.1), "ink");
    for power in [0, 4, 8, 12] {
        let x = f64::from(power);
        d.note(w(x, -2.1), Side::Below, 1_u32 << power, "ink");
    }
    let levels = [-1, 1, 3].map(|power| (f64::from(power), 2_f64.powi(power)));
    d.levels([0.0, f64::from(POWERS)], levels);
    d.note(
        w(f64::from(POWERS) - 1.2, -2.1),
        Side::Above,
        "samples n",
        "ink",
    );
    d.finish()
}
