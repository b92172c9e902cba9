//! Part 1, task 2: camera rays.

// BEGIN SOLUTION(part1.task2)
use kit::{Vec3, math::tan};
// END SOLUTION(part1.task2)

use kit::{Camera, Ray, Vec2};

/// Generates the world-space ray through the point `sensor` of the film, where (0, 0) is the bottom
/// left corner and (1, 1) the top right one. Points beyond the film lie in the same plane.
///
/// Chapter: stages/book/src/part1/task2.md
///
/// In camera space the camera is at the origin, looks along -z and has +y up. The sensor is a
/// rectangle in the plane z = -1 with the corners (-tan(hFov/2), -tan(vFov/2), -1) and
/// (tan(hFov/2), tan(vFov/2), -1); the angles are in degrees. The ray starts at the camera and goes
/// through the point of the film. It is in world space, and `d` is a unit vector. `n_clip` and
/// `f_clip` are the range, measured along the unit ray.
///
/// The two angles are independent: each axis has its own tangent. The centre of the film is exactly
/// on the -z axis. A field of view of 180 degrees, or slightly less, still gives a finite ray: half
/// of it is not exactly π/2 in floating point, so its tangent is large (1.6e16) but finite.
///
/// See it: `cargo grader picture part1.task2`.
pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    // BEGIN SOLUTION(part1.task2)
    let half_width = tan((0.5 * camera.h_fov).to_radians());
    let half_height = tan((0.5 * camera.v_fov).to_radians());
    // 2s - 1 is exactly 0 at the centre.
    let in_camera_space = Vec3::new(
        (2.0 * sensor.x - 1.0) * half_width,
        (2.0 * sensor.y - 1.0) * half_height,
        -1.0,
    );
    Ray {
        o: camera.pos,
        d: (camera.c2w * in_camera_space).normalize(),
        min_t: camera.n_clip,
        max_t: camera.f_clip,
    }
    // STUB: kit::hole!("part1.task2", camera, sensor)
    // END SOLUTION(part1.task2)
}
