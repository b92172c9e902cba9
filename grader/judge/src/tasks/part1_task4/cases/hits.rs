//! Rays through spheres, beside them, from inside them and away from them.

use crate::tools::questions::probes::{ProbeRng, Probes, brute_force, through, within};
use kit::{Ray, Sphere};
use wire::work::{BruteForceWork, SphereWork};

pub(super) fn head_on() -> SphereWork {
    let mut rng = ProbeRng::new("head_on", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for _ in 0..8 {
            let (impact, distance) = (rng.range(0.0, 0.9), s.radius * rng.range(1.1, 5.0));
            probes.ray(rng.ray_past(&s, impact, distance));
        }
    }
    probes.of_spheres()
}

pub(super) fn around_the_rim() -> SphereWork {
    let mut rng = ProbeRng::new("around_the_rim", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for impact in [
            0.95, 0.99, 0.999, 0.9999, 1.0001, 1.001, 1.01, 1.05, 1.3, 2.5,
        ] {
            let distance = s.radius * rng.range(1.1, 5.0);
            let ray = rng.ray_past(&s, impact, distance);
            probes.ray(within(
                ray,
                0.0,
                rng.one_of(&[f64::INFINITY, 4.0 * distance]),
            ));
        }
    }
    probes.of_spheres()
}

pub(super) fn origin_inside() -> SphereWork {
    let mut rng = ProbeRng::new("origin_inside", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for _ in 0..8 {
            let o = s.center + rng.range(0.0, 0.95) * s.radius * rng.direction();
            probes.ray(Ray::new(o, rng.direction()));
        }
        probes.ray(Ray::new(s.center, rng.direction()));
    }
    probes.of_spheres()
}

pub(super) fn normals() -> SphereWork {
    let mut rng = ProbeRng::new("normals of spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for _ in 0..4 {
            let (impact, distance) = (rng.range(0.0, 0.9), s.radius * rng.range(1.1, 5.0));
            probes.ray(rng.ray_past(&s, impact, distance));
            let o = s.center + rng.range(0.0, 0.9) * s.radius * rng.direction();
            probes.ray(Ray::new(o, rng.direction()));
        }
    }
    probes.of_spheres()
}

pub(super) fn behind() -> SphereWork {
    let mut rng = ProbeRng::new("behind_the_origin spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for _ in 0..6 {
            let (impact, distance) = (rng.range(0.0, 0.95), s.radius * rng.range(1.1, 5.0));
            let ray = rng.ray_past(&s, impact, distance);
            probes.ray(Ray { d: -ray.d, ..ray });
        }
        // A hit, so that a kernel which always misses does not pass.
        probes.ray(rng.ray_past(&s, 0.5, 2.0 * s.radius));
    }
    probes.of_spheres()
}

pub(super) fn range() -> SphereWork {
    let mut rng = ProbeRng::new("range spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        let (impact, middle) = (rng.range(0.0, 0.8), s.radius * rng.range(1.5, 5.0));
        let ray = rng.ray_past(&s, impact, middle);
        let half = s.radius * (1.0 - impact * impact).sqrt();
        let (near, far) = (middle - half, middle + half);
        for (min_t, max_t) in [
            (0.0, 0.9 * near),
            (0.0, 0.5 * (near + far)),
            (middle, f64::INFINITY),
            (1.001 * near, 0.999 * far),
            (middle, 0.999 * far),
            (middle, 1.001 * far),
            (1.001 * far, f64::INFINITY),
            (0.999 * near, 1.001 * near),
            (-5.0, 2.0 * far),
        ] {
            probes.ray(within(ray, min_t, max_t));
        }
        // Both roots are behind the origin, and below a negative min_t.
        probes.ray(within(Ray { d: -ray.d, ..ray }, -0.9 * near, 5.0));
    }
    probes.of_spheres()
}

pub(super) fn length_of_direction() -> SphereWork {
    let mut rng = ProbeRng::new("length_of_direction spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let s = rng.sphere();
        probes.sphere(&s);
        for length in [0.05, 0.25, 0.7, 1.5, 3.0, 40.0] {
            let (impact, distance) = (rng.range(0.0, 0.9), s.radius * rng.range(1.1, 5.0));
            let ray = rng.ray_past(&s, impact, distance);
            let longer = Ray {
                d: length * ray.d,
                ..ray
            };
            probes.ray(longer);
            // The range starts in the middle of the sphere: the hit is in range only if t is in
            // units of the length of d.
            let middle = distance / length;
            probes.ray(within(
                longer,
                middle,
                2.0 * middle + 2.0 * s.radius / length,
            ));
        }
    }
    probes.of_spheres()
}

/// A heap of spheres, and rays through it from all directions.
pub(super) fn heap(rng: &mut ProbeRng, rays: usize) -> BruteForceWork {
    let spheres: Vec<Sphere> = (0..30)
        .map(|_| Sphere {
            center: 2.0 * rng.in_cube(),
            radius: rng.range(0.1, 0.7),
        })
        .collect();
    let rays: Vec<Ray> = (0..rays)
        .map(|_| {
            let from = rng.one_of(&[6.0, 6.0, 1.0]);
            let ray = through(from * rng.direction(), 1.5 * rng.in_cube());
            let max_t = rng.one_of(&[f64::INFINITY, f64::INFINITY, 6.0]);
            within(ray, rng.one_of(&[0.0, 0.0, 5.0]), max_t)
        })
        .collect();
    brute_force(&[], &spheres, &rays)
}

pub(super) fn fresh(seed: u64) -> SphereWork {
    let mut rng = ProbeRng::new("fresh_spheres", seed);
    let mut probes = Probes::default();
    for _ in 0..50 {
        let s = rng.sphere();
        probes.sphere(&s);
        for _ in 0..6 {
            let (impact, distance) = (rng.range(0.0, 1.5), s.radius * rng.range(-3.0, 5.0));
            let ray = rng.ray_past(&s, impact, distance);
            let d = rng.range(0.2, 5.0) * ray.d;
            probes.ray(within(
                Ray { d, ..ray },
                rng.range(0.0, 1.0),
                rng.range(1.0, 30.0),
            ));
        }
    }
    probes.of_spheres()
}
