//! The figures of the chapters. Each is a function that draws it; [`all`] lists them by name.

mod chance;
mod light;
mod part1_camera;
mod part1_film;
pub mod part1_sphere;
mod part1_triangle;
mod part2_box;
mod part2_traversal;
mod part2_tree;
mod part3_diffuse;
mod part3_direct;
mod part4;
mod part5;
mod part6;

use kit::{Aabb, Vec2, Vec3};
use std::path::PathBuf;

/// A figure: its file name without `.svg`, and its SVG.
pub type Figure = (&'static str, String);

/// All figures of the book.
pub fn all() -> Vec<Figure> {
    [
        chance::figures(),
        light::figures(),
        part1_film::figures(),
        part1_camera::figures(),
        part1_triangle::figures(),
        part1_sphere::figures(),
        part2_tree::figures(),
        part2_box::figures(),
        part2_traversal::figures(),
        part3_diffuse::figures(),
        part3_direct::figures(),
        part4::figures(),
        part5::figures(),
        part6::figures(),
    ]
    .concat()
}

/// The file of the figure `name`.
pub fn file(name: &str) -> PathBuf {
    crate::folder().join(format!("src/figures/{name}.svg"))
}

/// Writes all figures to `src/figures`.
pub fn write_all() -> Result<(), String> {
    for (name, svg) in all() {
        let path = file(name);
        std::fs::write(&path, svg)
            .map_err(|error| format!("cannot write {}: {error}", path.display()))?;
    }
    Ok(())
}

/// A point of the page.
fn w(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The outline of a box in the xy plane, with a gap around it.
fn outline(b: &Aabb, gap: f64) -> Vec<Vec2> {
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
fn flat_box(x: f64, y: f64, width: f64, height: f64) -> Aabb {
    let min = Vec3::new(x, y, 0.0);
    Aabb {
        min,
        max: min + Vec3::new(width, height, 0.0),
    }
}
