//! Part 5: how far a mean is off, and how often a batch misses a light.

use super::example::{AskedNumber, WorkedExample, tenths};
use crate::predict::draw::Draw;

/// Samples of two values, half of them of each.
pub(super) fn spread(draw: &mut Draw) -> WorkedExample {
    // The number of samples, and the root of one less.
    let (count, root) = draw.one(&[(10, 3.0), (26, 5.0), (50, 7.0)]);
    let mean = f64::from(draw.from(2, 8));
    let off = tenths(draw.one(&[2, 4, 6, 8]));
    let n = f64::from(count);
    let error = off / root;
    let (low, high) = (mean - off, mean + off);
    let variance = off * off * n / (root * root);
    WorkedExample {
        given: vec![format!(
            "Of {count} samples, half have the luminance {low:.1} and half {high:.1}."
        )],
        asked: vec![
            AskedNumber::new(
                "the variance of the samples",
                variance,
                &[
                    (
                        off * off,
                        "the mean square of the distances: divide by n - 1",
                    ),
                    (off * off * n, "the sum of the squares"),
                    (off, "the distance of each sample from the mean"),
                    (variance.sqrt(), "the standard deviation, its root"),
                ],
            ),
            AskedNumber::new(
                "the standard error of the mean",
                error,
                &[
                    (variance.sqrt(), "the standard deviation of one sample"),
                    (variance / n, "the square of the standard error"),
                    (
                        variance.sqrt() / n,
                        "the deviation divided by n, not by its root",
                    ),
                    (
                        off / n.sqrt(),
                        "the error with a variance that is divided by n",
                    ),
                ],
            ),
            AskedNumber::new(
                "the smallest tolerance with which the pixel stops",
                1.96 * error / mean,
                &[
                    (error / mean, "the tolerance without the 1.96"),
                    (
                        1.96 * error,
                        "the tolerance that is not relative to the mean",
                    ),
                    (
                        1.96 * variance.sqrt() / mean,
                        "the tolerance for the deviation of one sample",
                    ),
                    (2.0 * 1.96 * error / mean, "the width of the whole interval"),
                ],
            ),
        ],
    }
}

/// A light that a sample finds with a small probability.
pub(super) fn rare_light(draw: &mut Draw) -> WorkedExample {
    let one_of = draw.one(&[10, 20, 50, 100]);
    let batch = draw.one(&[4, 8, 16]);
    let tolerance = draw.one(&[0.02, 0.04, 0.07, 0.1, 0.14]);
    let chance = 1.0 / f64::from(one_of);
    let missed = (0..batch).fold(1.0, |all, _| all * (1.0 - chance));
    let hits = (1.96 / tolerance) * (1.96 / tolerance);
    WorkedExample {
        given: vec![
            format!(
                "A sample meets the light with the probability p = 1/{one_of}, and else is black. The first batch has {batch} samples."
            ),
            format!("The tolerance is {tolerance}."),
        ],
        asked: vec![
            AskedNumber::new(
                "the share of pixels that the plain rule stops after the first batch, black",
                missed,
                &[
                    (1.0 - missed, "the share of pixels that met the light"),
                    (
                        1.0 - chance,
                        "the probability that one sample misses the light",
                    ),
                    (
                        1.0 - f64::from(batch) * chance,
                        "the share if probabilities are added: samples may meet the light twice",
                    ),
                ],
            ),
            AskedNumber::new(
                "how many samples must meet the light before the plain rule stops a pixel that has met it, about",
                hits,
                &[
                    (1.96 / tolerance, "the root of the number"),
                    (1.0 / tolerance / tolerance, "the number without the 1.96"),
                    (hits / chance, "the number of all samples"),
                ],
            ),
            AskedNumber::new(
                "how many samples that takes, about",
                hits / chance,
                &[
                    (hits, "the number of samples that meet the light"),
                    (
                        hits * chance,
                        "the number times p: most samples miss the light",
                    ),
                    (
                        256.0,
                        "the least number of samples: the plain rule asks for more here",
                    ),
                ],
            ),
        ],
    }
}
