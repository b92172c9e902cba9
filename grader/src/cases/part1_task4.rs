//! Spheres: what the quadratic formula in `f64` gets right.
//!
//! Where an answer hangs on a tangent or on an end of the range, all numbers are short integers: the formula does
//! not round them.

use super::probes::{Dice, Probes, brute_force, through, within};
use super::{Spec, part1_pictures, part1_task4_hard};
use crate::judge::tally::Aspect::{Decision, Normal, Position, Primitive, RayAfter, T};
use kit::{Ray, Sphere, Vec3};
use wire::Work;

/// The cases of `part1.task4`.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    let mut cases = vec![
        case(
            "head_on",
            "Rays through spheres of all sizes and places: b is 2 f.d with f = o - center, c is \
             f.f - r * r.",
            head_on(),
        ),
        case(
            "around_the_rim",
            "Rays just inside the rim hit, those just outside miss. A radius that is not \
             squared, or half of b, moves the rim.",
            around_the_rim(),
        )
        .only(&[Decision, T, RayAfter]),
        case(
            "origin_inside",
            "The ray starts inside: the smaller root is behind it, the larger one is the hit, \
             whether it looks at the centre or away from it.",
            origin_inside(),
        )
        .only(&[Decision, T, Normal]),
        case(
            "behind_the_origin",
            "The sphere lies behind the ray: both roots are negative.",
            behind(),
        )
        .only(&[Decision, RayAfter]),
        case(
            "range",
            "The smaller root in min_t..max_t is the hit; if min_t cuts off the smaller one, \
             the larger one may still count. A hit sets max_t, a miss does not.",
            range(),
        )
        .only(&[Decision, T, RayAfter]),
        case(
            "range_ends",
            "A root is exactly min_t or exactly max_t: both ends count. The next float beyond \
             does not.",
            range_ends(),
        )
        .only(&[Decision, T]),
        case(
            "tangent",
            "Rays that touch the sphere in one point, in small integers: the discriminant is \
             exactly 0, and that is a hit.",
            tangent(),
        )
        .only(&[Decision]),
        case(
            "length_of_direction",
            "d need not have length 1: a is d.d, and the whole numerator is divided by 2a.",
            length_of_direction(),
        )
        .only(&[Decision, T, Position]),
        case(
            "abreast",
            "The ray starts where it is nearest to the centre: b is 0, one root is negative, \
             the other positive.",
            abreast(),
        )
        .only(&[Decision, T]),
        case(
            "nearest_of_many",
            "A ray through a heap of spheres in any order: max_t must shorten with every hit \
             and only with hits.",
            heap(&mut Dice::new("nearest_of_many spheres", 0), 600),
        )
        .only(&[Decision, Primitive, T, RayAfter]),
        case(
            "fresh_spheres",
            "Spheres and rays that differ for each seed.",
            fresh(seed),
        ),
        part1_pictures::pile_of_spheres(),
    ];
    cases.extend(part1_task4_hard::cases(seed));
    cases
}

pub(super) fn case(name: &'static str, about: &'static str, work: Work) -> Spec {
    Spec::new("part1.task4", name, about, work)
}

fn head_on() -> Work {
    let mut dice = Dice::new("head_on", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = dice.sphere();
        probes.sphere(&s);
        for _ in 0..8 {
            let (impact, distance) = (dice.range(0.0, 0.9), s.radius * dice.range(1.1, 5.0));
            probes.ray(dice.ray_past(&s, impact, distance));
        }
    }
    probes.work()
}

fn around_the_rim() -> Work {
    let mut dice = Dice::new("around_the_rim", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = dice.sphere();
        probes.sphere(&s);
        for impact in [
            0.95, 0.99, 0.999, 0.9999, 1.0001, 1.001, 1.01, 1.05, 1.3, 2.5,
        ] {
            let distance = s.radius * dice.range(1.1, 5.0);
            let ray = dice.ray_past(&s, impact, distance);
            probes.ray(within(
                ray,
                0.0,
                dice.one_of(&[f64::INFINITY, 4.0 * distance]),
            ));
        }
    }
    probes.work()
}

fn origin_inside() -> Work {
    let mut dice = Dice::new("origin_inside", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = dice.sphere();
        probes.sphere(&s);
        for _ in 0..8 {
            let o = s.center + dice.range(0.0, 0.95) * s.radius * dice.direction();
            probes.ray(Ray::new(o, dice.direction()));
        }
        probes.ray(Ray::new(s.center, dice.direction()));
    }
    probes.work()
}

fn behind() -> Work {
    let mut dice = Dice::new("behind_the_origin spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = dice.sphere();
        probes.sphere(&s);
        for _ in 0..6 {
            let (impact, distance) = (dice.range(0.0, 0.95), s.radius * dice.range(1.1, 5.0));
            let ray = dice.ray_past(&s, impact, distance);
            probes.ray(Ray { d: -ray.d, ..ray });
        }
        // One that it does hit, so that a kernel which never hits does not pass.
        probes.ray(dice.ray_past(&s, 0.5, 2.0 * s.radius));
    }
    probes.work()
}

fn range() -> Work {
    let mut dice = Dice::new("range spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let s = dice.sphere();
        probes.sphere(&s);
        let (impact, middle) = (dice.range(0.0, 0.8), s.radius * dice.range(1.5, 5.0));
        let ray = dice.ray_past(&s, impact, middle);
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
        // Both roots are negative, but min_t is farther back.
        let turned = Ray { d: -ray.d, ..ray };
        probes.ray(within(turned, -2.0 * far, 5.0));
        probes.ray(within(turned, -middle, 5.0));
        probes.ray(within(turned, -0.9 * near, 5.0));
    }
    probes.work()
}

/// The unit vectors along the axes, both ways.
const ALONG_AXES: [Vec3; 6] = [
    Vec3::X,
    Vec3::Y,
    Vec3::Z,
    Vec3::NEG_X,
    Vec3::NEG_Y,
    Vec3::NEG_Z,
];

fn range_ends() -> Work {
    let mut probes = Probes::default();
    let s = Sphere {
        center: Vec3::new(3.0, -2.0, 5.0),
        radius: 5.0,
    };
    probes.sphere(&s);
    for d in ALONG_AXES {
        let aside = Vec3::new(d.y.abs(), d.z.abs(), d.x.abs());
        // 3, 4, 5: the ray passes the centre at 3, the roots are 4 before and behind.
        for (impact, half) in [(0.0, 5.0), (3.0, 4.0), (4.0, 3.0)] {
            let o = s.center + impact * aside - 16.0 * d;
            let (near, far): (f64, f64) = (16.0 - half, 16.0 + half);
            for (min_t, max_t) in [
                (near, near),
                (0.0, near),
                (0.0, near.next_down()),
                (near.next_up(), far),
                (far, f64::INFINITY),
                (far.next_up(), f64::INFINITY),
                (near.next_up(), far.next_down()),
            ] {
                probes.ray(within(Ray::new(o, d), min_t, max_t));
            }
        }
    }
    probes.work()
}

fn tangent() -> Work {
    let mut probes = Probes::default();
    for radius in [1.0, 2.0, 3.0, 7.0] {
        let s = Sphere {
            center: Vec3::new(2.0, -3.0, 1.0),
            radius,
        };
        probes.sphere(&s);
        for d in ALONG_AXES {
            for side in [1.0, -1.0] {
                let aside = side * Vec3::new(d.y.abs(), d.z.abs(), d.x.abs());
                let o = s.center + radius * aside - 8.0 * d;
                probes.ray(Ray::new(o, d));
                probes.ray(Ray::new(o, 2.0 * d));
                // A 64th beside the rim, and inside of it.
                probes.ray(Ray::new(o + aside / 64.0, d));
                probes.ray(Ray::new(o - aside / 64.0, d));
            }
        }
    }
    probes.work()
}

fn length_of_direction() -> Work {
    let mut dice = Dice::new("length_of_direction spheres", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let s = dice.sphere();
        probes.sphere(&s);
        for length in [0.05, 0.25, 0.7, 1.5, 3.0, 40.0] {
            let (impact, distance) = (dice.range(0.0, 0.9), s.radius * dice.range(1.1, 5.0));
            let ray = dice.ray_past(&s, impact, distance);
            let longer = Ray {
                d: length * ray.d,
                ..ray
            };
            probes.ray(longer);
            // From the middle of the sphere on: in range only if t counts lengths of d.
            let middle = distance / length;
            probes.ray(within(
                longer,
                middle,
                2.0 * middle + 2.0 * s.radius / length,
            ));
        }
    }
    probes.work()
}

fn abreast() -> Work {
    let mut probes = Probes::default();
    for radius in [1.0, 2.5, 10.0] {
        let s = Sphere {
            center: Vec3::new(-1.0, 2.0, 4.0),
            radius,
        };
        probes.sphere(&s);
        for d in ALONG_AXES {
            let aside = Vec3::new(d.y, d.z, d.x);
            for impact in [0.0, 0.25, 0.5, 1.5] {
                let o = s.center + impact * radius * aside;
                probes.ray(Ray::new(o, d));
                probes.ray(Ray::new(o, 4.0 * d));
                probes.ray(within(Ray::new(o, d), -100.0, 100.0));
            }
        }
    }
    probes.work()
}

/// Spheres in a heap, and rays through it from all around.
fn heap(dice: &mut Dice, rays: usize) -> Work {
    let spheres: Vec<Sphere> = (0..30)
        .map(|_| Sphere {
            center: 2.0 * dice.in_cube(),
            radius: dice.range(0.1, 0.7),
        })
        .collect();
    let rays: Vec<Ray> = (0..rays)
        .map(|_| {
            let from = dice.one_of(&[6.0, 6.0, 1.0]);
            let ray = through(from * dice.direction(), 1.5 * dice.in_cube());
            let max_t = dice.one_of(&[f64::INFINITY, f64::INFINITY, 6.0]);
            within(ray, dice.one_of(&[0.0, 0.0, 5.0]), max_t)
        })
        .collect();
    brute_force(&[], &spheres, &rays)
}

fn fresh(seed: u64) -> Work {
    let mut dice = Dice::new("fresh_spheres", seed);
    let mut probes = Probes::default();
    for _ in 0..50 {
        let s = dice.sphere();
        probes.sphere(&s);
        for _ in 0..6 {
            let (impact, distance) = (dice.range(0.0, 1.5), s.radius * dice.range(-3.0, 5.0));
            let ray = dice.ray_past(&s, impact, distance);
            let d = dice.range(0.2, 5.0) * ray.d;
            probes.ray(within(
                Ray { d, ..ray },
                dice.range(-1.0, 1.0),
                dice.range(1.0, 30.0),
            ));
        }
    }
    probes.work()
}
