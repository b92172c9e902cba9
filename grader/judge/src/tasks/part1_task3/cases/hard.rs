//! Triangles: what textbook kernels get wrong. [`closed`] meshes leak, [`scale`] and angle cost
//! digits, and [`odd`] input finds whoever did not think of it.

use super::{case, closed, odd, scale};
use crate::cases::Spec;
use crate::tally::Aspect::{Barycentrics, Decision, Normal, Position, T};

/// The robust cases of `part1.task3`.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        Spec {
            enclosed: true,
            ..case(
                "shared_edges",
                "Rays from inside a closed mesh, aimed at its edges and vertices: one of the faces \
                 must be hit. Pitfall: Möller-Trumbore rounds each face differently and lets about \
                 one such ray in ten out.",
                closed::shared_edges(),
            )
            .only(&[Decision])
        },
        Spec {
            enclosed: true,
            ..case(
                "needle_and_pancake",
                "The same in closed meshes a million times as long as wide, and as wide as thick. \
                 Pitfall: no epsilon on t or on the determinant keeps them closed.",
                closed::needle_and_pancake(),
            )
            .only(&[Decision])
        },
        case(
            "tiny_and_huge",
            "Whole scenes from 1e-30 to 1e30 in size. Pitfall: a determinant below an absolute \
             epsilon is no reason to miss.",
            scale::tiny_and_huge(),
        )
        .only(&[Decision, T, Barycentrics]),
        case(
            "slivers",
            "Triangles a million times as long as wide.",
            scale::slivers(),
        )
        .only(&[Decision, T, Barycentrics, Position]),
        case(
            "far_from_the_world_origin",
            "Triangles a million away from the world's origin. Pitfall: products of such large \
             coordinates keep few digits; subtract the ray's origin first, multiply then.",
            scale::far_from_the_world_origin(),
        )
        .only(&[Decision, T, Barycentrics, Position]),
        case(
            "grazing",
            "Rays that meet the plane at a ten-thousandth of a radian and less.",
            scale::grazing(),
        )
        .only(&[Decision, T]),
        case(
            "a_million_away",
            "Hits at t = 1e6: the hit point is still the one on the surface. Pitfall: o + t d \
             drifts off the surface; a mix of the vertices stays on it, but moves along it where \
             its weights are rounded.",
            scale::a_million_away(),
        )
        .only(&[Position, T]),
        case(
            "origin_on_the_plane",
            "The ray starts on the triangle: t = 0 counts if min_t <= 0, and not otherwise.",
            odd::origin_on_the_plane(),
        )
        .only(&[Decision]),
        case(
            "exact_slants",
            "Slanted rays through edges and vertices of slanted triangles, all in small \
             integers: they count, and what is beside them does not.",
            odd::exact_slants(),
        )
        .only(&[Decision]),
        case(
            "by_a_hair",
            "Rays a billionth of the triangle's size and less inside its edges and outside. \
             Pitfall: an epsilon on the weights is too coarse.",
            scale::by_a_hair(),
        )
        .only(&[Decision]),
        case(
            "not_a_number",
            "NaN in the ray or in a vertex, d = 0, min_t > max_t: a miss. Pitfall: comparisons with \
             NaN are false; write tests so that NaN fails them.",
            odd::not_a_number(),
        )
        .only(&[Decision]),
        case(
            "cancelling_normals",
            "Vertex normals that cancel: n is still finite and of length 1 (the geometric \
             normal will do).",
            odd::cancelling_normals(),
        )
        .only(&[Normal]),
        case(
            "fresh_hard_triangles",
            "Slivers, grazing rays, all scales and offsets, differing for each seed.",
            scale::fresh(seed),
        ),
    ]
}
