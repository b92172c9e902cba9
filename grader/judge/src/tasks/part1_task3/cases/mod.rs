//! Triangles. Here is what a textbook kernel in `f64` gets right, from [`hits`] over [`misses`] to
//! [`boundary`]; [`hard`] has what such kernels get wrong.

mod boundary;
mod closed;
mod hard;
mod hits;
mod misses;
mod odd;
mod scale;

use crate::cases::Spec;
use crate::tally::Aspect::{
    Barycentrics, Decision, GeometricNormal, Normal, Position, Primitive, RayAfter, T,
};
use crate::tasks::brute_force::pictures;
use wire::Work;

/// The cases of `part1.task3`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    let core = vec![
        case(
            "front_face",
            "Rays that meet the side towards which the normal points.",
            hits::from_side("front_face", 1.0),
        ),
        case(
            "back_face",
            "Rays that meet the other side: walls and open meshes have two. Normals stay as \
             they are.",
            hits::from_side("back_face", -1.0),
        ),
        case(
            "beside_the_triangle",
            "Rays that pass each edge on the outside, from far off to a hundred-thousandth of \
             the triangle's size. A miss leaves max_t alone.",
            misses::beside(),
        )
        .only(&[Decision, RayAfter]),
        case(
            "behind_the_origin",
            "The triangle lies behind the ray: t would be negative.",
            misses::behind(),
        )
        .only(&[Decision, RayAfter]),
        case(
            "range",
            "Only min_t <= t <= max_t counts, whatever min_t is; a hit sets max_t, a miss \
             does not.",
            misses::range(),
        )
        .only(&[Decision, RayAfter]),
        case(
            "range_ends",
            "t is exactly min_t or exactly max_t: both ends count. The next float beyond does \
             not.",
            boundary::range_ends(),
        )
        .only(&[Decision]),
        case(
            "edges_and_vertices",
            "Rays exactly through edges and vertices, in small integers: they count as hits. \
             Pitfall: strict comparisons leave cracks between neighbours.",
            boundary::edges_and_vertices(),
        )
        .only(&[Decision]),
        case(
            "parallel_rays",
            "Rays parallel to the triangle, above it and inside its plane: all miss. Pitfall: \
             dividing by their determinant, 0, makes NaN, and NaN passes every test that asks for < \
             and >.",
            boundary::parallel(),
        )
        .only(&[Decision, RayAfter]),
        case(
            "no_area",
            "Triangles that are a line or a point: always a miss.",
            boundary::no_area(),
        )
        .only(&[Decision]),
        case(
            "length_of_direction",
            "d need not have length 1: t counts lengths of d, so a d twice as long makes t \
             half as large.",
            hits::length_of_direction(),
        )
        .only(&[Decision, T, Position, RayAfter]),
        case(
            "interpolated_normals",
            "Every vertex has a normal of its own: n mixes them by the barycentric weights \
             and has length 1, on both sides the same.",
            hits::interpolated_normals(),
        )
        .only(&[Normal, GeometricNormal, Barycentrics]),
        case(
            "close_up",
            "Hits from 0.0001 to 0.01 away: min_t says where to begin. Pitfall: a minimal t of \
             one's own makes holes close to the camera.",
            hits::close_up(),
        )
        .only(&[Decision, T]),
        case(
            "nearest_of_many",
            "A ray through a heap of triangles in any order: max_t must shorten with every \
             hit and only with hits.",
            hits::nearest_of_many(),
        )
        .only(&[Decision, Primitive, T, RayAfter]),
        case(
            "fresh_triangles",
            "Triangles and rays that differ for each seed.",
            hits::fresh(seed),
        ),
        pictures::torus(),
    ];
    core.into_iter().chain(hard::cases(seed)).collect()
}

pub(crate) fn case(name: &'static str, about: &'static str, work: Work) -> Spec {
    Spec::new("part1.task3", name, about, work)
}
