//! `lanes::frame` and `kit::Frame`.

use crate::inputs::{Random, coordinates, join, vector};
use crate::widths::{Formula, at_every_width, same};
use kit::Vec3;
use lanes::Real;
use lanes::frame::Frame;

/// From the normal and a direction: the direction from local to world space, and the other way.
struct Transformed;

impl Formula<6, 6> for Transformed {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 6]) -> [R; 6] {
        let (frame, w) = (Frame::around(vector(&input[..3])), vector(&input[3..]));
        let ([x, y, z], local) = (coordinates(frame.to_world(w)), frame.to_local(w));
        [x, y, z, local.x, local.y, local.z]
    }
}

#[test]
fn frames() {
    let mut random = Random::new(4);
    // Hard case 74: normals near -z.
    let near_z = |k: usize, z: f64| Vec3::new(0.5_f64.powi(k as i32 % 60), 0.0, z).normalize();
    let vectors: Vec<(Vec3, Vec3)> = (0..4000)
        .map(|k| {
            let n = [
                random.normal(),
                near_z(k, -1.0),
                near_z(k, 1.0),
                -near_z(k, -0.0),
            ][k % 4];
            (n, random.normal())
        })
        .collect();
    let inputs: Vec<[f64; 6]> = vectors
        .iter()
        .map(|(n, w)| join(&[&n.to_array(), &w.to_array()]))
        .collect();
    for ((n, w), result) in vectors.iter().zip(at_every_width(&Transformed, &inputs)) {
        let frame = kit::Frame::around(*n);
        let expected = [frame.to_world(*w), frame.to_local(*w)].map(|w| w.to_array());
        let expected = expected.as_flattened();
        let is_same = (0..6).all(|i| same(result[i], expected[i]));
        assert!(
            is_same,
            "{result:?}, expected {expected:?} around {n} along {w}"
        );
    }
}
