//! Judges the sample loop of a pixel.
//!
//! The distribution of samples is judged by z-tests over all pixels of a case, so that every
//! correct sampler passes: independent, jittered or low-discrepancy samples, in any order.

use crate::tools::aspects::independence::{self, PixelSamples};
use crate::tools::findings::{Aspect, Class, Findings, Message, told_apart};
use crate::tools::plural;
use std::collections::{HashMap, HashSet};
use wire::answer::PixelAnswer;
use wire::work::{PixelWork, PixelWorld};

/// How far a point may be from the centre or outside its pixel, in pixels: dividing by `w` and
/// multiplying again rounds a few times, on a film thousands of pixels wide.
const PLACE_BOUND: f64 = 1e-9;

/// How far a radiance may be off, relative to the brightest sample: a sum of some thousand samples
/// rounds as many times.
const RADIANCE_BOUND: f64 = 1e-12;

/// As [`RADIANCE_BOUND`], for each sample: one rounding of the sum, doubled. It is the larger bound
/// of many samples.
const BOUND_PER_SAMPLE: f64 = 2.3e-16;

/// A test fails beyond this many standard deviations: correct independent samples fail it with a
/// probability of 8e-11, at most 1e-9 with the skew of a thousand squares. A mean that is off by a
/// seventh of a pixel over a thousand samples is always detected.
pub(super) const SIGMAS: f64 = 6.5;

/// Judges `raytrace_pixel`.
pub(crate) fn pixels(findings: &mut Findings, work: &PixelWork, answers: &[PixelAnswer]) {
    // Students often write a path of its own for a single sample, with mistakes of its own.
    findings.answers_of(match work.ns_aa {
        0 => "ns_aa=0",
        1 => "ns_aa=1",
        _ => "ns_aa>1",
    });
    for (call, ((pixel, _), answer)) in work.calls().zip(answers).enumerate() {
        calls(findings, call, pixel, work.ns_aa, answer);
        placement(findings, call, pixel, work, answer);
        radiance(findings, call, pixel, answer);
    }
    if work.ns_aa > 1 {
        let samples = samples(work, answers);
        spread(findings, work, answers, &samples);
        independence::judge(findings, &samples);
    }
    if work.world == PixelWorld::Numbers {
        numbers(findings, work, answers);
    }
}

/// The positions of all samples in their pixels.
fn samples(work: &PixelWork, answers: &[PixelAnswer]) -> Vec<PixelSamples> {
    let calls = work.calls().zip(answers);
    let samples = calls.map(|((pixel, seed), answer)| {
        let points = answer.points.iter();
        PixelSamples {
            pixel,
            seed,
            offsets: points
                .map(|point| offset(work.film, pixel, *point))
                .collect(),
        }
    });
    samples.collect()
}

/// Each sample is one call of `camera_ray` and one of `trace_ray`, and is counted once.
fn calls(findings: &mut Findings, call: usize, [x, y]: [u32; 2], ns_aa: u32, answer: &PixelAnswer) {
    findings.expect(Aspect::Calls);
    let input = format!("Pixel ({x}, {y}), ns_aa = {ns_aa}");
    let (points, traced) = (answer.points.len(), answer.traced.len());
    let right = points == ns_aa as usize && traced == ns_aa as usize && answer.samples == ns_aa;
    let off = points.abs_diff(ns_aa as usize) + traced.abs_diff(ns_aa as usize);
    let class = (!right).then(|| match (points.min(traced), points.max(traced)) {
        (_, most) if most > ns_aa as usize => Class::Named("too many"),
        (1, _) if ns_aa > 1 => Class::Named("only one"),
        (least, _) if least < ns_aa as usize => Class::Named("too few"),
        _ => Class::Named("count"),
    });
    findings.judge_class(Aspect::Calls, call, class, off as f64, || {
        Message::new(format!(
            "your result: {} of camera_ray, {traced} of trace_ray, and {} in the estimate; expected: {ns_aa} each",
            plural(points, "call", "calls"),
            plural(answer.samples, "sample", "samples")
        ))
        .asked(input.clone())
    });
    let foreign = answer.traced.iter().filter(|from| from.is_none()).count();
    findings.judge(Aspect::Calls, call, foreign == 0, foreign as f64, || {
        Message::new(format!(
            "trace_ray got {} that camera_ray did not return: pass each ray on unchanged",
            plural(foreign, "ray", "rays")
        ))
        .asked(input.clone())
    });
    let distinct: HashSet<u32> = answer.traced.iter().flatten().copied().collect();
    let repeated = traced - foreign - distinct.len();
    findings.judge(Aspect::Calls, call, repeated == 0, repeated as f64, || {
        Message::new(format!(
            "your result: {repeated} of {traced} traced rays went through a point that was traced before; expected: each ray through a point of its own"
        ))
        .asked(input.clone())
    });
}

/// A single sample goes through the centre of the pixel; several lie inside it.
fn placement(
    findings: &mut Findings,
    call: usize,
    pixel: [u32; 2],
    work: &PixelWork,
    answer: &PixelAnswer,
) {
    if work.ns_aa > 0 {
        findings.expect(Aspect::Placement);
    }
    for &[u, v] in &answer.points {
        let offset = offset(work.film, pixel, [u, v]);
        let from_center = offset.map(|offset| (offset - 0.5).abs());
        let allowed = if work.ns_aa == 1 { 0.0 } else { 0.5 } + PLACE_BOUND;
        let off = from_center[0].max(from_center[1]);
        let right = from_center.iter().all(|off| *off <= allowed);
        let class = (!right).then(|| match work.ns_aa {
            1 => lone_place(offset),
            _ => Class::of_size(off),
        });
        findings.judge_class(Aspect::Placement, call, class, off, || {
            let [x, y] = pixel;
            let [w, h] = work.film;
            let (left, bottom) = (f64::from(x), f64::from(y));
            let [low, middle, high] = [0.0, 0.5, 1.0]
                .map(|at| [(left + at) / f64::from(w), (bottom + at) / f64::from(h)]);
            let (expected, nearest) = if work.ns_aa == 1 {
                let [x, y] = middle;
                (format!("the centre of the pixel, ({x}, {y})"), middle)
            } else {
                let [[x0, y0], [x1, y1]] = [low, high];
                let nearest = [u.max(x0).min(x1), v.max(y0).min(y1)];
                (
                    format!("a point of the pixel, from ({x0}, {y0}) to ({x1}, {y1})"),
                    nearest,
                )
            };
            Message::new(format!(
                "your result: a sample at ({u}, {v}); expected: {expected}"
            ))
            .compares([u, v], nearest)
            .asked(format!(
                "Pixel ({x}, {y}) of a film of {w} x {h}, ns_aa = {}",
                work.ns_aa
            ))
        });
    }
}

/// The class of a lone sample beside the centre: how far it is off along each axis, to the nearest
/// power of two pixels, and to which side. Nothing is random there, so the same mistake gives the
/// same class.
fn lone_place(offset: [f64; 2]) -> Class {
    if offset.iter().any(|offset| offset.is_nan()) {
        return Class::NotANumber;
    }
    let [x, y] = offset.map(|offset| {
        let off = offset - 0.5;
        if off.abs() <= PLACE_BOUND {
            return 0;
        }
        // From 1 on, so that the sign is that of `off`.
        let octave = off.abs().log2().round().clamp(-30.0, 30.0) + 31.0;
        octave.copysign(off) as i8
    });
    Class::Towards([x, y, 0])
}

/// The pixel's radiance is the mean of the radiances of its samples.
fn radiance(findings: &mut Findings, call: usize, [x, y]: [u32; 2], answer: &PixelAnswer) {
    findings.expect(Aspect::Radiance);
    let samples = answer.traced_radiance.len() as f64;
    let mean = [0, 1, 2].map(|channel| {
        let channels = answer.traced_radiance.iter().map(|l| l[channel]);
        // Without samples: black, and not -0, which `sum` starts with.
        let sum = channels.fold(0.0, |sum, channel| sum + channel);
        sum / samples.max(1.0)
    });
    let brightest = |channel: usize| {
        let each = answer.traced_radiance.iter().map(|l| l[channel].abs());
        each.fold(0.0, f64::max)
    };
    let off = [0, 1, 2].map(|channel| (answer.radiance[channel] - mean[channel]).abs());
    let bound = RADIANCE_BOUND.max(BOUND_PER_SAMPLE * samples);
    let right = [0, 1, 2].map(|channel| off[channel] <= bound * brightest(channel));
    let worst = off.into_iter().fold(0.0, f64::max);
    let class = right.iter().position(|right| !right).map(|channel| {
        // A sum in place of the mean has the same class, whatever the samples are.
        let is_lit_and_right = |i: usize| right[i] && brightest(i) > 0.0;
        match (0..3).any(is_lit_and_right) {
            true => Class::Named("not all channels"),
            false => Class::of_number(answer.radiance[channel], mean[channel]),
        }
    });
    findings.judge_class(Aspect::Radiance, call, class, worst, || {
        Message::new(format!(
            "your result: radiance {:?}; expected: {mean:?}, the mean of the {samples} radiances that trace_ray returned",
            answer.radiance
        ))
        .compares(answer.radiance, mean)
        .asked(format!("Pixel ({x}, {y})"))
    });
}

/// Each traced ray draws a random number that no other ray of the case draws: the sampler of a
/// pixel never returns the same number again.
fn numbers(findings: &mut Findings, work: &PixelWork, answers: &[PixelAnswer]) {
    let mut drawn_in: HashMap<u64, [u32; 2]> = HashMap::new();
    for (call, ((pixel, _), answer)) in work.calls().zip(answers).enumerate() {
        findings.expect(Aspect::Independence);
        let mut repeated = None;
        for [number, ..] in &answer.traced_radiance {
            let before = drawn_in.insert(number.to_bits(), pixel);
            repeated = repeated.or(before.map(|before| (*number, before)));
        }
        let class = repeated.map(|_| Class::Named("numbers of another ray"));
        findings.judge_class(Aspect::Independence, call, class, 1.0, || {
            let [x, y] = pixel;
            let (number, [other_x, other_y]) = repeated.unwrap_or_default();
            format!(
                "your result: trace_ray drew {number} for a ray of pixel ({x}, {y}), and before for another ray, of pixel ({other_x}, {other_y}); expected: a number of its own for each ray. Is trace_ray called with the sampler that the function is given?"
            )
        });
    }
}

/// The position of a film point in its pixel, in [0, 1]².
fn offset(film: [u32; 2], pixel: [u32; 2], point: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|axis| point[axis] * f64::from(film[axis]) - f64::from(pixel[axis]))
}

/// The samples of a pixel differ, and those of all pixels are distributed uniformly.
fn spread(
    findings: &mut Findings,
    work: &PixelWork,
    answers: &[PixelAnswer],
    samples: &[PixelSamples],
) {
    findings.expect(Aspect::Spread);
    for (call, (([x, y], _), answer)) in work.calls().zip(answers).enumerate() {
        let distinct: HashSet<_> = answer.points.iter().map(|p| p.map(f64::to_bits)).collect();
        let (all, distinct) = (answer.points.len(), distinct.len());
        let repeated = all - distinct;
        findings.judge(Aspect::Spread, call, repeated == 0, 1e3, || {
            format!(
                "the {all} points of pixel ({x}, {y}) are at only {}: each sample needs a random point of its own",
                plural(distinct, "place", "places")
            )
        });
    }
    let offsets: Vec<[f64; 2]> = samples
        .iter()
        .flat_map(|samples| &samples.offsets)
        .copied()
        .collect();
    let mean_of =
        |f: &dyn Fn(&[f64; 2]) -> f64| offsets.iter().map(f).sum::<f64>() / offsets.len() as f64;
    let mut test = |fault, name: &str, mean: f64, right: f64, variance: f64| {
        let sigma = (variance / offsets.len() as f64).sqrt();
        // A low-discrepancy set of n points may be off by about 1/n, the same in every pixel.
        let slack = 1.0 / f64::from(work.ns_aa);
        let off = (mean - right).abs();
        let allowed = slack + SIGMAS * sigma;
        // NaN fails.
        let is_right = off <= allowed;
        let class = (!is_right).then_some(Class::Named(fault));
        findings.judge_class(Aspect::Spread, 0, class, off / allowed, || {
            let [mean, right] = told_apart(mean, right, 4);
            format!(
                "your result: {name} is {mean} over {} samples; expected: {right} (allowed error {allowed:.4})",
                offsets.len()
            )
        });
    };
    // A uniform u has the mean 1/2 and the variance 1/12; (u - 1/2)² has variance 1/180, (u -
    // 1/2)(v - 1/2) has 1/144.
    for (axis, name) in [(0, "x"), (1, "y")] {
        let center = format!("the mean position in the pixel along {name}");
        test(
            "mean place",
            &center,
            mean_of(&|o| o[axis]),
            0.5,
            1.0 / 12.0,
        );
        let variance = format!("the variance of the position in the pixel along {name}");
        let square = mean_of(&|o| (o[axis] - 0.5).powi(2));
        test("width", &variance, square, 1.0 / 12.0, 1.0 / 180.0);
    }
    let product = mean_of(&|o| (o[0] - 0.5) * (o[1] - 0.5));
    let name = "the covariance of the positions along x and y";
    test("diagonal", name, product, 0.0, 1.0 / 144.0);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::Finding;
    use kit::{PixelSampler, Vec2};

    fn work(ns_aa: u32) -> PixelWork {
        PixelWork {
            film: [8, 9],
            pixels: (0..9).flat_map(|y| (0..8).map(move |x| [x, y])).collect(),
            ns_aa,
            seeds: vec![0],
            world: PixelWorld::Ramp,
            gain: [1.0; 3],
        }
    }

    /// The aspects that fail for a correct loop whose samples `place` moves and whose answer
    /// `spoil` changes.
    fn wrong(
        ns_aa: u32,
        place: impl Fn(Vec2) -> Vec2,
        spoil: impl Fn(&mut PixelAnswer),
    ) -> Vec<Aspect> {
        found(ns_aa, place, spoil).wrong_aspects()
    }

    fn found(
        ns_aa: u32,
        place: impl Fn(Vec2) -> Vec2,
        spoil: impl Fn(&mut PixelAnswer),
    ) -> Findings {
        let work = work(ns_aa);
        let answer = |&[x, y]: &[u32; 2]| {
            let mut sampler = PixelSampler::new(x, y, 5);
            let corner = Vec2::new(f64::from(x), f64::from(y));
            let mut point = || {
                let offset = if ns_aa == 1 {
                    Vec2::splat(0.5)
                } else {
                    sampler.get_sample()
                };
                ((corner + place(offset)) / Vec2::new(8.0, 9.0)).into()
            };
            let points: Vec<[f64; 2]> = (0..ns_aa).map(|_| point()).collect();
            let radiance: Vec<[f64; 3]> = points.iter().map(|[u, v]| [*u, *v, 20.0]).collect();
            let sum = |channel: usize| radiance.iter().map(|l| l[channel]).sum::<f64>();
            let mut answer = PixelAnswer {
                traced: (0..ns_aa).map(Some).collect(),
                radiance: [0, 1, 2].map(|channel| sum(channel) / f64::from(ns_aa)),
                samples: ns_aa,
                traced_radiance: radiance,
                points,
            };
            spoil(&mut answer);
            answer
        };
        let answers: Vec<PixelAnswer> = work.pixels.iter().map(answer).collect();
        let mut findings = Findings::default();
        pixels(&mut findings, &work, &answers);
        findings
    }

    fn unchanged(_: &mut PixelAnswer) {}

    #[test]
    fn correct_sampling_passes() {
        for ns_aa in [1, 2, 4, 16, 64] {
            assert_eq!(wrong(ns_aa, |s| s, unchanged), []);
            assert_eq!(wrong(ns_aa, |s| 1.0 - s, unchanged), []);
        }
    }

    #[test]
    fn samples_at_wrong_positions_fail() {
        assert_eq!(
            wrong(16, |s| s - 0.5, unchanged),
            [Aspect::Placement, Aspect::Spread]
        );
        assert_eq!(wrong(16, |s| 0.5 * s, unchanged), [Aspect::Spread]);
        assert_eq!(wrong(16, |s| s * s, unchanged), [Aspect::Spread]);
        assert_eq!(
            wrong(16, |s| Vec2::new(s.x, s.x), unchanged),
            [Aspect::Spread]
        );
        assert_eq!(
            wrong(16, |_| Vec2::splat(0.25), unchanged),
            [Aspect::Spread, Aspect::Independence]
        );
        assert_eq!(wrong(1, |_| Vec2::ZERO, unchanged), [Aspect::Placement]);
    }

    /// Off by the same distance, so only the direction tells the mistakes apart.
    #[test]
    fn lone_samples_off_in_other_directions_have_other_classes() {
        let off = |x: f64, y: f64| lone_place([0.5 + x, 0.5 + y]);
        let classes = [off(3.5, 0.0), off(-3.5, 0.0), off(0.0, 3.5), off(3.5, 3.5)];
        let distinct: HashSet<Class> = classes.into();
        assert_eq!(distinct.len(), 4, "{classes:?}");
        assert_ne!(off(3.5, 0.0), off(7.5, 0.0), "twice as far");
        assert_eq!(off(f64::NAN, 0.0), Class::NotANumber);
    }

    #[test]
    fn wrong_counts_and_sums_fail() {
        assert_eq!(wrong(4, |s| s, |a| a.samples = 3), [Aspect::Calls]);
        assert_eq!(wrong(4, |s| s, |a| a.traced[2] = None), [Aspect::Calls]);
        assert_eq!(wrong(4, |s| s, |a| a.traced[2] = Some(0)), [Aspect::Calls]);
        assert_eq!(
            wrong(4, |s| s, |a| a.radiance[2] *= 4.0),
            [Aspect::Radiance]
        );
        assert_eq!(
            wrong(4, |s| s, |a| a.radiance[1] = f64::NAN),
            [Aspect::Radiance]
        );
    }

    /// The number of samples may be right: what is wrong is said.
    #[test]
    fn a_sample_that_is_traced_twice_is_told_from_a_wrong_number() {
        let worst = |spoil: fn(&mut PixelAnswer)| {
            let list = found(4, |s| s, spoil).into_vec();
            let calls = list.iter().find(|found| found.aspect == Aspect::Calls);
            calls.map_or_else(String::new, Finding::to_string)
        };
        let says = worst(|answer| answer.traced = vec![Some(0); 4]);
        let repeated = "your result: 3 of 4 traced rays went through a point that was traced before; expected: each ray through a point of its own";
        assert!(says.contains(repeated), "{says}");
        assert!(says.starts_with("samples taken wrong on "), "{says}");
        let says = worst(|answer| answer.points.truncate(1));
        assert!(
            says.contains("your result: 1 call of camera_ray, 4 of"),
            "{says}"
        );
    }

    #[test]
    fn rays_with_the_numbers_of_another_ray_fail() {
        let work = PixelWork {
            world: PixelWorld::Numbers,
            ..work(2)
        };
        let failed = |numbers: &dyn Fn(u32, u32) -> f64| {
            let answers: Vec<PixelAnswer> = (0..72)
                .map(|pixel| PixelAnswer {
                    points: Vec::new(),
                    traced: Vec::new(),
                    traced_radiance: (0..2).map(|ray| [numbers(pixel, ray); 3]).collect(),
                    radiance: [0.0; 3],
                    samples: 2,
                })
                .collect();
            let mut findings = Findings::default();
            super::numbers(&mut findings, &work, &answers);
            findings.into_vec().iter().any(|finding| !finding.passed())
        };
        assert!(!failed(&|pixel, ray| f64::from(2 * pixel + ray)));
        assert!(
            failed(&|pixel, _| f64::from(pixel)),
            "the same for each ray"
        );
        assert!(failed(&|_, ray| f64::from(ray)), "the same in each pixel");
    }
}
