//! Part 1, task 2: simple cases of camera rays.
// BEGIN SOLUTION(part1.task2)
use kit::{Camera, Mat3, Vec2, Vec3};

/// The field of view is 90 degrees wide and 53.13 degrees high: the tangents of half the angles are
/// 1 and 1/2.
fn camera() -> Camera {
    Camera {
        pos: Vec3::new(1.0, 2.0, 3.0),
        c2w: Mat3::IDENTITY,
        h_fov: 90.0,
        v_fov: 2.0 * 0.5_f64.atan().to_degrees(),
        n_clip: 0.5,
        f_clip: 100.0,
    }
}

#[test]
fn film_corners_map_to_sensor_corners() {
    for (x, y) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)] {
        let ray = raygen::generate_ray(&camera(), Vec2::new(x, y));
        let expected = Vec3::new(2.0 * x - 1.0, y - 0.5, -1.0).normalize();
        assert!((ray.d - expected).length() < 1e-15, "{} {expected}", ray.d);
    }
}

#[test]
fn ray_has_the_position_and_clip_distances_of_the_camera() {
    let ray = raygen::generate_ray(&camera(), Vec2::new(0.3, 0.8));
    assert_eq!(ray.o, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!((ray.min_t, ray.max_t), (0.5, 100.0));
    assert!((ray.d.length() - 1.0).abs() < 1e-15);
}

#[test]
fn direction_is_transformed_to_world_space() {
    // The camera looks along +x; its right is +z.
    let camera = Camera {
        c2w: Camera::look_at(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap(),
        ..camera()
    };
    let centre = raygen::generate_ray(&camera, Vec2::splat(0.5));
    assert_eq!(centre.d, Vec3::X);
    let right = raygen::generate_ray(&camera, Vec2::new(1.0, 0.5));
    assert!((right.d - Vec3::new(1.0, 0.0, 1.0).normalize()).length() < 1e-15);
}
// END SOLUTION(part1.task2)
