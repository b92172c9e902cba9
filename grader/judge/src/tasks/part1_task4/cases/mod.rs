//! Spheres. Here is what the quadratic formula in `f64` gets right, [`hits`] and [`boundary`];
//! [`hard`] is where it loses its digits.

mod boundary;
mod hard;
mod hits;

use crate::cases::Spec;
use crate::cases::probes::ProbeRng;
use crate::tally::Aspect::{Decision, GeometricNormal, Normal, Position, Primitive, RayAfter, T};
use crate::tasks::brute_force::pictures;
use wire::Work;

/// The cases of `part1.task4`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    let core = vec![
        case(
            "head_on",
            "Rays through spheres of all sizes and places: b is 2 f.d with f = o - center, c \
             is f.f - r * r.",
            hits::head_on(),
        ),
        case(
            "around_the_rim",
            "Rays just inside the rim hit, those just outside miss. Pitfall: a radius that is not \
             squared, or half of b, moves the rim.",
            hits::around_the_rim(),
        )
        .only(&[Decision, T, RayAfter]),
        case(
            "origin_inside",
            "The ray starts inside: the smaller root is behind it, the larger one is the hit, \
             whether it looks at the centre or away from it.",
            hits::origin_inside(),
        )
        .only(&[Decision, T, Normal, GeometricNormal]),
        case(
            "behind_the_origin",
            "The sphere lies behind the ray: both roots are negative.",
            hits::behind(),
        )
        .only(&[Decision, RayAfter]),
        case(
            "range",
            "The smaller root in min_t..max_t is the hit; if min_t cuts off the smaller one, \
             the larger one may still count. A hit sets max_t, a miss does not.",
            hits::range(),
        )
        .only(&[Decision, T, RayAfter]),
        case(
            "range_ends",
            "A root is exactly min_t or exactly max_t: both ends count. The next float beyond \
             does not.",
            boundary::range_ends(),
        )
        .only(&[Decision, T]),
        case(
            "tangent",
            "Rays that touch the sphere in one point, in small integers: the discriminant is \
             exactly 0, and that is a hit.",
            boundary::tangent(),
        )
        .only(&[Decision]),
        case(
            "length_of_direction",
            "d need not have length 1: t counts lengths of d. Pitfall: a is d.d, not 1, and the \
             whole numerator is divided by 2a.",
            hits::length_of_direction(),
        )
        .only(&[Decision, T, Position]),
        case(
            "abreast",
            "The ray starts where it is nearest to the centre: b is 0, one root is negative, \
             the other positive.",
            boundary::abreast(),
        )
        .only(&[Decision, T]),
        case(
            "nearest_of_many",
            "A ray through a heap of spheres in any order: max_t must shorten with every hit \
             and only with hits.",
            hits::heap(&mut ProbeRng::new("nearest_of_many spheres", 0), 600),
        )
        .only(&[Decision, Primitive, T, RayAfter]),
        case(
            "fresh_spheres",
            "Spheres and rays that differ for each seed.",
            hits::fresh(seed),
        ),
        pictures::pile_of_spheres(),
    ];
    core.into_iter().chain(hard::cases(seed)).collect()
}

pub(crate) fn case(name: &'static str, about: &'static str, work: Work) -> Spec {
    Spec::new("part1.task4", name, about, work)
}
