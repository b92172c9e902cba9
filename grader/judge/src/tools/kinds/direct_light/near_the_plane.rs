//! Judges how many uniform directions are near the plane of the surface.
//!
//! The cells of a χ² test are too large to show that directions are kept a little away from the
//! plane. Code does so to avoid a division by 0, and is biased.

use crate::tools::aspects::chance;
use crate::tools::findings::{Aspect, Class, Findings};
use kit::Vec3;

/// The heights above the surface below which directions are counted: a little less than those to
/// which code may raise directions.
const LOW: [f64; 2] = [0.9e-3, 0.9e-2];

/// Tests how many uniform directions are near the plane of the surface: a share `h` has a cosine
/// below `h`. Each of both tests, as each other test of a run, has a false alarm.
pub(super) fn judge(findings: &mut Findings, directions: &[Option<Vec3>]) {
    let all = directions.len();
    for height in LOW {
        let is_low = |d: &&Vec3| d.z.abs() < height;
        let low = directions.iter().flatten().filter(is_low).count();
        let expected = height * all as f64;
        let p = chance::poisson_two_sided(low, expected);
        let class = (p < chance::test_false_alarm()).then_some(match (low as f64) < expected {
            true => Class::Named("too few near the plane"),
            false => Class::Named("too many near the plane"),
        });
        findings.judge_class(Aspect::Spread, 0, class, -p.max(1e-300).log10(), || {
            format!(
                "your result: {low} of {all} directions have a cosine below {height} to the normal; expected: about {expected}, since uniform directions come as near to the plane of the surface as to any other height"
            )
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{PixelSampler, warp};

    /// Whether the test finds fault with directions whose height above the surface is `height` of
    /// that of uniform ones.
    fn is_wrong(height: impl Fn(f64) -> f64) -> bool {
        let mut sampler = PixelSampler::new(0, 0, 3);
        let uniform = (0..32_000).map(|_| warp::uniform_hemisphere(sampler.next_2d()));
        let directions: Vec<_> = uniform
            .map(|d| {
                Some(
                    Vec3 {
                        z: height(d.z),
                        ..d
                    }
                    .normalize(),
                )
            })
            .collect();
        let mut findings = Findings::default();
        judge(&mut findings, &directions);
        !findings.is_right(Aspect::Spread)
    }

    #[test]
    fn directions_that_are_kept_away_from_the_plane_are_wrong() {
        assert!(!is_wrong(|z| z));
        assert!(!is_wrong(|z| -z));
        for least in [1e-3, 1e-2] {
            assert!(is_wrong(|z| z.max(least)), "{least}");
        }
        assert!(is_wrong(|z| if z < 0.02 { 0.0 } else { z }));
    }
}
