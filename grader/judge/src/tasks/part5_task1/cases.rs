//! Cases of the stopping rule, and of pixels that stop by it.

use super::truth::threshold;
use crate::tools::findings::Aspect::{Calls, Independence, Placement, Questions, Radiance};
use crate::tools::kinds::stopping::call;
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use wire::adaptive::{AdaptivePixel, StopCall, StopRule};
use wire::kind;
use wire::work::Xyz;

/// The cases of `part5.task1`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        rule(
            "spread_against_the_mean",
            "1.96 · σ / √n <= tolerance · μ, tested with tolerances 1 % below and above the one \
             where the result changes: σ is the square root of the variance, and n is under a \
             square root.",
            near_the_threshold("spread_against_the_mean", 0, 0.01),
        ),
        rule(
            "confidence",
            "The factor 1.96 is for a confidence of 95 %. Pitfall: 1.645 is for 90 %, 2.58 for 99 \
             %, and 2 is rounded.",
            near_the_threshold("confidence", 0, 0.001),
        ),
        rule(
            "samples_all_alike",
            "Equal samples have a variance of 0: they are enough, even with a tolerance of 0. No \
             samples are never enough.",
            equal_samples(),
        ),
        pixel(
            "samples_and_mean",
            "A stopping rule that always returns false: all -s samples are taken, each with one \
             call of camera_ray and trace_ray, and averaged over their number, black ones, too.",
            some_black(|i| of(i, 9 + 7 * i, 4, never())),
        )
        .only(&[Calls, Radiance]),
        pixel(
            "batches",
            "The stopping rule is called after each batch, with all samples so far, and the loop \
             stops when it returns true.",
            (0..8)
                .map(|i| of(i, 100, 3 + i, StopRule::From(u64::from(10 * i + 1))))
                .collect(),
        )
        .only(&[Calls, Questions]),
        pixel(
            "mean_of_what_was_taken",
            "A pixel that stops early divides by the number of samples taken, however bright they \
             are. Pitfall: dividing by -s, or clamping samples, makes it too dark.",
            (1..6)
                .map(|i| bright(of(i, 640, 8, StopRule::From(u64::from(8 * i)))))
                .collect(),
        )
        .only(&[Radiance]),
        pixel(
            "odd_budgets",
            "0 samples are black, not 0 / 0; a batch of 0 counts as 1; the last batch may be \
             shorter.",
            vec![
                of(0, 0, 4, never()),
                of(1, 5, 0, StopRule::From(3)),
                of(2, 5, 8, never()),
                of(3, 17, 8, never()),
                of(4, 1, 1, StopRule::From(1)),
            ],
        )
        .only(&[Calls, Radiance]),
        pixel(
            "luminance",
            "The stopping rule gets luminances, in which green has the largest weight, those of \
             black samples, too, and the tolerance unchanged.",
            some_black(|i| AdaptivePixel {
                stream: colours("luminance", i),
                ..of(i, 24, 8, never())
            }),
        )
        .only(&[Questions]),
        pixel(
            "places_in_the_pixel",
            "Each sample goes through a point of its own inside the pixel.",
            (0..6).map(|i| of(i, 64, 16, never())).collect(),
        )
        .only(&[Placement]),
        pixel(
            "exact_counts",
            "With your own stopping rule a pixel stops at an exact number of samples.",
            exact("exact_counts", 0),
        )
        .only(&[Calls, Radiance]),
        pixel(
            "fresh_pixels",
            "Pixels with random samples that depend on the seed.",
            exact("fresh_pixels", seed),
        ),
        pixel(
            "fresh_offsets_in_each_pixel",
            "4 samples in each of 256 pixels: the samples of a pixel are independent of those of \
             other pixels. A correlation of 75 % is always detected.",
            (0..256)
                .map(|i| four_samples([i % 16, i / 16], seed))
                .collect(),
        )
        .only(&[Independence]),
        pixel(
            "fresh_offsets_for_each_seed",
            "4 samples in one pixel, with 256 seeds: the samples depend on the seed. A correlation \
             of 75 % is always detected.",
            (0..256)
                .map(|i| four_samples([9, 5], seed.wrapping_add(i)))
                .collect(),
        )
        .only(&[Independence]),
    ]
}

fn rule(name: &'static str, about: &'static str, calls: Vec<StopCall>) -> Spec {
    Spec::new::<kind::Stop>("part5.task1", name, about, calls)
}

fn pixel(name: &'static str, about: &'static str, pixels: Vec<AdaptivePixel>) -> Spec {
    Spec::new::<kind::AdaptivePixels>("part5.task1", name, about, pixels)
}

fn never() -> StopRule {
    StopRule::From(u64::MAX)
}

/// Random samples, with tolerances just below and just above the one where the rule's result
/// changes.
fn near_the_threshold(name: &str, seed: u64, share: f64) -> Vec<StopCall> {
    let mut rng = ProbeRng::new(name, seed);
    let calls = (0..60).flat_map(|_| {
        let (few, many) = (1 + rng.below(40) as u32, 1 + rng.below(400) as u32);
        let runs = vec![
            (few, rng.range(2.0, 9.0)),
            (many, rng.range(0.1, 1.0)),
            (few, rng.range(0.0, 0.5)),
        ];
        let threshold = threshold(&runs);
        [1.0 - share, 1.0 + share].map(|factor| StopCall {
            tolerance: threshold * factor,
            ..call(runs.clone(), false)
        })
    });
    calls.collect()
}

fn equal_samples() -> Vec<StopCall> {
    let of = |runs: Vec<(u32, f64)>, tolerance: f64| StopCall {
        tolerance,
        ..call(runs, false)
    };
    vec![
        of(vec![(2, 3.0)], 0.0),
        of(vec![(32, 0.5)], 0.01),
        of(vec![(1, 0.5)], 0.0),
        of(vec![(64, 0.0)], 0.05),
        of(Vec::new(), 1.0),
        of(Vec::new(), 0.0),
        of(vec![(16, 1.0), (16, 2.0)], 0.0),
    ]
}

/// A different pixel for each `i`.
fn of(i: u32, ns_aa: u32, batch: u32, rule: StopRule) -> AdaptivePixel {
    AdaptivePixel {
        film: [7, 5],
        pixel: [i % 7, (2 * i) % 5],
        ns_aa,
        batch,
        tolerance: 0.05 + 0.01 * f64::from(i),
        seed: 0,
        stream: colours("stream", i),
        rule,
    }
}

/// Nine pixels; in the last three every third sample is black.
fn some_black(pixel: impl Fn(u32) -> AdaptivePixel) -> Vec<AdaptivePixel> {
    let mut pixels: Vec<AdaptivePixel> = (0..9).map(pixel).collect();
    for pixel in &mut pixels[6..] {
        let thirds = pixel.stream.iter_mut().skip(2).step_by(3);
        thirds.for_each(|colour| *colour = [0.0; 3]);
    }
    pixels
}

/// The pixel with samples a hundred thousand times as bright.
fn bright(mut pixel: AdaptivePixel) -> AdaptivePixel {
    let channels = pixel.stream.iter_mut().flatten();
    channels.for_each(|c| *c *= 1e5);
    pixel
}

/// 4 samples in a pixel of a film of 16 x 16.
fn four_samples(pixel: [u32; 2], seed: u64) -> AdaptivePixel {
    AdaptivePixel {
        film: [16, 16],
        pixel,
        seed,
        ..of(0, 4, 4, never())
    }
}

/// Colours that differ from each other, dark and bright.
fn colours(name: &str, i: u32) -> Vec<Xyz> {
    let mut rng = ProbeRng::new(name, u64::from(i));
    let colours = (0..13).map(|_| [0.0; 3].map(|_: f64| rng.range(0.0, 1.0).powi(3) * 20.0));
    colours.collect()
}

/// Random pixels that stop by the plain rule.
fn exact(name: &str, seed: u64) -> Vec<AdaptivePixel> {
    let mut rng = ProbeRng::new(name, seed);
    let pixels = (0..24).map(|i| {
        let noise = rng.one_of(&[0.0, 0.1, 0.5, 2.0]);
        let base = rng.range(0.2, 2.0);
        let stream = (0..64).map(|_| [base + noise * rng.range(0.0, 1.0).powi(4); 3]);
        AdaptivePixel {
            stream: stream.collect(),
            tolerance: rng.one_of(&[0.02, 0.05, 0.2]),
            seed,
            ..of(i, 512, rng.one_of(&[5, 16, 32]), StopRule::Plain)
        }
    });
    pixels.collect()
}
