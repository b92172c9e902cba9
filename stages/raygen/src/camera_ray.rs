//! Part 1, task 2: camera rays.

// BEGIN SOLUTION(part1.task2)
use kit::{Vec3, math::tan};
// END SOLUTION(part1.task2)

use kit::{Camera, Ray, Vec2};

/// The world-space ray through the point `sensor` of the film, (0, 0) at its bottom left corner and (1, 1)
/// at its top right one.
///
/// In camera space the camera sits at the origin and looks along -z, +y is up. The sensor is the rectangle
/// at z = -1 between the corners
/// (-tan(hFov/2), -tan(vFov/2), -1) and (tan(hFov/2), tan(vFov/2), -1), the angles in degrees. The direction
/// from the origin to the point, turned into world space by `c2w` and brought to unit length, is `d`; `o` is
/// the camera's position, and `n_clip` and `f_clip` are the range, measured along the unit ray.
///
/// The two angles are independent: a film that is not square has a tangent for each axis. The film's centre
/// looks exactly along -z. A field of view of 180 degrees or next to it still gives a finite ray: half of
/// it is not exactly π/2 in floating point, so its tangent is large (1.6e16) but finite.
pub fn generate_ray(camera: &Camera, sensor: Vec2) -> Ray {
    // BEGIN SOLUTION(part1.task2)
    let half_width = tan((0.5 * camera.h_fov).to_radians());
    let half_height = tan((0.5 * camera.v_fov).to_radians());
    // 2s - 1 is exactly 0 in the centre.
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
