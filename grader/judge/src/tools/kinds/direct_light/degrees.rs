//! Recognises directions with an azimuth in degrees that was taken for radians.
//!
//! Such directions go round the normal 57.3 times, so their distribution is nearly right, and no
//! test of it finds them. But they follow from the numbers of the sampler, which are known.

use crate::tools::findings::{Aspect, Class, Findings};
use kit::{PixelSampler, Vec3};
use wire::direct::DirectWork;

/// From this mean resultant length on (1: all angles are equal; random ones: nearly 0) azimuths
/// follow from the numbers.
const FOLLOWS: f64 = 0.99;

/// The class of azimuths in degrees.
const IN_DEGREES: Class = Class::Named("azimuth in degrees");

/// Judges the local directions of all rays, at points with the same normal: whether their azimuth
/// is 360 times a number that the sampler gave for them, as an angle in radians. They are not
/// judged if there is not one for each sample.
pub(super) fn judge(findings: &mut Findings, work: &DirectWork, directions: &[Option<Vec3>]) {
    let calls = 0..work.points.len() as u32;
    let numbers: Vec<[f64; 2]> = calls
        .flat_map(|call| {
            let mut sampler = PixelSampler::new(call, 0, work.seed);
            sampler.get_sample();
            (0..work.samples).map(move |_| sampler.next_2d().to_array())
        })
        .collect();
    if numbers.len() != directions.len() {
        return;
    }
    let wrong = follow(directions, &numbers);
    let class = wrong.then_some(IN_DEGREES);
    findings.judge_class(Aspect::Spread, 0, class, 1.0, || {
        "your directions go round the normal 57.3 times while the random number goes from 0 to 1; \
         expected: once, from 0 to 2π. Sine and cosine take radians."
    });
}

/// Whether the azimuths are, but for a sign and a constant, 360 times one of the two numbers.
fn follow(directions: &[Option<Vec3>], numbers: &[[f64; 2]]) -> bool {
    let offsets = [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)];
    offsets.iter().any(|&(axis, sign)| {
        let pairs = directions.iter().flatten().zip(numbers);
        let (mut x, mut y) = (0.0, 0.0);
        for (d, u) in pairs {
            let angle = d.y.atan2(d.x) - sign * 360.0 * u[axis];
            x += angle.cos();
            y += angle.sin();
        }
        f64::hypot(x, y) > FOLLOWS * directions.len() as f64
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_degrees_are_recognised() {
        let mut sampler = PixelSampler::new(3, 5, 7);
        let numbers: Vec<[f64; 2]> = (0..1000).map(|_| sampler.next_2d().to_array()).collect();
        let along = |turn: f64, axis: usize| -> Vec<Option<Vec3>> {
            let angles = numbers.iter().map(|u| 0.3 + turn * u[axis]);
            angles
                .map(|phi| Some(Vec3::new(phi.cos(), phi.sin(), 0.5)))
                .collect()
        };
        for axis in [0, 1] {
            assert!(follow(&along(360.0, axis), &numbers));
            assert!(follow(&along(-360.0, axis), &numbers));
            for right in [1.0, -1.0, 2.0] {
                let turn = right * std::f64::consts::TAU;
                assert!(!follow(&along(turn, axis), &numbers));
            }
        }
    }
}
