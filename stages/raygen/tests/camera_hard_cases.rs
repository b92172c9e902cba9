//! Cameras with extreme parameters, and properties that hold for all cameras.
// BEGIN SOLUTION(part1.task2)
use kit::camera::PlaceError;
use kit::{Camera, FilmSize, Mat3, PixelSampler, Ray, Spectrum, Vec2, Vec3};
use proptest::{prelude::*, test_runner::RngSeed};
use raygen::generate_ray;

fn camera(h_fov: f64, v_fov: f64) -> Camera {
    Camera {
        pos: Vec3::ZERO,
        c2w: Mat3::IDENTITY,
        h_fov,
        v_fov,
        n_clip: 0.01,
        f_clip: 1e4,
    }
}

/// Hard case 1. Transforming the point on the sensor to world space and subtracting the camera's
/// position leaves a rounding error.
#[test]
fn centre_pixel_of_an_odd_film_is_exactly_on_the_axis() {
    for h_fov in [0.1, 35.0, 50.0, 90.0, 120.0, 179.0] {
        for width in (1..2000_u32).step_by(2) {
            let centre = (f64::from(width / 2) + 0.5) / f64::from(width);
            let camera = Camera {
                pos: Vec3::new(0.1, 1e6, -3.3),
                ..camera(h_fov, 0.7 * h_fov)
            };
            let ray = generate_ray(&camera, Vec2::splat(centre));
            // -0 and 0 compare equal.
            assert_eq!(ray.d, Vec3::NEG_Z, "{h_fov} degrees, {width} pixels");
        }
    }
}

/// Hard case 3. The tangent of 90 degrees is infinite. In floating point it is 1.6e16, and the
/// square of that does not overflow.
#[test]
fn field_of_view_near_180_degrees_is_finite() {
    for fov in [179.0, 179.999_999, 180.0_f64.next_down(), 180.0] {
        for corner in [Vec2::ZERO, Vec2::ONE, Vec2::new(0.0, 0.5), Vec2::splat(0.5)] {
            let d = generate_ray(&camera(fov, fov), corner).d;
            assert!(
                (d.length() - 1.0).abs() < 1e-15,
                "{fov} degrees, {corner}: {d}"
            );
        }
        let left = generate_ray(&camera(fov, 50.0), Vec2::new(0.0, 0.5)).d;
        assert!(left.x < -0.9 && left.z <= 0.0);
    }
}

/// Hard case 4. With one tangent for both axes, spheres appear as ellipses on a film that is not
/// square.
#[test]
fn each_axis_has_its_own_tangent() {
    let camera = camera(90.0, 53.130_102_354_155_98);
    let slope = |s: Vec2| {
        let d = generate_ray(&camera, s).d;
        Vec2::new(d.x / -d.z, d.y / -d.z)
    };
    assert!((slope(Vec2::new(1.0, 0.5)) - Vec2::new(1.0, 0.0)).length() < 1e-15);
    assert!((slope(Vec2::new(0.5, 1.0)) - Vec2::new(0.0, 0.5)).length() < 1e-15);
    assert!((slope(Vec2::new(0.75, 0.25)) - Vec2::new(0.5, -0.25)).length() < 1e-15);
}

/// Hard case 5. The cross product of two parallel directions is 0, which cannot be normalised: NaN
/// in every ray.
#[test]
fn up_parallel_to_the_view_is_an_error() {
    let look_at = |target, up| Camera::look_at(Vec3::new(1.0, 2.0, 3.0), target, up);
    for up in [Vec3::Y, -2.0 * Vec3::Y, Vec3::ZERO, Vec3::NAN] {
        assert_eq!(
            look_at(Vec3::new(1.0, 7.0, 3.0), up),
            Err(PlaceError::UpAlongView)
        );
    }
    let pos = Vec3::new(1.0, 2.0, 3.0);
    assert_eq!(look_at(pos, Vec3::Y), Err(PlaceError::NoDirection));
    assert_eq!(look_at(Vec3::NAN, Vec3::Y), Err(PlaceError::NoDirection));
}

/// Hard case 6. A ray whose range starts at 0 hits objects nearer than the near clip distance.
#[test]
fn clip_distances_are_the_range_of_the_ray() {
    let camera = Camera {
        n_clip: 2.0,
        f_clip: 5.0,
        ..camera(60.0, 40.0)
    };
    for sensor in [Vec2::ZERO, Vec2::splat(0.5), Vec2::new(1.0, 0.3)] {
        let ray = generate_ray(&camera, sensor);
        // Measured along the unit ray, not along z: the same at the corner and at the centre.
        let in_range = [1.9, 2.0, 5.0, 5.1].map(|t| ray.in_range(t));
        assert_eq!(in_range, [false, true, true, false]);
    }
}

/// Hard case 2, through both tasks: the ray of the only pixel is on the axis.
#[test]
fn ray_of_a_single_pixel_is_on_the_axis() {
    let mut direction = None;
    raygen::raytrace_pixel(
        0,
        0,
        FilmSize { w: 1, h: 1 },
        1,
        &mut PixelSampler::new(0, 0, 0),
        &mut |sensor| generate_ray(&camera(50.0, 50.0), sensor),
        &mut |ray: &Ray, _: &mut PixelSampler| {
            direction = Some(ray.d);
            Spectrum::BLACK
        },
    );
    assert_eq!(direction, Some(Vec3::NEG_Z));
}

proptest! {
    // The same inputs on every run.
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn ray_passes_through_the_point_on_the_sensor(
        (h_fov, v_fov) in (1.0..179.0_f64, 1.0..179.0_f64),
        sensor in prop::array::uniform2(0.0..=1.0_f64).prop_map(Vec2::from_array),
        pos in prop::array::uniform3(-9.0..9.0_f64).prop_map(Vec3::from_array),
        target in prop::array::uniform3(-9.0..9.0_f64).prop_map(Vec3::from_array),
    ) {
        let Ok(c2w) = Camera::look_at(pos, target, Vec3::Y) else { return Ok(()) };
        let camera = Camera { pos, c2w, ..camera(h_fov, v_fov) };
        let ray = generate_ray(&camera, sensor);
        prop_assert!((ray.d.length() - 1.0).abs() < 1e-15);
        prop_assert_eq!(ray.o, pos);
        // In camera space the direction is that of the point on the sensor.
        let d = c2w.transpose() * ray.d;
        let half = Vec2::new(h_fov, v_fov).map(|fov| (0.5 * fov).to_radians().tan());
        let expected = Vec3::new(half.x * (2.0 * sensor.x - 1.0), half.y * (2.0 * sensor.y - 1.0), -1.0);
        prop_assert!((d - expected.normalize()).length() < 1e-14);
        // Opposite points of the film give mirrored directions.
        let mirrored = c2w.transpose() * generate_ray(&camera, Vec2::ONE - sensor).d;
        prop_assert!((mirrored - Vec3::new(-d.x, -d.y, d.z)).length() < 1e-14);
    }
}
// END SOLUTION(part1.task2)
