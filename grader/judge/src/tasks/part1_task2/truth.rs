//! The right directions of camera rays.

use crate::tools::packed_truth;
use kit::Vec3;
// BEGIN SOLUTION(part1.task2)
use kit::camera::half_tan;
// END SOLUTION(part1.task2)
use wire::work::{Camera, Xyz};

/// The unit direction in world space of the ray through a point of the sensor.
pub(super) fn direction(camera: &Camera, sensor: [f64; 2]) -> Vec3 {
    let input = (camera, sensor);
    // BEGIN SOLUTION(part1.task2)
    let [right, up, backward] = camera.c2w.map(Vec3::from);
    let (x, y) = (
        (2.0 * sensor[0] - 1.0) * half_tan(camera.h_fov),
        (2.0 * sensor[1] - 1.0) * half_tan(camera.v_fov),
    );
    let d: Xyz = (x * right + y * up - backward).normalize().into();
    packed_truth::record("part1.task2", "direction", &input, d).into()
    // STUB: packed_truth::find::<_, Xyz>("part1.task2", "direction", &input).into()
    // END SOLUTION(part1.task2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_corner_of_the_sensor_is_the_tangent_of_half_the_field_of_view() {
        let camera = Camera {
            pos: [1.0, 2.0, 3.0],
            c2w: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            h_fov: 90.0,
            v_fov: 90.0,
            n_clip: 0.5,
            f_clip: 90.0,
        };
        let right = Vec3::new(1.0, -1.0, -1.0).normalize();
        assert!((direction(&camera, [1.0, 0.0]) - right).length() < 1e-15);
    }
}
