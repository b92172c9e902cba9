//! Simple samples for the stopping rule, and simple pixels that stop by a rule.

use wire::adaptive::{AdaptivePixel, StopCall, StopRule};
use wire::work::Xyz;

/// The simple questions about the plain rule: samples of two values, few and many of each, with
/// tolerances far from where the result changes: 1.96 for a sample of 0 and one of 2.
pub(crate) fn rules() -> Vec<Vec<StopCall>> {
    let equal = [1, 2, 4].map(|count| vec![(count, 1.0)]);
    let different = [1, 2, 3, 8, 32].map(|count| vec![(count, 0.0), (count, 2.0)]);
    let bright = [1, 2, 32].map(|count| vec![(count, 10.0), (count, 20.0)]);
    // The error is 1.96 / 1.964 of the mean.
    let seven_to_three = vec![(7, 0.0), (3, 2.0)];
    let runs = [Vec::new()]
        .into_iter()
        .chain(equal)
        .chain(different)
        .chain(bright)
        .chain([seven_to_three]);
    let many = [50, 200].map(|count| vec![(count, 0.0), (count, 2.0)]);
    let calls = |runs: Vec<(u32, f64)>, tolerances: &[f64]| {
        let call = |&tolerance: &f64| StopCall {
            runs: runs.clone(),
            tolerance,
            rule: false,
        };
        tolerances.iter().map(call).collect::<Vec<StopCall>>()
    };
    let few = runs.flat_map(|runs| calls(runs, &[1.0, 0.5, 0.0, 2.0, 1.5, 2.5]));
    let many = many
        .into_iter()
        .flat_map(|runs| calls(runs, &[0.5, 0.25, 0.1, 0.05]));
    vec![few.chain(many).collect()]
}

/// The simple questions about pixels.
pub(crate) fn pixels() -> Vec<Vec<AdaptivePixel>> {
    let never = StopRule::From(u64::MAX);
    let black_and_white: [Xyz; 2] = [[0.0; 3], [2.0; 3]];
    let mut pixels = Vec::new();
    for stream in [vec![[1.0; 3]], black_and_white.to_vec()] {
        for (ns_aa, batch) in [
            (1, 1),
            (2, 1),
            (2, 2),
            (4, 2),
            (3, 2),
            (8, 2),
            (0, 1),
            (2, 0),
        ] {
            for rule in [never, StopRule::From(2), StopRule::From(4)] {
                pixels.push(AdaptivePixel {
                    film: [1, 1],
                    pixel: [0, 0],
                    ns_aa,
                    batch,
                    tolerance: 0.5,
                    seed: 0,
                    stream: stream.clone(),
                    rule,
                });
            }
        }
    }
    // Red, green and blue have different luminances.
    let red = pixels.iter().take(6).map(|pixel| AdaptivePixel {
        stream: vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        ..pixel.clone()
    });
    let places = [
        ([2, 2], [1, 0]),
        ([2, 2], [0, 1]),
        ([2, 2], [1, 1]),
        ([2, 1], [1, 0]),
        ([1, 2], [0, 1]),
    ];
    let corners = places.map(|(film, pixel)| AdaptivePixel {
        film,
        pixel,
        ..pixels[0].clone()
    });
    let others: Vec<AdaptivePixel> = corners.into_iter().chain(red).collect();
    pixels.extend(others);
    // Samples of one pixel with one seed would be the same.
    for (seed, pixel) in (0..).zip(&mut pixels) {
        pixel.seed = seed;
    }
    vec![pixels]
}
