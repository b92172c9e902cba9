//! Draws one call in a plane: in characters for the report, as SVG for a page.
//!
//! [`Sketch::of`] makes it of the call: `geometry` for rays at shapes, `samples` for pixels and
//! cameras, `directions` for light and scattering, `spans` for trees. Then [`Sketch::text`] and
//! [`Sketch::svg`] draw the same strokes; [`Sketch::drawing`] is a file. `plot` is the sheet of
//! characters, which `explain` draws on, too; `words` places words on an SVG.

mod directions;
mod geometry;
mod model;
pub(crate) mod plot;
mod samples;
mod spans;
mod svg;
mod text;
mod view;
mod words;

pub use model::Sketch;
pub use svg::Drawing;

use judge::shown::ShownCall;

impl Sketch {
    /// Draws a call; `None` if there is nothing to see, or nothing finite.
    pub fn of(call: &ShownCall) -> Option<Sketch> {
        let sketch = match call {
            ShownCall::Ray(ray) => match ray.camera {
                Some((camera, sensor)) => samples::camera(&camera, sensor, &ray.ray),
                None => geometry::ray(ray)?,
            },
            ShownCall::Pixel(pixel) => samples::pixel(pixel)?,
            ShownCall::Directions(probe) => directions::pair(probe),
            ShownCall::Bounce(bounce) => directions::bounce(bounce),
            ShownCall::LitPoint(point) => directions::lit_point(point)?,
            ShownCall::Path(path) => directions::path(path)?,
            ShownCall::Spans(spans) => spans::spans(spans)?,
        };
        sketch.is_finite().then_some(sketch)
    }
}
