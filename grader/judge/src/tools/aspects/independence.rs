//! Judges whether the samples of different pixels, and those with different seeds, are independent.
//!
//! Every correct sampler passes: independent, jittered or low-discrepancy samples, in any order, if
//! their random numbers come from the sampler of the pixel.

use crate::tools::aspects::chance;
use crate::tools::findings::{Aspect, Class, Findings};
use crate::tools::plural;
use statistics::{critical_z, detectable_bias};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The samples of one call.
pub(crate) struct PixelSamples {
    /// Column and row.
    pub(crate) pixel: [u32; 2],
    /// Seed of the pixel's sampler.
    pub(crate) seed: u64,
    /// Positions in the pixel, from 0 to 1.
    pub(crate) offsets: Vec<[f64; 2]>,
}

/// Offsets closer than this on both axes are the same, in pixels. Computing an offset from a film
/// point rounds by 1e-14. That as many as [`SAME_SHARE`] of the offsets of two pixels are this
/// close by chance never happens, not even for two pixels with one sample each: its probability is
/// 4e-18.
const SAME_OFFSET: f64 = 1e-9;

/// A call has the samples of another one if it shares at least this part of them. Code that draws a
/// few positions from the sampler and takes the others from a table shares less.
const SAME_SHARE: f64 = 0.5;

/// How far outside its pixel an offset may be, by the rounding of film points.
const OUTSIDE_BOUND: f64 = 1e-9;

/// The smallest number of pairs whose correlation is tested: of fewer it is not normally
/// distributed.
pub(crate) const MIN_PAIRS: usize = 200;

/// Judges that no call has the samples of another, and that the samples of calls that follow each
/// other (neighbouring pixels, consecutive seeds) are not correlated.
pub(crate) fn judge(findings: &mut Findings, calls: &[PixelSamples]) {
    for (axis, name) in [(0, "x"), (1, "y")] {
        correlation(findings, calls, axis, name);
    }
    let twins = twins(calls);
    let repeated = twins.iter().flatten().count();
    for (call, (samples, twin)) in calls.iter().zip(&twins).enumerate() {
        findings.expect(Aspect::Independence);
        let twin = twin.map(|other| &calls[other]);
        let class = twin.map(|other| match other.pixel == samples.pixel {
            true => Class::Named("as with another seed"),
            false => Class::Named("as in another pixel"),
        });
        // Larger than the badness of any correlation.
        findings.judge_class(Aspect::Independence, call, class, f64::INFINITY, || {
            message(samples, twin, repeated, calls.len())
        });
    }
}

fn message(
    samples: &PixelSamples,
    twin: Option<&PixelSamples>,
    repeated: usize,
    calls: usize,
) -> String {
    let PixelSamples { pixel, seed, .. } = samples;
    let [x, y] = pixel;
    let other = match twin {
        Some(twin) if twin.pixel == *pixel => format!("with seed {}", twin.seed),
        Some(twin) => format!("pixel ({}, {})", twin.pixel[0], twin.pixel[1]),
        None => String::new(),
    };
    let calls = plural(calls, "call", "calls");
    format!(
        "your result: pixel ({x}, {y}) with seed {seed} has the same sample positions as {other}, and {repeated} of {calls} repeat those of another; expected: other positions in each pixel and for each seed. Does every position come from the sampler that the function is given?"
    )
}

/// For each call the other call whose samples it has, if there is one.
fn twins(calls: &[PixelSamples]) -> Vec<Option<usize>> {
    let keys: Vec<BTreeSet<[i64; 2]>> = calls
        .iter()
        .map(|call| call.offsets.iter().map(key).collect())
        .collect();
    let mut calls_with: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    for (call, keys) in keys.iter().enumerate() {
        for key in keys {
            calls_with.entry(*key).or_default().push(call);
        }
    }
    let twin = |(call, keys): (usize, &BTreeSet<[i64; 2]>)| {
        let mut shared: BTreeMap<usize, usize> = BTreeMap::new();
        for other in keys.iter().flat_map(|key| &calls_with[key]) {
            *shared.entry(*other).or_default() += 1;
        }
        shared.remove(&call);
        let enough = |count: usize| count as f64 >= SAME_SHARE * keys.len() as f64;
        shared
            .into_iter()
            .find(|(_, count)| enough(*count))
            .map(|(other, _)| other)
    };
    keys.iter().enumerate().map(twin).collect()
}

/// The offset as a multiple of [`SAME_OFFSET`].
fn key(offset: &[f64; 2]) -> [i64; 2] {
    offset.map(|x| (x / SAME_OFFSET).round() as i64)
}

/// Tests whether the mean offsets of calls that follow each other are correlated along an axis.
///
/// The mean offsets m of a correct sampler, measured from the centre of the pixel, are independent,
/// so the products of n pairs have the mean 0 and the variance E(m²)². The correlation r, their
/// mean over E(m²), times √n is normally distributed.
fn correlation(findings: &mut Findings, calls: &[PixelSamples], axis: usize, name: &str) {
    let mean_offset = |call: &PixelSamples| {
        let sum: f64 = call.offsets.iter().map(|offset| offset[axis] - 0.5).sum();
        sum / call.offsets.len() as f64
    };
    let means: Vec<f64> = calls.iter().map(mean_offset).collect();
    let pairs = calls.len().saturating_sub(1);
    // Other aspects judge samples that are missing or outside their pixel. Positions that are off
    // by an amount that grows along the film are correlated, too.
    let mut offsets = calls.iter().flat_map(|call| &call.offsets).flatten();
    let inside = -OUTSIDE_BOUND..=1.0 + OUTSIDE_BOUND;
    let is_placed = offsets.all(|x| inside.contains(x));
    if pairs < MIN_PAIRS || !is_placed || means.iter().any(|mean| mean.is_nan()) {
        return;
    }
    let products: f64 = means.windows(2).map(|pair| pair[0] * pair[1]).sum();
    let squares: f64 = means.iter().map(|mean| mean * mean).sum();
    let variance = squares / calls.len() as f64;
    // Where all offsets are 0 they are also the same.
    if variance == 0.0 {
        return;
    }
    let alarm = chance::test_false_alarm();
    let standard_error = 1.0 / (pairs as f64).sqrt();
    let r = products / pairs as f64 / variance;
    let (z, allowed) = (r.abs() / standard_error, critical_z(alarm));
    let class = (z > allowed).then_some(Class::Named("correlated"));
    findings.set_detectable(Aspect::Independence, detectable_bias(standard_error, alarm));
    findings.judge_class(Aspect::Independence, 0, class, z, || {
        format!(
            "your result: the mean positions along {name} in pixels or seeds that follow each other have a correlation of {r:.2}; expected: 0 (allowed {:.2}). Does every position come from the sampler that the function is given?",
            allowed * standard_error
        )
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{PixelSampler, Vec2};

    /// The samples of 16 x 16 pixels; `sampler` makes the sampler of each, and `place` changes its
    /// positions.
    fn pixels(
        sampler: impl Fn(u32, u32) -> PixelSampler,
        place: impl Fn(u32, Vec2) -> Vec2,
    ) -> Vec<PixelSamples> {
        let all = (0..16).flat_map(|y| (0..16).map(move |x| (x, y)));
        all.map(|(x, y)| {
            let mut sampler = sampler(x, y);
            let offsets = (0..4).map(|_| place(x, sampler.get_sample()).into());
            PixelSamples {
                pixel: [x, y],
                seed: 5,
                offsets: offsets.collect(),
            }
        })
        .collect()
    }

    /// The classes of the faults, each once.
    fn faults(calls: &[PixelSamples]) -> Vec<Class> {
        let mut findings = Findings::default();
        judge(&mut findings, calls);
        let list = findings.into_vec();
        let faults = list.iter().flat_map(|finding| &finding.faults);
        let mut classes: Vec<Class> = faults.map(|fault| fault.class).collect();
        classes.sort_unstable();
        classes.dedup();
        classes
    }

    const AS_IN_ANOTHER_PIXEL: Class = Class::Named("as in another pixel");

    #[test]
    fn correct_samples_are_independent() {
        for seed in 0..200_u64 {
            let own = |x, y| PixelSampler::new(x, y, seed);
            assert_eq!(faults(&pixels(own, |_, s| s)), [], "seed {seed}");
            // One in each quarter of the pixel, always in the same order.
            let mut jittered = pixels(own, |_, s| s);
            for call in &mut jittered {
                for (i, offset) in call.offsets.iter_mut().enumerate() {
                    let corner = [i % 2, i / 2].map(|cell| 0.5 * cell as f64);
                    *offset = [0, 1].map(|axis| corner[axis] + 0.5 * offset[axis]);
                }
            }
            assert_eq!(faults(&jittered), [], "seed {seed}");
        }
    }

    #[test]
    fn the_same_offsets_in_two_pixels_fail() {
        let everywhere = pixels(|_, _| PixelSampler::new(0, 0, 5), |_, s| s);
        assert!(faults(&everywhere).contains(&AS_IN_ANOTHER_PIXEL));
        let in_each_column = pixels(|x, _| PixelSampler::new(x, 0, 5), |_, s| s);
        assert_eq!(faults(&in_each_column), [AS_IN_ANOTHER_PIXEL]);
        let mut one_pair = pixels(|x, y| PixelSampler::new(x, y, 5), |_, s| s);
        one_pair[200].offsets = one_pair[7].offsets.clone();
        one_pair[200].offsets.reverse();
        assert_eq!(faults(&one_pair), [AS_IN_ANOTHER_PIXEL]);
        // One of four samples in common is less than half.
        one_pair[200].offsets[1..].fill([0.123, 0.456]);
        one_pair[200].offsets[1] = [0.9, 0.8];
        assert_eq!(faults(&one_pair), []);
    }

    #[test]
    fn the_same_offsets_with_two_seeds_fail() {
        let mut calls = pixels(|x, y| PixelSampler::new(x, y, 5), |_, s| s);
        for (seed, call) in (0..).zip(&mut calls) {
            call.pixel = [3, 2];
            call.seed = seed;
        }
        assert_eq!(faults(&calls), []);
        calls[9].offsets = calls[4].offsets.clone();
        assert_eq!(faults(&calls), [Class::Named("as with another seed")]);
    }

    #[test]
    fn positions_outside_the_pixel_are_not_correlated() {
        let farther_and_farther = |x: u32, s: Vec2| s + 0.1 * f64::from(x);
        let calls = pixels(|x, y| PixelSampler::new(x, y, 5), farther_and_farther);
        assert_eq!(faults(&calls), []);
    }

    #[test]
    fn mirrored_offsets_are_correlated() {
        let mirrored = |x: u32, s: Vec2| if x.is_multiple_of(2) { s } else { 1.0 - s };
        let calls = pixels(|_, y| PixelSampler::new(0, y, 5), mirrored);
        assert!(faults(&calls).contains(&Class::Named("correlated")));
        let moved = |x: u32, s: Vec2| (s + 0.01 * f64::from(x)).fract();
        let calls = pixels(|_, y| PixelSampler::new(0, y, 5), moved);
        assert_eq!(faults(&calls), [Class::Named("correlated")]);
    }
}
