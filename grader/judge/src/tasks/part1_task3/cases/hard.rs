//! Cases of triangles that textbook kernels fail: [`closed`] meshes with gaps, [`scale`] and angles
//! that cost digits, and [`odd`] input.

use super::{case, closed, heap_case, hits, odd, scale};
use crate::tools::findings::Aspect::{Barycentrics, HitOrMiss, Normal, Position, T};
use crate::tools::spec::Spec;
use wire::work::TriangleWork;

/// The robust cases of `part1.task3`.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        Spec {
            enclosed: true,
            ..heap_case(
                "shared_edges",
                "Rays from inside a closed mesh, aimed at its edges and vertices: one of the \
                 faces is hit. Pitfall: Möller-Trumbore rounds differently for each face, and \
                 about one such ray in sixteen misses all of them.",
                closed::shared_edges(),
            )
            .only(&[HitOrMiss])
        },
        Spec {
            enclosed: true,
            ..heap_case(
                "needle_and_pancake",
                "The same in closed meshes a million times as long as wide, and a million times \
                 as wide as thick. Pitfall: no epsilon on t or on the determinant closes the \
                 gaps.",
                closed::needle_and_pancake(),
            )
            .only(&[HitOrMiss])
        },
        case(
            "tiny_and_huge",
            "Scenes from 1e-30 to 1e30 in size. Pitfall: a determinant below an absolute epsilon \
             does not mean a miss.",
            scale::tiny_and_huge(),
        )
        .only(&[HitOrMiss, T, Barycentrics]),
        case(
            "slivers",
            "Triangles a million times as long as wide.",
            scale::slivers(),
        )
        .only(&[HitOrMiss, T, Barycentrics, Position]),
        case(
            "far_from_the_world_origin",
            "Triangles at a distance of a million from the world's origin. Pitfall: products of \
             such large coordinates lose digits; subtract the ray's origin before you multiply.",
            scale::far_from_the_world_origin(),
        )
        .only(&[HitOrMiss, T, Barycentrics, Position]),
        case(
            "grazing",
            "Rays at small angles to the plane, from a hundredth of a radian down to a millionth.",
            scale::grazing(),
        )
        .only(&[HitOrMiss, T]),
        case(
            "a_million_away",
            "Hits at t = 1e6: the hit point lies on the surface. Pitfall: rounding moves o + t d \
             off the surface; the weighted sum of the vertices stays on it, but rounding of the \
             weights moves it along the surface.",
            scale::a_million_away(),
        )
        .only(&[Position, T]),
        case(
            "origin_on_the_plane",
            "The ray starts on the triangle: t = 0 counts exactly if min_t <= 0.",
            odd::origin_on_the_plane(),
        )
        .only(&[HitOrMiss]),
        case(
            "exact_slants",
            "Slanted rays through edges and vertices of slanted triangles, with small integer \
             coordinates: they hit, and rays beside the triangle miss.",
            odd::exact_slants(),
        )
        .only(&[HitOrMiss]),
        case(
            "by_a_hair",
            "Rays that pass an edge, inside or outside, at a billionth of the triangle's size or \
             less. Pitfall: an epsilon on the weights is too coarse.",
            scale::by_a_hair(),
        )
        .only(&[HitOrMiss]),
        case(
            "not_a_number",
            "NaN in the ray or in a vertex, a vertex at infinity, d = 0, min_t > max_t: a miss. \
             Pitfall: comparisons with NaN are false; write each test so that NaN fails it.",
            odd::not_a_number(),
        )
        .only(&[HitOrMiss]),
        case(
            "cancelling_normals",
            "Vertex normals that cancel: n is still finite and of length 1 (the geometric normal \
             is accepted).",
            odd::cancelling_normals(),
        )
        .only(&[Normal]),
        case(
            "record_of_a_test",
            "record_triangle with what test_triangle answers: each field of the hit, and max_t, as \
             of intersect_triangle. Part 6 and the renderer call it.",
            TriangleWork {
                by_record: true,
                ..hits::interpolated_normals()
            },
        ),
        case(
            "fresh_hard_triangles",
            "Random slivers and grazing rays, of all sizes and offsets, that depend on the seed.",
            scale::fresh(seed),
        ),
    ]
}
