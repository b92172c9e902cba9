//! Draws samples in a pixel and points of a sensor.

use super::legend;
use super::plot::Plot;
use judge::plural;
use kit::PixelSampler;
use wire::work::{CameraWork, PixelWork};

/// The most samples that are drawn.
const SAMPLES: u32 = 256;

/// The samples of the first pixel with the first seed, as the pixel's sampler returns them.
pub(super) fn pixels(work: &PixelWork) -> (String, Vec<String>) {
    let [w, h] = work.film;
    let words = format!(
        "{} of a film of {w} x {h}, each with {}; {}.",
        plural(work.pixels.len(), "pixel", "pixels"),
        plural(work.ns_aa as usize, "sample", "samples"),
        plural(work.seeds.len(), "seed", "seeds")
    );
    let (Some([x, y]), Some(&seed)) = (work.pixels.first(), work.seeds.first()) else {
        return (words, Vec::new());
    };
    let mut plot = Plot::new([-0.15, -0.15], [1.15, 1.15]);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    for i in 0..4 {
        plot.line(corners[i], corners[(i + 1) % 4]);
    }
    let mut sampler = PixelSampler::new(*x, *y, seed);
    for _ in 0..work.ns_aa.min(SAMPLES) {
        let place = match work.ns_aa {
            1 => [0.5; 2],
            _ => sampler.get_sample().to_array(),
        };
        plot.mark(place, '+');
    }
    let mut lines = plot.lines();
    lines.push(legend(&format!(
        "the samples of pixel ({x}, {y}) with seed {seed}"
    )));
    (words, lines)
}

/// The points of the sensor.
pub(super) fn camera_rays(work: &CameraWork) -> (String, Vec<String>) {
    let range = |angle: fn(&wire::work::Camera) -> f64| {
        let angles = work.cameras.iter().map(angle);
        let (low, high) = angles.fold((f64::INFINITY, 0.0_f64), |(low, high), angle| {
            (low.min(angle), high.max(angle))
        });
        match low == high {
            true => format!("{low:.1}"),
            false => format!("{low:.1} to {high:.1}"),
        }
    };
    let words = format!(
        "{}, fields of view {} degrees across and {} degrees up; {} of the sensor, for each camera.",
        plural(work.cameras.len(), "camera", "cameras"),
        range(|camera| camera.h_fov),
        range(|camera| camera.v_fov),
        plural(work.sensor.len(), "point", "points")
    );
    let mut plot = Plot::new([-0.15, -0.15], [1.15, 1.15]);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    for i in 0..4 {
        plot.line(corners[i], corners[(i + 1) % 4]);
    }
    let inside = work
        .sensor
        .iter()
        .filter(|point| plot.mark(**point, '+'))
        .count();
    let mut lines = plot.lines();
    lines.push(legend(
        "the sensor, (0, 0) at the bottom left, and its points",
    ));
    let outside = work.sensor.len() - inside;
    if outside > 0 {
        let points = plural(outside, "point is", "points are");
        lines.push(legend(&format!("{points} outside the drawing")));
    }
    (words, lines)
}
