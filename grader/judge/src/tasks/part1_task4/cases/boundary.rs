//! Tangents, ends of the range and rays that start closest to the centre, with small integer
//! coordinates, which the formula does not round.

use crate::tools::questions::probes::{Probes, within};
use kit::{Ray, Sphere, Vec3};
use wire::work::SphereWork;

/// The unit vectors along the axes, both ways.
const ALONG_AXES: [Vec3; 6] = [
    Vec3::X,
    Vec3::Y,
    Vec3::Z,
    Vec3::NEG_X,
    Vec3::NEG_Y,
    Vec3::NEG_Z,
];

/// Rays through the centre of spheres whose radius is a power of two: the roots are exact even
/// after a division by the radius.
pub(super) fn range_ends() -> SphereWork {
    let mut probes = Probes::default();
    for radius in [0.5, 1.0, 8.0] {
        at_the_ends(&mut probes, radius, &[(0.0, radius)]);
    }
    probes.of_spheres()
}

/// Rays beside the centre, with the triangle 3, 4, 5: at a distance of 3 from the centre, the roots
/// are 4 before and behind the closest point.
pub(super) fn range_ends_beside_the_center() -> SphereWork {
    let mut probes = Probes::default();
    at_the_ends(&mut probes, 5.0, &[(0.0, 5.0), (3.0, 4.0), (4.0, 3.0)]);
    probes.of_spheres()
}

/// Adds rays with ranges that end at the roots, for each distance from the centre and the half
/// chord there.
fn at_the_ends(probes: &mut Probes, radius: f64, distance_and_half: &[(f64, f64)]) {
    let s = Sphere {
        center: Vec3::new(3.0, -2.0, 5.0),
        radius,
    };
    probes.sphere(&s);
    for d in ALONG_AXES {
        let aside = Vec3::new(d.y.abs(), d.z.abs(), d.x.abs());
        for (distance, half) in distance_and_half {
            let o = s.center + *distance * aside - 16.0 * d;
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
}

pub(super) fn tangent() -> SphereWork {
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
                // 1/64 outside the silhouette, and 1/64 inside.
                probes.ray(Ray::new(o + aside / 64.0, d));
                probes.ray(Ray::new(o - aside / 64.0, d));
            }
        }
    }
    probes.of_spheres()
}

pub(super) fn abreast() -> SphereWork {
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
                probes.ray(within(Ray::new(o, d), 0.0, 100.0));
            }
        }
    }
    probes.of_spheres()
}
