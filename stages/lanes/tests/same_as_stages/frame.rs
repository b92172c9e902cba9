// BEGIN SOLUTION(part6.task2)
//! `lanes::frame` and `kit::Frame`.

use crate::inputs::{Random, coordinates, join, vector};
use crate::widths::{Formula, at_every_width, same};
use kit::Vec3;
use lanes::Real;
use lanes::frame::Frame;

/// A direction in world space, from the normal and the local direction.
struct ToWorld;

impl Formula<6, 3> for ToWorld {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 6]) -> [R; 3] {
        coordinates(Frame::around(vector(&input[..3])).to_world(vector(&input[3..])))
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
    for ((n, w), result) in vectors.iter().zip(at_every_width(&ToWorld, &inputs)) {
        let expected = kit::Frame::around(*n).to_world(*w).to_array();
        let is_same = (0..3).all(|i| same(result[i], expected[i]));
        assert!(
            is_same,
            "{result:?}, expected {expected:?} around {n} along {w}"
        );
    }
}
// END SOLUTION(part6.task2)
