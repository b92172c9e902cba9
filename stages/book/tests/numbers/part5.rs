//! The worked examples of Part 5.

use super::stopping::Pixels;
use super::{Numbers, check};

#[test]
fn task1() {
    let mut text = Numbers::default();
    let samples = [1.0, 2.0, 1.0, 2.0].map(|x| text.n(x));
    let mean = text.n(samples.iter().sum::<f64>() / 4.0);
    let distance = text.n((samples[0] - mean).abs());
    text.n(4.0);
    text.n(distance * distance);
    text.n(3.0);
    let squares: f64 = samples.iter().map(|x| (x - mean) * (x - mean)).sum();
    let variance = text.n(squares / 3.0);
    let sigma = text.n(variance.sqrt());
    text.n(sigma);
    text.n(2.0);
    let error = text.n(sigma / 2.0);
    text.n(1.96);
    let half = text.n(1.96 * error);
    let relative = text.n(half / mean);
    let loose = text.n(0.38);
    let tolerance = text.n(0.05);
    assert!(relative <= loose && relative > tolerance);
    text.n(1.96);
    text.n(sigma);
    text.n(tolerance);
    text.n(mean);
    let needed = text.n((1.96 * sigma / (tolerance * mean)).powi(2));
    text.n(needed.ceil());
    let batch = text.n(32.0);
    text.n(batch * (needed / batch).ceil());
    check("part5/task1.md", text);
}

#[test]
fn task2() {
    let mut text = Numbers::default();
    let p = text.n(0.001);
    let value = text.n(1000.0);
    let exact = text.n(p * value);
    let batch = text.n(32.0);
    let most = text.n(2048.0);
    let tolerance = text.n(0.05);
    text.n(1.0 - p);
    let missed = text.n((1.0 - p).powi(32));
    text.n(0.0);
    let met = text.n(1.0 - missed);
    let in_batch = text.n(batch * p / met);
    let rest = text.n(most - batch);
    let later = text.n(rest * p);
    text.n(value);
    text.n(in_batch);
    text.n(later);
    text.n(most);
    let mean = text.n(value * (in_batch + later) / most);
    text.n(met);
    text.n(mean);
    let biased = text.n(met * mean);
    text.n(exact);
    text.n((exact / biased).round());
    text.n(most);
    text.n((1.96_f64 / tolerance).powi(2).ceil());
    text.n(exact);
    let often = Pixels {
        p: text.n(0.1),
        tolerance: text.n(0.25),
        most: 2048,
    };
    let (factor, spread) = (text.n(1.96), text.n(((1.0 - often.p) / often.p).sqrt()));
    text.n(often.tolerance);
    text.n((factor * spread / often.tolerance).powi(2));
    let [mean, samples] = often.mean_and_samples();
    text.n(samples);
    text.n(most);
    text.n(mean);
    check("part5/task2.md", text);
}
