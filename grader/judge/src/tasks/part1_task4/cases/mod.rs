//! Cases of spheres. The quadratic formula in `f64` passes those here, from [`hits`] and
//! [`boundary`]; in [`hard`] it loses its digits.

mod boundary;
mod hard;
mod hits;
mod picture;

use crate::tools::findings::Aspect::{
    GeometricNormal, HitOrMiss, Normal, Position, Primitive, RayAfter, T,
};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::spec::Spec;
use wire::kind;
use wire::work::{BruteForceWork, SphereWork};

/// The cases of `part1.task4`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    let core = vec![
        case(
            "head_on",
            "Rays through spheres of many sizes and positions: with f = o - center, a is d.d, b \
             is -f.d and c is f.f - r * r.",
            hits::head_on(),
        ),
        case(
            "around_the_rim",
            "Rays just inside the silhouette hit, rays just outside miss. Pitfall: a radius that \
             is not squared moves the silhouette, and so does b * b - 4 a c where b is -f.d: the 4 \
             belongs to a b that is twice as large.",
            hits::around_the_rim(),
        )
        .only(&[HitOrMiss, T, RayAfter]),
        case(
            "origin_inside",
            "The ray starts inside the sphere: the smaller root is negative, the larger one is \
             the hit, whatever the direction.",
            hits::origin_inside(),
        )
        .only(&[HitOrMiss, T, Normal, GeometricNormal]),
        case(
            "behind_the_origin",
            "The sphere is behind the ray's origin: both roots are negative.",
            hits::behind(),
        )
        .only(&[HitOrMiss, RayAfter]),
        case(
            "range",
            "The smaller root in min_t..=max_t is the hit; if the smaller root is below min_t, \
             the larger one may still count. A hit sets max_t, a miss does not change it.",
            hits::range(),
        )
        .only(&[HitOrMiss, T, RayAfter]),
        case(
            "range_ends",
            "A root is exactly min_t or exactly max_t: both ends count. The next float beyond an \
             end does not.",
            boundary::range_ends(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "tangent",
            "Rays that touch the sphere in one point, with small integer coordinates: the \
             discriminant is exactly 0, which is a hit.",
            boundary::tangent(),
        )
        .only(&[HitOrMiss]),
        case(
            "length_of_direction",
            "d need not have length 1: t is in units of the length of d. Pitfall: a is d.d, not \
             1, and the whole numerator is divided by it.",
            hits::length_of_direction(),
        )
        .only(&[HitOrMiss, T, Position]),
        case(
            "abreast",
            "The ray starts where it is closest to the centre: b is 0, and of the two roots one \
             is negative, the other positive.",
            boundary::abreast(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "normals",
            "The normal at the hit: from the centre to the hit point, of length 1 whatever the \
             radius, and outwards also where the ray comes from inside.",
            hits::normals(),
        )
        .only(&[Normal, GeometricNormal]),
        heap_case(
            "nearest_of_many",
            "A ray through a heap of spheres in arbitrary order: each hit shortens max_t, and \
             nothing else changes it.",
            hits::heap(&mut ProbeRng::new("nearest_of_many spheres", 0), 600),
        )
        .only(&[HitOrMiss, Primitive, T, RayAfter]),
        case(
            "fresh_spheres",
            "Random spheres and rays that depend on the seed.",
            hits::fresh(seed),
        ),
        picture::pile_of_spheres(),
    ];
    core.into_iter().chain(hard::cases(seed)).collect()
}

/// A case of probes at single shapes.
fn case(name: &'static str, about: &'static str, work: SphereWork) -> Spec {
    Spec::new::<kind::Spheres>("part1.task4", name, about, work)
}

/// A case of rays through a heap of shapes.
fn heap_case(name: &'static str, about: &'static str, work: BruteForceWork) -> Spec {
    Spec::new::<kind::BruteForce>("part1.task4", name, about, work)
}
