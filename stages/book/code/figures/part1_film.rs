//! Figures of Part 1: the samples of a pixel.

use super::parts::{Figure, rectangle, w};
use crate::drawing::{Drawing, Side};
use kit::{PixelSampler, Ray, Vec2, Vec3};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part1-overview", overview()),
        ("part1-film", film()),
        ("part1-convergence", convergence()),
        ("part1-film-mistakes", film_mistakes()),
    ]
}

/// The way of a ray: from a pixel of the film through the camera to a hit.
fn overview() -> String {
    let mut d = Drawing::new(
        [640.0, 250.0],
        [w(-0.3, -1.3), w(8.2, 1.4)],
        "Task 1 chooses a point of the film, Task 2 makes the ray through it, Tasks 3 and 4 find what it hits.",
    );
    let ray = Ray::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.12, 0.0));
    let at = |t: f64| ray.at(t).truncate();
    d.line(w(1.6, -0.9), w(1.6, 0.9), "blue");
    for k in 0..=6 {
        let y = -0.9 + 0.3 * f64::from(k);
        d.line(w(1.53, y), w(1.67, y), "blue");
    }
    d.polygon(&[w(6.2, -1.1), w(6.9, 1.2), w(7.6, -0.8)], "green");
    d.arrow(at(0.0), at(6.72), "ink");
    d.dot(at(0.0), "ink");
    d.dot(at(1.6), "blue");
    d.dot(at(6.8), "red");
    d.note(at(0.0), Side::Below, "camera", "ink");
    d.note(w(1.6, 0.9), Side::Above, "film", "blue");
    d.note(w(1.6, -0.9), Side::Below, "Task 1: which point", "blue");
    d.note(at(4.0), Side::Above, "Task 2: which ray", "ink");
    d.note(w(6.9, -1.1), Side::Below, "Tasks 3, 4: which hit", "green");
    d.finish()
}

/// A film of 4 x 2 pixels with its coordinates, and one pixel with its samples.
fn film() -> String {
    let mut d = Drawing::new(
        [640.0, 300.0],
        [w(-0.3, -0.3), w(7.6, 2.5)],
        "A film of 4 by 2 pixels: column x and row y count from the bottom left. On the right, pixel (3, 1) \
         with random samples, each at its own position s.",
    );
    d.area(&rectangle(w(3.0, 1.0), w(4.0, 2.0)), "blue");
    for x in 0..=4 {
        d.line(w(f64::from(x), 0.0), w(f64::from(x), 2.0), "soft");
    }
    for y in 0..=2 {
        d.line(w(0.0, f64::from(y)), w(4.0, f64::from(y)), "soft");
    }
    for x in 0..4 {
        let middle = w(f64::from(x) + 0.5, 0.0);
        d.note(middle, Side::Below, format!("x = {x}"), "ink");
    }
    for y in 0..2 {
        let middle = w(0.0, f64::from(y) + 0.5);
        d.note(middle, Side::Left, format!("y = {y}"), "ink");
    }
    d.note(w(0.0, 2.0), Side::Above, "v = 1", "green");
    d.note(w(4.0, 0.0), Side::Right, "u = 1", "green");
    d.note(w(0.0, 0.0), Side::Left, "(0, 0)", "green");
    d.dot(w(3.5, 1.5), "red");
    let corner = w(5.4, 0.2);
    let size = 2.0;
    let at = |s: Vec2| corner + size * s;
    d.polygon(&rectangle(at(Vec2::ZERO), at(Vec2::ONE)), "blue");
    d.line(w(4.0, 2.0), at(w(0.0, 1.0)), "soft dash");
    d.line(w(4.0, 1.0), at(w(0.0, 0.0)), "soft dash");
    let mut sampler = PixelSampler::new(3, 1, 5);
    let samples: Vec<Vec2> = (0..8).map(|_| sampler.get_sample()).collect();
    for s in &samples {
        d.dot(at(*s), "ink");
    }
    let s = samples[0];
    d.dot(at(s), "red");
    d.arrow(at(Vec2::ZERO), at(s), "red dash");
    d.label(at(0.5 * s), Side::Above, "s", "red");
    d.finish()
}

/// The running mean of samples of a pixel, a quarter of which is white.
fn convergence() -> String {
    const MOST: u32 = 1024;
    let mut d = Drawing::graph(
        [640.0, 320.0],
        [w(0.0, -0.15), w(10.0, 1.0)],
        "The mean of N samples of a pixel, a quarter of which is white, for four seeds, against N from 1 to 1024 \
         on a logarithmic axis. The means approach 0.25 within a band that narrows as 1/sqrt(N).",
    );
    let at = |n: u32, value: f64| w(kit::math::ln(f64::from(n)) / std::f64::consts::LN_2, value);
    let sigma = (0.25 * 0.75_f64).sqrt();
    let counts: Vec<u32> = (0..=80)
        .map(|k| kit::math::pow(2.0, f64::from(k) / 8.0).round() as u32)
        .collect();
    let edge = |sign: f64| {
        let value = move |n: &u32| at(*n, 0.25 + sign * sigma / f64::from(*n).sqrt());
        counts.iter().map(value).collect::<Vec<_>>()
    };
    let mut band = edge(1.0);
    band.extend(edge(-1.0).into_iter().rev());
    d.area(&band, "blue");
    d.line(at(1, 0.25), at(MOST, 0.25), "blue");
    for (seed, class) in [(1, "ink"), (2, "red"), (3, "green"), (4, "soft")] {
        let mut sampler = PixelSampler::new(0, 0, seed);
        let mut white = 0;
        let mut points = Vec::new();
        for n in 1..=MOST {
            let s = sampler.get_sample();
            white += u32::from(s.x < 0.5 && s.y < 0.5);
            if counts.contains(&n) {
                points.push(at(n, f64::from(white) / f64::from(n)));
            }
        }
        d.path(&points, class);
    }
    d.line(at(1, -0.15), at(MOST, -0.15), "ink");
    for power in [0, 2, 4, 6, 8, 10] {
        let n = 1 << power;
        d.note(at(n, -0.15), Side::Below, n, "ink");
    }
    d.note(at(MOST, 0.25), Side::Above, "0.25", "blue");
    d.note(w(1.4, 0.95), Side::Right, "estimate E", "ink");
    d.note(w(9.2, -0.13), Side::Above, "samples N", "ink");
    d.finish()
}

/// The centre of each pixel on a film of 3 x 2, as it should be and after two mistakes.
fn film_mistakes() -> String {
    let mut d = Drawing::new(
        [660.0, 210.0],
        [w(-0.2, -0.7), w(11.4, 2.3)],
        "Where the only sample of each pixel of a small film is: in the middle of each pixel; in its corner; at x \
         divided by the height and y by the width.",
    );
    let (width, height) = (3.0, 2.0);
    type Place = fn(f64, f64) -> (f64, f64);
    let places: [(&str, Place); 3] = [
        ("right", |x, y| ((x + 0.5) / 3.0, (y + 0.5) / 2.0)),
        ("corner of the pixel", |x, y| (x / 3.0, y / 2.0)),
        ("x / h and y / w", |x, y| ((x + 0.5) / 2.0, (y + 0.5) / 3.0)),
    ];
    for (i, (words, place)) in places.into_iter().enumerate() {
        let corner = w(4.0 * i as f64, 0.0);
        for x in 0..=3 {
            let x = f64::from(x);
            d.line(corner + w(x, 0.0), corner + w(x, height), "soft");
        }
        for y in 0..=2 {
            let y = f64::from(y);
            d.line(corner + w(0.0, y), corner + w(width, y), "soft");
        }
        for (x, y) in [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)] {
            let (u, v) = place(f64::from(x), f64::from(y));
            let p = corner + w(u * width, v * height);
            d.dot(p, if i == 0 { "green" } else { "red" });
        }
        d.note(corner + w(0.5 * width, -0.1), Side::Below, words, "ink");
    }
    d.finish()
}
