//! The figures of the chapters. Each is a function that draws it; [`all`] lists them by name.

mod part1;
mod part2;
mod part3;
mod part4;
mod part5;

use std::path::PathBuf;

/// A figure: its file name without `.svg`, and its SVG.
pub type Figure = (&'static str, String);

/// All figures of the book.
pub fn all() -> Vec<Figure> {
    [
        part1::figures(),
        part2::figures(),
        part3::figures(),
        part4::figures(),
        part5::figures(),
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
