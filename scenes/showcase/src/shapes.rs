//! Simple shapes as triangles.

use kit::math::sin_cos;
use kit::sampler::mix;
use kit::{Triangle, Vec3};
use std::f64::consts::TAU;

/// A random number in [0, 1) for each key.
pub(crate) fn random(key: u64) -> f64 {
    (mix(key) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A number in [0, 1) of thing `i`; another one for each `salt`.
pub(crate) fn unit(i: u64, salt: u64) -> f64 {
    random(i ^ mix(salt))
}

/// The surface of a box, with normals outwards.
pub(crate) fn block(min: Vec3, max: Vec3) -> Vec<Triangle> {
    let corner = |i: usize| {
        let pick = |bit: usize, lo: f64, hi: f64| if i >> bit & 1 == 0 { lo } else { hi };
        Vec3::new(
            pick(0, min.x, max.x),
            pick(1, min.y, max.y),
            pick(2, min.z, max.z),
        )
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = faces.into_iter().flat_map(|face| {
        let [a, b, c, d] = face.map(corner);
        [Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
    });
    triangles.collect()
}

/// A horizontal square at height `y`, facing up.
pub(crate) fn square(half: f64, y: f64) -> Vec<Triangle> {
    let corner = |x: f64, z: f64| Vec3::new(x * half, y, z * half);
    let (a, b) = (corner(-1.0, 1.0), corner(1.0, 1.0));
    let (c, d) = (corner(1.0, -1.0), corner(-1.0, -1.0));
    vec![Triangle::flat(a, b, c), Triangle::flat(a, c, d)]
}

/// A surface of revolution around the vertical axis through `base`: `profile` is a list of radii
/// and heights, from below to above. Smooth around the axis, with an edge at each height.
pub(crate) fn lathe(base: Vec3, profile: &[[f64; 2]]) -> Vec<Triangle> {
    const SIDES: u32 = 64;
    let mut triangles = Vec::new();
    for pair in profile.windows(2) {
        let ([r0, y0], [r1, y1]) = (pair[0], pair[1]);
        let slope = Vec3::new(y1 - y0, r0 - r1, 0.0).normalize_or(Vec3::Y);
        let at = |i: u32, r: f64, y: f64| {
            let (sin, cos) = sin_cos(TAU * f64::from(i) / f64::from(SIDES));
            let n = Vec3::new(cos * slope.x, slope.y, sin * slope.x);
            (base + Vec3::new(r * cos, y, r * sin), n)
        };
        for i in 0..SIDES {
            let corners = [
                at(i, r0, y0),
                at(i, r1, y1),
                at(i + 1, r1, y1),
                at(i + 1, r0, y0),
            ];
            let has_area = [r1 > 0.0, r0 > 0.0];
            for (face, is_there) in [[0, 1, 2], [0, 2, 3]].into_iter().zip(has_area) {
                if is_there {
                    let face = face.map(|i| corners[i]);
                    triangles.push(Triangle::smooth(face.map(|v| v.0), face.map(|v| v.1)));
                }
            }
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(triangles: &[Triangle]) -> f64 {
        let part = |t: &Triangle| t.p0.dot(t.p1.cross(t.p2)) / 6.0;
        triangles.iter().map(part).sum()
    }

    /// The volume is that of the solid, and positive: normals point outwards.
    #[test]
    fn shapes_are_closed_and_face_outwards() {
        let cube = block(Vec3::new(1.0, 2.0, 3.0), Vec3::new(2.0, 4.0, 6.0));
        assert!((volume(&cube) - 6.0).abs() < 1e-12);
        let cone = lathe(
            Vec3::new(5.0, 1.0, 2.0),
            &[[0.0, 0.0], [1.0, 0.0], [0.0, 3.0]],
        );
        let exact = std::f64::consts::PI;
        assert!(
            (volume(&cone) / exact - 1.0).abs() < 0.01,
            "{}",
            volume(&cone)
        );
        for t in cube.iter().chain(&cone) {
            let ng = (t.p1 - t.p0).cross(t.p2 - t.p0);
            assert!(ng.dot(t.n0) > 0.0 && ng.dot(t.n1) > 0.0, "{t:?}");
        }
    }
}
