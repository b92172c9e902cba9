//! Figures of Part 5.

use super::parts::{Figure, graph, log10, w};
use crate::drawing::{Drawing, Side};
use kit::{PixelSampler, Tally, Vec2, math};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part5-interval", interval()),
        ("part5-bell", bell()),
        ("part5-bias", bias()),
        ("part5-miss", miss()),
    ]
}

/// Whether the relative half width of the interval is at most `tolerance`.
pub fn is_narrow(samples: &Tally, tolerance: f64) -> bool {
    1.96 * samples.standard_error() <= tolerance * samples.mean()
}

/// The same with both conditions of Task 2.
pub fn is_surely_narrow(samples: &Tally, tolerance: f64) -> bool {
    samples.count() >= 256 && samples.mean() > 0.0 && is_narrow(samples, tolerance)
}

/// The mean of a pixel with its interval, until it is narrow enough at the end of a batch.
fn interval() -> String {
    const BATCH: u64 = 32;
    const TOLERANCE: f64 = 0.12;
    let mut d = Drawing::graph(
        [640.0, 330.0],
        [w(-25.0, 0.45), w(330.0, 1.65)],
        "The mean of a pixel against the number of samples, inside the interval of 95 percent confidence. The pixel \
         stops at the end of the first batch of 32 samples in which the interval is narrower than the tolerance.",
    );
    let mut sampler = PixelSampler::new(0, 0, 31);
    let (mut samples, mut high, mut low, mut means) =
        (Tally::default(), Vec::new(), Vec::new(), Vec::new());
    let mut end = 320;
    for n in 1..=320_u64 {
        let u = sampler.get_sample();
        samples.push(if u.x < 0.5 {
            0.3 * u.y
        } else {
            1.7 + 0.3 * u.y
        });
        if n < 16 {
            continue;
        }
        let (x, half) = (n as f64, 1.96 * samples.standard_error());
        high.push(w(x, samples.mean() + half));
        low.push(w(x, samples.mean() - half));
        means.push(w(x, samples.mean()));
        if n % BATCH == 0 && is_narrow(&samples, TOLERANCE) {
            end = n;
            break;
        }
    }
    let mean = samples.mean();
    let right = end as f64;
    let band = TOLERANCE * mean;
    let mut area = high.clone();
    area.extend(low.iter().rev());
    d.area(&area, "blue");
    d.path(&high, "blue");
    d.path(&low, "blue");
    d.path(&means, "ink");
    for sign in [-1.0, 1.0] {
        let y = mean + sign * band;
        d.line(w(0.0, y), w(320.0, y), "green dash");
    }
    d.line(w(0.0, 0.5), w(320.0, 0.5), "ink");
    for n in (0..=10).map(|k| 32 * k) {
        let x = f64::from(n);
        d.line(w(x, 0.5), w(x, 0.52), "ink");
        if n % 64 == 0 {
            d.note(w(x, 0.5), Side::Below, n, "ink");
        }
    }
    d.line(w(right, 0.5), w(right, 1.4), "red");
    d.note(w(right, 1.4), Side::Above, "stops", "red");
    d.note(w(right + 40.0, mean + band), Side::Above, "± τ μ", "green");
    d.note(w(50.0, 1.42), Side::Right, "± 1.96 s", "blue");
    d.label(w(322.0, 0.5), Side::Right, "n", "ink");
    d.finish()
}

/// The distribution of the mean around the exact value.
fn bell() -> String {
    let mut d = Drawing::graph(
        [600.0, 290.0],
        [w(-3.6, -0.12), w(3.6, 1.12)],
        "Means of many samples are distributed as a bell curve around the exact value I. 95 percent of them are \
         within 1.96 standard errors s.",
    );
    let height = |x: f64| math::exp(-0.5 * x * x);
    let mut inside = graph(height, [-1.96, 1.96], 80);
    inside.push(w(1.96, 0.0));
    inside.push(w(-1.96, 0.0));
    d.area(&inside, "green");
    d.path(&graph(height, [-3.4, 3.4], 80), "ink");
    d.line(w(-3.5, 0.0), w(3.5, 0.0), "ink");
    for (x, words) in [(-1.96, "I - 1.96 s"), (1.96, "I + 1.96 s")] {
        d.line(w(x, 0.0), w(x, height(x)), "green");
        d.label(w(x, 0.0), Side::Below, words, "ink");
    }
    d.line(w(0.0, 0.0), w(0.0, 1.0), "soft dash");
    d.label(w(0.0, 0.0), Side::Below, "I", "ink");
    d.note(w(0.12, 0.4), Side::Right, "95 %", "green");
    d.note(w(2.4, 0.22), Side::Right, "means μ", "ink");
    d.finish()
}

/// The mean of pixels whose value is 1 and whose light is met with the probability `p`, for
/// batches of 32 and at most 2048 samples, if `stops` decides.
fn mean_of_pixels(p: f64, stops: impl Fn(&Tally) -> bool) -> f64 {
    let mut all = Tally::default();
    for pixel in 0..960 {
        let mut sampler = PixelSampler::new(pixel, 0, 13);
        let mut samples = Tally::default();
        for n in 1..=2048_u32 {
            samples.push(if sampler.get_sample().x < p {
                1.0 / p
            } else {
                0.0
            });
            if n % 32 == 0 && stops(&samples) {
                break;
            }
        }
        all.push(samples.mean());
    }
    all.mean()
}

/// The mean of both criteria against the rarity of the light.
fn bias() -> String {
    let mut d = Drawing::graph(
        [640.0, 330.0],
        [w(0.65, -0.15), w(3.75, 1.35)],
        "The mean of many pixels with the exact value 1, against how rarely a sample meets the light: the plain \
         criterion falls from 1 to nearly 0; with both conditions no pixel stops early, and the mean stays at 1.",
    );
    let rarities = [10.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0, 3000.0];
    d.levels([1.0, 3.6], [0.0, 0.5, 1.0].map(|y| (y, y)));
    for (x, words) in [
        (10.0, "1 in 10"),
        (100.0, "1 in 100"),
        (1000.0, "1 in 1000"),
    ] {
        d.note(w(log10(x), 0.0), Side::Below, words, "ink");
    }
    let plain = |samples: &Tally| is_narrow(samples, 0.05);
    let sure = |samples: &Tally| is_surely_narrow(samples, 0.05);
    let curve = |stops: &dyn Fn(&Tally) -> bool| -> Vec<Vec2> {
        let mean = |n: &f64| w(log10(*n), mean_of_pixels(1.0 / n, stops));
        rarities.iter().map(mean).collect()
    };
    for (points, colour) in [(curve(&plain), "red"), (curve(&sure), "green")] {
        d.marked_path(&points, colour);
    }
    d.note(w(2.25, 0.75), Side::Right, "plain criterion", "red");
    d.note(w(1.5, 1.18), Side::Right, "with both conditions", "green");
    d.note(w(0.75, 1.32), Side::Right, "mean of pixels", "ink");
    d.finish()
}

/// The probability that a batch misses the light.
fn miss() -> String {
    let mut d = Drawing::graph(
        [640.0, 310.0],
        [w(0.65, -0.12), w(4.3, 1.12)],
        "The probability that all samples of a batch miss the light, against how rarely a sample meets it, for \
         batches of 32 and of 256 samples.",
    );
    d.levels([1.0, 4.0], [0.0, 0.5, 1.0].map(|y| (y, y)));
    for (x, words) in [
        (1.0, "1 in 10"),
        (2.0, "1 in 100"),
        (3.0, "1 in 1000"),
        (4.0, "1 in 10000"),
    ] {
        d.note(w(x, 0.0), Side::Below, words, "ink");
    }
    for (batch, colour, words, at) in [
        (32, "red", "b = 32", w(1.75, 0.75)),
        (256, "green", "256", w(2.85, 0.55)),
    ] {
        let missed = |x: f64| math::pow(1.0 - math::pow(10.0, -x), f64::from(batch));
        d.path(&graph(missed, [1.0, 4.0], 120), colour);
        d.note(at, Side::Centre, words, colour);
    }
    d.finish()
}
