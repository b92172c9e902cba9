//! The worked examples of the chapters of Part 1, tasks 1 and 2: the first tests to make green.

use kit::{Camera, FilmSize, Mat3, PixelSampler, Ray, Spectrum, Vec2, Vec3};
use raygen::{generate_ray, raytrace_pixel};

/// Renders the pixel (3, 1) of a film of 4 by 2 pixels. Returns the positions of its samples, and the
/// estimate where the rays bring the radiances 0.2 and 3 in turn.
fn pixel(ns_aa: u32) -> (Vec<Vec2>, kit::PixelEstimate) {
    let film = FilmSize { w: 4, h: 2 };
    let mut sampler = PixelSampler::new(3, 1, 7);
    let mut positions = Vec::new();
    let mut radiances = [0.2, 3.0].into_iter().cycle();
    let estimate = raytrace_pixel(
        3,
        1,
        film,
        ns_aa,
        &mut sampler,
        &mut |position| {
            positions.push(position);
            Ray::new(Vec3::ZERO, Vec3::Z)
        },
        &mut |_, _| Spectrum::grey(radiances.next().expect("it has no end")),
    );
    (positions, estimate)
}

#[test]
fn part1_task1_the_centre_and_the_mean() {
    let (positions, _) = pixel(1);
    assert_eq!(positions, [Vec2::new(0.875, 0.75)]);

    let (positions, estimate) = pixel(2);
    assert_eq!(positions.len(), 2);
    for position in positions {
        assert!((0.75..1.0).contains(&position.x), "{position}");
        assert!((0.5..1.0).contains(&position.y), "{position}");
    }
    assert!((estimate.radiance.g - 1.6).abs() < 1e-12, "{estimate:?}");
    assert_eq!(estimate.samples, 2);
}

#[test]
fn part1_task2_a_point_right_of_the_centre() {
    let camera = Camera {
        pos: Vec3::new(0.0, 1.0, 5.0),
        c2w: Mat3::from_cols(Vec3::Z, Vec3::Y, -Vec3::X),
        h_fov: 90.0,
        v_fov: 60.0,
        n_clip: 0.0,
        f_clip: 100.0,
    };
    let ray = generate_ray(&camera, Vec2::new(0.75, 0.5));
    assert_eq!(ray.o, camera.pos);
    let expected = Vec3::new(0.89443, 0.0, 0.44721);
    assert!((ray.d - expected).length() < 1e-5, "{}", ray.d);
}
