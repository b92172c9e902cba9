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
pub mod part5;
mod part6;
mod parts;

pub use parts::Figure;

use std::path::PathBuf;

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
