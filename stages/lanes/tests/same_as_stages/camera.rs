//! `lanes::camera` and `raygen::generate_ray`.

use crate::inputs::{Random, coordinates};
use crate::widths::{Formula, at_every_width, same};
use kit::{Camera, Mat3, Vec2, Vec3};
use lanes::Real;
use lanes::camera::CameraAxes;

/// The direction through a point of the film.
struct Direction(Camera);

impl Formula<2, 3> for Direction {
    #[inline(always)]
    fn compute<R: Real>(&self, sensor: [R; 2]) -> [R; 3] {
        coordinates(CameraAxes::of(&self.0, sensor[0]).direction(sensor))
    }
}

#[test]
fn directions() {
    let mut random = Random::new(3);
    for i in 0..100 {
        let back = random.normal();
        let right = back.any_orthonormal_vector();
        let camera = Camera {
            pos: Vec3::ZERO,
            c2w: [
                Mat3::from_cols(right, back.cross(right), back),
                Mat3::IDENTITY,
            ][i % 2],
            h_fov: [60.0, 1e-3, 179.0, 180.0][i % 4],
            v_fov: [45.0, 120.0, 180.0][i % 3],
            n_clip: 0.0,
            f_clip: f64::INFINITY,
        };
        let corners = [[0.0, 0.0], [1.0, 1.0], [0.5, 0.5], [0.5, 0.0]];
        let points = (0..100).map(|_| [random.one(), random.one()]);
        let inputs: Vec<[f64; 2]> = corners.into_iter().chain(points).collect();
        let results = at_every_width(&Direction(camera), &inputs);
        for (&[x, y], d) in inputs.iter().zip(results) {
            let expected = raygen::generate_ray(&camera, Vec2::new(x, y)).d.to_array();
            let is_same = (0..3).all(|i| same(d[i], expected[i]));
            assert!(
                is_same,
                "{d:?}, expected {expected:?} through {x} {y} of {camera:?}"
            );
        }
    }
}
