//! How often sampled directions go round the normal while one random number goes from 0 to 1.
//!
//! An azimuth in degrees that is passed to a cosine goes round 57.3 times. Random numbers hardly
//! show it: 0.3 turns too many among 57 change the density of the azimuth by less than a percent.
//! Regular numbers do: along a line of the unit square on which the angle to the normal stays
//! equal, the azimuth is uniform only if it goes round a whole number of times.
//!
//! This judges only what must go round. Maps that change the angle to the normal along both lines,
//! such as the concentric one, and samples with random numbers of their own are right, too; they
//! have no such line, or jump on it.

use crate::tools::aspects::hits::show;
use crate::tools::findings::{Aspect, Class, Findings};
use kit::Vec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use wire::direct::{LambertAnswer, LambertProbe};

/// Points of a line: enough that 57.3 turns have steps of less than a quarter turn, few enough that
/// random azimuths, each with the same sign and a short step, never occur.
pub(super) const POINTS: u32 = 512;

/// So much may the number of turns differ from a whole one if the steps differ.
const WHOLE: f64 = 0.01;

/// The same if all steps are equal: a π in single precision, or with nine digits, is right.
const WHOLE_IN_EQUAL_STEPS: f64 = 1e-7;

/// Steps are equal up to this fraction of them.
const EQUAL: f64 = 1e-6;

/// So much may the cosine to the normal vary along a line that is judged.
const SAME_COSINE: f64 = 1e-6;

/// The class of directions that do not go round a whole number of times.
const PART_OF_A_TURN: Class = Class::Named("part of a turn");

/// The probes of two lines of the unit square, one along each axis, for a `wo` above the surface.
pub(super) fn lines() -> Vec<LambertProbe> {
    let along = |axis: usize| {
        (0..POINTS).map(move |i| {
            let mut u = [0.625; 2];
            u[axis] = (f64::from(i) + 0.5) / f64::from(POINTS);
            LambertProbe {
                reflectance: [0.5; 3],
                wo: [0.6, 0.0, 0.8],
                wi: [0.0, 0.6, 0.8],
                u,
            }
        })
    };
    along(0).chain(along(1)).collect()
}

/// The index at which the probes of [`lines`] begin, if these probes end with them.
pub(super) fn begin(probes: &[LambertProbe]) -> Option<usize> {
    let lines = lines();
    let begin = probes.len().checked_sub(lines.len())?;
    (probes[begin..] == lines).then_some(begin)
}

/// Judges the answers to [`lines`].
pub(super) fn judge(findings: &mut Findings, probes: &[LambertProbe], answers: &[LambertAnswer]) {
    let points = POINTS as usize;
    for (axis, (probes, answers)) in probes
        .chunks(points)
        .zip(answers.chunks(points))
        .enumerate()
    {
        let samples = answers.iter().filter_map(|answer| answer.sample.as_ref());
        let directions: Vec<Vec3> = samples.map(|sample| sample.wi.into()).collect();
        let Some((turns, allowed)) = turns(&directions) else {
            continue;
        };
        let off = (turns - turns.round()).abs();
        let class = (off > allowed).then_some(match off > WHOLE {
            true => PART_OF_A_TURN,
            false => Class::Rounded,
        });
        findings.judge_class(Aspect::Spread, 0, class, off, || {
            let axis = ["x", "y"][axis];
            format!(
                "your directions go round the normal {} times while u.{axis} goes from 0 to 1; \
                 expected: one whole turn, so that every azimuth has the same density. \
                 lambert_sample: wo = {}",
                if off > WHOLE {
                    format!("{turns:.2}")
                } else {
                    format!("{turns:.9}")
                },
                show(Vec3::from(probes[0].wo))
            )
        });
    }
}

/// How often the directions go round the z axis, and how much this may differ from a whole number,
/// if they do so in one sense, in small steps and at the same angle to it; otherwise `None`.
fn turns(directions: &[Vec3]) -> Option<(f64, f64)> {
    let first = directions
        .first()
        .filter(|_| directions.len() == POINTS as usize)?;
    let steady = |d: &Vec3| (d.z - first.z).abs() <= SAME_COSINE;
    if !directions.iter().all(steady) {
        return None;
    }
    let azimuth = |d: &Vec3| d.y.atan2(d.x);
    let steps: Vec<f64> = directions
        .windows(2)
        .map(|pair| (azimuth(&pair[1]) - azimuth(&pair[0]) + PI).rem_euclid(TAU) - PI)
        .collect();
    let one_sense = |step: &f64| step * steps[0] > 0.0 && step.abs() < FRAC_PI_2;
    // The line goes half a step beyond its first and its last point.
    let steps_of_the_line = f64::from(POINTS) / f64::from(POINTS - 1);
    let is_equal = |step: &f64| (step - steps[0]).abs() <= EQUAL * steps[0].abs();
    let allowed = match steps.iter().all(is_equal) {
        true => WHOLE_IN_EQUAL_STEPS,
        false => WHOLE,
    };
    let turns = (steps.iter().sum::<f64>() * steps_of_the_line / TAU).abs();
    steps.iter().all(one_sense).then_some((turns, allowed))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions along a line of points, by their azimuths and heights.
    fn along(azimuth: impl Fn(f64) -> f64, z: impl Fn(f64) -> f64) -> Vec<Vec3> {
        let u = |i| (f64::from(i) + 0.5) / f64::from(POINTS);
        let direction = |u| {
            let (phi, z): (f64, f64) = (azimuth(u), z(u));
            let r = (1.0 - z * z).sqrt();
            Vec3::new(r * phi.cos(), r * phi.sin(), z)
        };
        (0..POINTS).map(|i| direction(u(i))).collect()
    }

    #[test]
    fn turns_are_counted_in_both_senses() {
        let count = |of_one: f64| turns(&along(|u| 0.7 + of_one * u, |_| 0.6)).unwrap().0;
        for (of_one, right) in [(TAU, 1.0), (-TAU, 1.0), (2.0 * TAU, 2.0), (PI, 0.5)] {
            assert!((count(of_one) - right).abs() < 1e-9, "{of_one}");
        }
        assert!((count(360.0) - 360.0 / TAU).abs() < 1e-9);
    }

    /// A 2π with six digits leaves a gap of 5 millionths of a radian.
    #[test]
    fn a_typed_constant_is_no_whole_turn() {
        let is_whole = |of_one: f64| {
            let (turns, allowed) = turns(&along(|u| of_one * u, |_| 0.6)).unwrap();
            (turns - turns.round()).abs() <= allowed
        };
        assert!(is_whole(TAU) && is_whole(-TAU) && is_whole(f64::from(TAU as f32)));
        assert!(!is_whole(TAU - 5e-6) && !is_whole(TAU + 1e-5));
        // Unequal steps, as of a map with another slope in each half.
        let bent = |u: f64| {
            if u < 0.5 {
                0.9 * TAU * u
            } else {
                TAU * (1.1 * u - 0.1)
            }
        };
        let (_, allowed) = turns(&along(bent, |_| 0.6)).unwrap();
        assert_eq!(allowed, WHOLE);
    }

    #[test]
    fn spirals_and_jumps_are_not_judged() {
        assert_eq!(turns(&along(|u| 9.0 * u, |u| u.sqrt())), None);
        let jumps = |u: f64| 1e6 * (1e3 * u).sin();
        assert_eq!(turns(&along(jumps, |_| 0.6)), None);
        assert_eq!(turns(&along(|_| 1.0, |_| 0.6)), None);
        assert_eq!(turns(&along(|u| u, |_| f64::NAN)), None);
        assert_eq!(turns(&[]), None);
    }
}
