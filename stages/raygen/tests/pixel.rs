//! Part 1, task 1: simple cases of the pixel sampling loop.
// BEGIN SOLUTION(part1.task1)
use kit::{FilmSize, PixelSampler, Ray, Spectrum, Vec2, Vec3};

const FILM: FilmSize = FilmSize { w: 8, h: 4 };

/// The film points that `raytrace_pixel` passed to the camera, and its estimate. The radiance of
/// every ray is its x.
fn sample(x: u32, y: u32, ns_aa: u32) -> (Vec<Vec2>, kit::PixelEstimate) {
    let mut points = Vec::new();
    let estimate = raygen::raytrace_pixel(
        x,
        y,
        FILM,
        ns_aa,
        &mut PixelSampler::new(x, y, 0),
        &mut |p| {
            points.push(p);
            Ray::new(Vec3::new(p.x, p.y, 0.0), Vec3::NEG_Z)
        },
        &mut |ray, _| Spectrum::grey(ray.o.x),
    );
    (points, estimate)
}

#[test]
fn single_sample_is_at_the_centre() {
    let (points, estimate) = sample(3, 1, 1);
    assert_eq!(points, [Vec2::new(3.5 / 8.0, 1.5 / 4.0)]);
    assert_eq!(estimate.radiance, Spectrum::grey(3.5 / 8.0));
    assert_eq!(estimate.samples, 1);
}

#[test]
fn single_sample_uses_no_random_number() {
    let mut sampler = PixelSampler::new(3, 1, 0);
    let before = sampler.clone();
    let camera_ray = &mut |_| Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    raygen::raytrace_pixel(3, 1, FILM, 1, &mut sampler, camera_ray, &mut |_, _| {
        Spectrum::WHITE
    });
    assert_eq!(sampler, before);
}

#[test]
fn samples_come_from_the_sampler_and_are_averaged() {
    let (points, estimate) = sample(3, 1, 16);
    let mut sampler = PixelSampler::new(3, 1, 0);
    let expected: Vec<Vec2> = (0..16)
        .map(|_| (Vec2::new(3.0, 1.0) + sampler.get_sample()) / Vec2::new(8.0, 4.0))
        .collect();
    assert_eq!(points, expected);
    let mean = expected.iter().map(|p| p.x).sum::<f64>() / 16.0;
    assert_eq!(estimate.radiance, Spectrum::grey(mean));
    assert_eq!(estimate.samples, 16);
}

#[test]
fn zero_samples_give_black_and_not_nan() {
    let (points, estimate) = sample(3, 1, 0);
    assert_eq!(points, []);
    assert_eq!(estimate, kit::PixelEstimate::default());
}

#[test]
fn trace_ray_continues_the_dimensions_of_the_sample() {
    let mut drawn = Vec::new();
    let camera_ray = &mut |_| Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    raygen::raytrace_pixel(
        0,
        0,
        FILM,
        2,
        &mut PixelSampler::new(0, 0, 9),
        camera_ray,
        &mut |_, s| {
            drawn.push(s.next_1d());
            Spectrum::BLACK
        },
    );
    let mut sampler = PixelSampler::new(0, 0, 9);
    let expected: Vec<f64> = (0..2)
        .map(|_| {
            sampler.get_sample();
            sampler.next_1d()
        })
        .collect();
    assert_eq!(drawn, expected);
}

/// `x / film.w` in integers is 0 for every pixel, and a sample position rounded to integers is a
/// corner.
#[test]
fn samples_are_inside_their_pixel() {
    for (w, h) in [(1, 1), (7, 3), (3, 1000), (1920, 1080)] {
        for (x, y) in [(0, 0), (w - 1, h - 1), (w / 2, h / 3)] {
            let mut points = Vec::new();
            raygen::raytrace_pixel(
                x,
                y,
                FilmSize { w, h },
                64,
                &mut PixelSampler::new(x, y, 5),
                &mut |p| {
                    points.push(p * Vec2::new(f64::from(w), f64::from(h)));
                    Ray::new(Vec3::ZERO, Vec3::NEG_Z)
                },
                &mut |_, _| Spectrum::BLACK,
            );
            let corner = Vec2::new(f64::from(x), f64::from(y));
            // Scaling to film units and back rounds twice.
            let slack = Vec2::splat(1e-12);
            for p in &points {
                assert!(p.cmpge(corner - slack).all() && p.cmple(corner + 1.0 + slack).all());
            }
            let mean = points.iter().sum::<Vec2>() / 64.0 - corner;
            assert!(
                (mean - 0.5).abs().max_element() < 0.2,
                "the samples must cover the pixel: {mean}"
            );
        }
    }
}

/// Clamping samples before averaging makes every highlight too dark.
#[test]
fn bright_samples_are_not_clamped() {
    let mut radiance = [1e6, 0.0, 2.0, 0.0].into_iter();
    let estimate = raygen::raytrace_pixel(
        0,
        0,
        FILM,
        4,
        &mut PixelSampler::new(0, 0, 0),
        &mut |_| Ray::new(Vec3::ZERO, Vec3::NEG_Z),
        &mut |_, _| Spectrum::new(radiance.next().unwrap(), 1.0, 0.0),
    );
    assert_eq!(estimate.radiance, Spectrum::new(250_000.5, 1.0, 0.0));
}
// END SOLUTION(part1.task1)
