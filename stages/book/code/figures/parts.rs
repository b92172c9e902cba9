//! What several figures are made of.

use kit::{Aabb, Vec2, Vec3};

/// A figure: its file name without `.svg`, and its SVG.
pub type Figure = (&'static str, String);

/// A point of the page.
pub(super) fn w(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The outline of a box in the xy plane, with a gap around it.
pub(super) fn outline(b: &Aabb, gap: f64) -> Vec<Vec2> {
    let (low, high) = (b.min - gap, b.max + gap);
    vec![
        w(low.x, low.y),
        w(high.x, low.y),
        w(high.x, high.y),
        w(low.x, high.y),
        w(low.x, low.y),
    ]
}

/// A box in the xy plane.
pub(super) fn flat_box(x: f64, y: f64, width: f64, height: f64) -> Aabb {
    let min = Vec3::new(x, y, 0.0);
    Aabb {
        min,
        max: min + Vec3::new(width, height, 0.0),
    }
}
