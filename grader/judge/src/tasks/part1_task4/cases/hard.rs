//! Cases of spheres where the quadratic formula loses its digits.

use super::{boundary, case};
use crate::tools::findings::Aspect::{HitOrMiss, Normal, Position, T};
use crate::tools::questions::probes::{ProbeRng, Probes, within};
use crate::tools::spec::Spec;
use kit::{Ray, Sphere, Vec3};
use wire::work::SphereWork;

/// The robust cases of `part1.task4`.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "far_away",
            "Spheres at distances of a thousand to a million radii. Pitfall: b * b and a * c are so \
             large that no digit of their difference is correct; use r * r - |f - (f.d / d.d) \
             d|^2 instead.",
            far_away(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "ground_sphere",
            "A sphere of radius 1e5 as the ground, with rays that start close above it. Pitfall: \
             b and the square root cancel in one of the roots; compute the sum in which they add \
             up, and divide c by it.",
            ground(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "on_the_surface",
            "Rays that start on the surface, with a small min_t: outward they miss; inward they \
             hit the far side, not the point where they start.",
            on_the_surface(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "by_a_hair",
            "Rays that pass the silhouette, inside or outside, at a millionth of the radius or \
             less, from up to a thousand radii away.",
            by_a_hair(),
        )
        .only(&[HitOrMiss]),
        case(
            "hit_point_on_the_sphere",
            "Hits from far away: the hit point lies on the sphere. Pitfall: o + t d is off by the \
             rounding of t; scale the vector from the centre to p to the length of the radius.",
            hit_point_on_the_sphere(),
        )
        .only(&[Position, Normal]),
        case(
            "sphere_without_size",
            "Radius 0: a miss unless the ray goes exactly through the centre; no normal is NaN.",
            without_size(),
        )
        .only(&[HitOrMiss, Normal]),
        case(
            "range_ends_beside_the_center",
            "A root is exactly min_t or exactly max_t, with small integer coordinates and rays \
             that pass beside the centre. Pitfall: a division by the radius rounds the root.",
            boundary::range_ends_beside_the_center(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "tiny_and_huge",
            "Spheres from 1e-30 to 1e30 in size.",
            tiny_and_huge(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "not_a_number",
            "NaN in the ray or the sphere, d = 0, min_t > max_t, a negative radius: a miss. \
             Pitfall: comparisons with NaN are false; write each test so that NaN fails it.",
            not_a_number(),
        )
        .only(&[HitOrMiss]),
        case(
            "fresh_hard_spheres",
            "Random spheres, far and near, large and small, hit in the middle and at the \
             silhouette, that depend on the seed.",
            fresh(seed),
        ),
    ]
}

fn far_away() -> SphereWork {
    let mut rng = ProbeRng::new("far_away", 0);
    let mut probes = Probes::default();
    for _ in 0..12 {
        let s = rng.sphere();
        probes.sphere(&s);
        for radii in [1e3, 1e4, 1e5, 1e6] {
            for impact in [0.1, 0.5, 0.9, 0.99, 1.01, 1.1] {
                probes.ray(rng.ray_past(&s, impact, radii * s.radius));
            }
        }
    }
    probes.of_spheres()
}

fn ground() -> SphereWork {
    let mut rng = ProbeRng::new("ground_sphere", 0);
    let mut probes = Probes::default();
    let s = Sphere {
        center: Vec3::new(0.0, -1e5, 0.0),
        radius: 1e5,
    };
    probes.sphere(&s);
    for _ in 0..150 {
        let target = Vec3::new(rng.range(-20.0, 20.0), 0.0, rng.range(-20.0, 20.0));
        let o = Vec3::new(
            rng.range(-1.0, 1.0),
            rng.range(0.01, 3.0),
            rng.range(-1.0, 1.0),
        );
        probes.ray(Ray::new(o, (target - o).normalize()));
    }
    probes.of_spheres()
}

fn on_the_surface() -> SphereWork {
    let mut rng = ProbeRng::new("on_the_surface", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for _ in 0..6 {
            let normal = rng.direction();
            let o = s.center + s.radius * normal;
            let d = loop {
                let d = rng.direction();
                if d.dot(normal).abs() > 0.2 {
                    break d;
                }
            };
            probes.ray(within(Ray::new(o, d), 1e-9, f64::INFINITY));
        }
    }
    // With integer coordinates the root at the origin is exactly 0, and counts if min_t is 0.
    let s = Sphere {
        center: Vec3::new(1.0, 2.0, -3.0),
        radius: 4.0,
    };
    probes.sphere(&s);
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for d in [axis, -axis, 2.0 * axis, -2.0 * axis] {
            for min_t in [0.0, f64::MIN_POSITIVE, 1e-9, -1.0] {
                probes.ray(within(Ray::new(s.center + 4.0 * axis, d), min_t, 100.0));
            }
        }
    }
    probes.of_spheres()
}

fn by_a_hair() -> SphereWork {
    let mut rng = ProbeRng::new("by_a_hair spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for (hair, radii) in [(1e-6, 1e3), (1e-8, 100.0), (1e-10, 10.0), (1e-12, 2.0)] {
            for impact in [1.0 - hair, 1.0 + hair] {
                probes.ray(rng.ray_past(&s, impact, radii * s.radius));
            }
        }
    }
    probes.of_spheres()
}

fn hit_point_on_the_sphere() -> SphereWork {
    let mut rng = ProbeRng::new("hit_point_on_the_sphere", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = rng.sphere();
        probes.sphere(&s);
        for radii in [10.0, 1e3, 1e5] {
            for _ in 0..2 {
                let impact = rng.range(0.0, 0.9);
                probes.ray(rng.ray_past(&s, impact, radii * s.radius));
            }
        }
    }
    probes.of_spheres()
}

fn without_size() -> SphereWork {
    let mut rng = ProbeRng::new("sphere_without_size", 0);
    let mut probes = Probes::default();
    for center in [Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO] {
        let s = Sphere {
            center,
            radius: 0.0,
        };
        probes.sphere(&s);
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            probes.ray(Ray::new(center - 4.0 * axis, axis));
            probes.ray(Ray::new(center + 4.0 * axis, axis));
            probes.ray(Ray::new(center - 4.0 * axis + 0.5, axis));
        }
        for _ in 0..20 {
            let o = center + 5.0 * rng.direction();
            let target = center + 0.1 * rng.direction();
            probes.ray(Ray::new(o, (target - o).normalize()));
        }
    }
    probes.of_spheres()
}

fn tiny_and_huge() -> SphereWork {
    let mut rng = ProbeRng::new("tiny_and_huge spheres", 0);
    let mut probes = Probes::default();
    for scale in [1e-30, 1e-15, 1e-9, 1e-6, 1e6, 1e15, 1e30] {
        for _ in 0..5 {
            let s = rng.sphere();
            let s = Sphere {
                center: scale * s.center,
                radius: scale * s.radius,
            };
            probes.sphere(&s);
            for impact in [0.0, 0.3, 0.9, 1.1] {
                let distance = s.radius * rng.range(-0.5, 5.0);
                probes.ray(rng.ray_past(&s, impact, distance));
            }
        }
    }
    probes.of_spheres()
}

fn not_a_number() -> SphereWork {
    let mut probes = Probes::default();
    let s = Sphere {
        center: Vec3::new(1.0, 2.0, 3.0),
        radius: 2.0,
    };
    let ray = Ray::new(Vec3::new(1.0, 2.5, 9.0), Vec3::NEG_Z);
    let nan = Vec3::new(0.0, f64::NAN, 0.0);
    let spoilt = [
        Sphere {
            center: s.center + nan,
            ..s
        },
        Sphere {
            radius: f64::NAN,
            ..s
        },
        Sphere { radius: -2.0, ..s },
    ];
    for s in spoilt {
        probes.sphere(&s);
        probes.ray(ray);
        probes.ray(Ray::new(s.center, Vec3::X));
    }
    probes.sphere(&s);
    for o in [ray.o, s.center, s.center + 2.0 * Vec3::X] {
        probes.ray(Ray::new(o, Vec3::ZERO));
        probes.ray(Ray::new(o + nan, Vec3::X));
        probes.ray(Ray::new(o, Vec3::X + nan));
    }
    for (min_t, max_t) in [
        (f64::NAN, 10.0),
        (0.0, f64::NAN),
        (f64::NAN, f64::NAN),
        (6.0, 3.0),
    ] {
        probes.ray(within(ray, min_t, max_t));
    }
    probes.ray(ray);
    probes.of_spheres()
}

fn fresh(seed: u64) -> SphereWork {
    let mut rng = ProbeRng::new("fresh_hard_spheres", seed);
    let mut probes = Probes::default();
    for _ in 0..50 {
        let scale = rng.one_of(&[1e-9, 1e-3, 1.0, 1e3, 1e9]);
        let s = rng.sphere();
        let s = Sphere {
            center: scale * s.center,
            radius: scale * s.radius,
        };
        probes.sphere(&s);
        for _ in 0..6 {
            let hair = rng.one_of(&[0.5, 0.1, 1e-3, 1e-6, -1e-6, -1e-3]);
            let radii = rng.one_of(&[0.1, 1.5, 10.0, 1e3, 1e5]);
            let ray = rng.ray_past(&s, 1.0 - hair, radii * s.radius);
            let d = rng.one_of(&[0.125, 1.0, 3.0]) * ray.d;
            probes.ray(Ray { d, ..ray });
        }
    }
    probes.of_spheres()
}
