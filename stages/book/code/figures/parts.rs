//! What several figures are made of.

use kit::{Aabb, Vec2, Vec3};

/// A figure: its file name without `.svg`, and its SVG.
pub type Figure = (&'static str, String);

/// A point of the page.
pub(super) fn w(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The corners of a rectangle, from the bottom left counterclockwise.
pub(super) fn rectangle(low: Vec2, high: Vec2) -> [Vec2; 4] {
    [low, w(high.x, low.y), high, w(low.x, high.y)]
}

/// The outline of a box in the xy plane, with a gap around it.
pub(super) fn outline(b: &Aabb, gap: f64) -> [Vec2; 5] {
    let [low, high] = [b.min - gap, b.max + gap].map(Vec3::truncate);
    let [a, b, c, d] = rectangle(low, high);
    [a, b, c, d, a]
}

/// The graph of `f` from one `x` to another, in so many steps of equal size.
pub(super) fn graph(f: impl Fn(f64) -> f64, [from, to]: [f64; 2], steps: u32) -> Vec<Vec2> {
    let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(steps);
    (0..=steps).map(at).map(|x| w(x, f(x))).collect()
}

/// The logarithm to base 10.
pub(super) fn log10(x: f64) -> f64 {
    kit::math::ln(x) / std::f64::consts::LN_10
}

/// A box in the xy plane.
pub(super) fn flat_box(x: f64, y: f64, width: f64, height: f64) -> Aabb {
    let min = Vec3::new(x, y, 0.0);
    Aabb {
        min,
        max: min + Vec3::new(width, height, 0.0),
    }
}
