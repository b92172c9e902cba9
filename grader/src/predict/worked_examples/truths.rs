//! The answers of Parts 3 to 5, computed again from the numbers that are shown, in another way.

use super::{WorkedExample, of};
use std::f64::consts::PI;

const SEEDS: u64 = 200;

/// The numbers of what is given, in their order. A fraction is one number.
fn shown(example: &WorkedExample) -> Vec<f64> {
    let text = example.given.join(" ");
    let is_part = |c: char| c.is_ascii_digit() || c == '.' || c == '/';
    let words = text.split(|c: char| !is_part(c) && c != '-');
    let number = |word: &str| {
        let (above, below) = word.split_once('/').unwrap_or((word, "1"));
        Some(above.parse::<f64>().ok()? / below.parse::<f64>().ok()?)
    };
    let words = words.map(|word| word.trim_end_matches('.'));
    words.filter_map(number).collect()
}

/// Compares the answers with those of `truths` for many seeds.
fn compare(key: &str, truths: impl Fn(&[f64]) -> Vec<f64>) {
    for seed in 0..SEEDS {
        let example = of(key, seed).expect("an example");
        let truths = truths(&shown(&example));
        assert_eq!(truths.len(), example.asked.len(), "{key}");
        for (asked, truth) in example.asked.iter().zip(truths) {
            // Some answers are stored with five digits.
            let error = (asked.truth - truth).abs();
            assert!(error <= 2e-5 * truth.abs(), "{example:?}: {truth}");
        }
    }
}

/// The integral of `f` over a hemisphere of directions at the angle θ to its axis.
fn over_hemisphere(f: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 1000;
    let width = 0.5 * PI / f64::from(STEPS);
    let ring = |k: u32| {
        let angle = (f64::from(k) + 0.5) * width;
        f(angle.cos()) * angle.sin()
    };
    2.0 * PI * width * (0..STEPS).map(ring).sum::<f64>()
}

#[test]
fn light_is_that_of_the_shown_numbers() {
    compare("part3.task1", |given| {
        let [reflected, first, _] = given[..] else {
            panic!("{given:?}")
        };
        // Of the disk, the share `first` is nearer to its centre.
        let radius = (PI * first / PI).sqrt();
        let height = (1.0 - radius * radius).sqrt();
        // The density is in proportion to the cosine, and so is what a diffuse surface sends on.
        let density = height / over_hemisphere(|cosine| cosine);
        let value = reflected / over_hemisphere(|cosine| cosine);
        vec![radius, height, PI * density, value * height / density]
    });
    compare("part3.task2", |given| {
        let [reflected, lamp, count, first, second, chance] = given[..] else {
            panic!("{given:?}")
        };
        let density = 1.0 / over_hemisphere(|_| 1.0);
        let value = reflected / over_hemisphere(|cosine| cosine);
        let sum: f64 = [first, second]
            .map(|cosine| value * lamp * cosine / density)
            .iter()
            .sum();
        // A sample is 1 with the probability `chance`, else 0.
        let variance = chance * (1.0 - chance).powi(2) + (1.0 - chance) * chance * chance;
        vec![sum / count, variance.sqrt() / chance]
    });
    compare("part3.task3", |given| {
        let [reflected, .., area, light, x, y, z] = given[..] else {
            panic!("{given:?}")
        };
        let distance = (x * x + y * y + z * z).sqrt();
        let cosine = z / distance;
        // The solid angle of a small piece of the lamp, for each area of it.
        let solid_angle = cosine / (distance * distance);
        let density = 1.0 / area / solid_angle;
        vec![cosine, density, reflected * light * cosine / density]
    });
}

#[test]
fn paths_are_those_of_the_shown_numbers() {
    compare("part4.task1", |given| {
        let [index, sine, zero, cosine, ..] = given[..] else {
            panic!("{given:?}")
        };
        assert_eq!(zero, 0.0);
        let indices = if cosine > 0.0 {
            [1.0, index]
        } else {
            [index, 1.0]
        };
        // Snell: the products of index and sine are equal.
        let angle = (indices[0] * sine / indices[1]).asin();
        let weight = (angle.sin() / sine).powi(2);
        vec![-sine, -angle.sin(), -cosine.signum() * angle.cos(), weight]
    });
    compare("part4.task2", |given| {
        let [first, of_first, second, of_second, lamp, one, room] = given[..] else {
            panic!("{given:?}")
        };
        assert_eq!(one, 1.0);
        // From the end of the path to the camera.
        let radiance = of_first + first * (of_second + second * 0.0);
        let with_mirror = of_first + first * (0.0 + 1.0 * lamp);
        let series = (0..400).map(|bounce| room.powi(bounce)).sum();
        vec![first * second, radiance, with_mirror, series]
    });
    compare("part4.task3", |given| {
        let [red, green, blue, reflected] = given[..] else {
            panic!("{given:?}")
        };
        let mut channels = [red, green, blue];
        channels.sort_by(f64::total_cmp);
        let further = (1..400).map(|bounce| reflected.powi(bounce)).sum();
        vec![channels[2], channels[1] / channels[2], further]
    });
}

#[test]
fn stops_are_those_of_the_shown_numbers() {
    compare("part5.task1", |given| {
        let [count, low, high] = given[..] else {
            panic!("{given:?}")
        };
        let half = count as usize / 2;
        let samples = [vec![low; half], vec![high; half]].concat();
        let tally: kit::Tally = samples.into_iter().collect();
        let error = tally.standard_error();
        vec![tally.variance(), error, 1.96 * error / tally.mean()]
    });
    compare("part5.task2", |given| {
        let [chance, batch, tolerance] = given[..] else {
            panic!("{given:?}")
        };
        // Half of the interval relative to the mean is the tolerance, for a rare light.
        let hits = (1.96 / tolerance).powi(2);
        vec![(1.0 - chance).powf(batch), hits, hits / chance]
    });
}
