//! Draws samples in a pixel and points of a sensor.

use super::drawing::Drawing;
use crate::sketch::plot::Plot;
use judge::shown::{ShownPixel, ShownRay};
use kit::PixelSampler;

/// The most samples that are drawn.
const SAMPLES: u32 = 256;

/// A unit square.
fn square() -> Plot {
    let mut plot = Plot::new([-0.15, -0.15], [1.15, 1.15]);
    plot.outline(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    plot
}

/// The samples of a pixel, as the pixel's sampler returns them.
pub(super) fn pixel(shown: &ShownPixel) -> Drawing {
    let ([x, y], seed) = (shown.pixel, shown.seed);
    let mut plot = square();
    let mut sampler = PixelSampler::new(x, y, seed);
    for _ in 0..shown.samples.min(SAMPLES) {
        let place = match shown.samples {
            1 => [0.5; 2],
            _ => sampler.get_sample().to_array(),
        };
        plot.mark(place, '+');
    }
    let about = format!("the samples of pixel ({x}, {y}) with seed {seed}");
    Drawing::new(&plot, &[&about])
}

/// The points of the sensor of rays that cameras make; `None` for other rays.
pub(super) fn sensor(rays: &[&ShownRay]) -> Option<Drawing> {
    let cameras = rays.iter().map(|ray| ray.camera);
    let inputs: Vec<_> = cameras.collect::<Option<Vec<_>>>()?;
    let first = inputs.first()?.0.pos;
    let mut plot = square();
    // Every camera has the same points.
    let points = inputs
        .iter()
        .take_while(|(camera, _)| camera.pos == first)
        .map(|(_, point)| point.to_array());
    let outside = points.filter(|point| !plot.mark(*point, '+')).count();
    let about = "the sensor, (0, 0) at the bottom left, and its points";
    let drawing = Drawing::new(&plot, &[about]);
    Some(drawing.without(outside, ["point is", "points are"], "outside the drawing"))
}
