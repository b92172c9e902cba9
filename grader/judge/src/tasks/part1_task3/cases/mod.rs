//! Cases of triangles. A textbook kernel in `f64` passes those here, from [`hits`], [`misses`] and
//! [`boundary`]; it fails those in [`hard`].

mod boundary;
mod closed;
mod hard;
mod hits;
mod misses;
mod odd;
mod picture;
mod scale;

use crate::tools::findings::Aspect::{
    Barycentrics, GeometricNormal, HitOrMiss, Normal, Position, Primitive, RayAfter, T,
};
use crate::tools::spec::Spec;
use wire::kind;
use wire::work::{BruteForceWork, TriangleWork};

/// The cases of `part1.task3`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    let core = vec![
        case(
            "front_face",
            "Rays that hit the side to which the normal points.",
            hits::from_side("front_face", 1.0),
        ),
        case(
            "back_face",
            "Rays that hit the other side: a triangle has two sides. Normals stay as they are.",
            hits::from_side("back_face", -1.0),
        ),
        case(
            "beside_the_triangle",
            "Rays that pass outside each edge, at distances from three times the triangle's size \
             down to a hundred-thousandth of it. A miss does not change max_t.",
            misses::beside(),
        )
        .only(&[HitOrMiss, RayAfter]),
        case(
            "behind_the_origin",
            "The triangle is behind the ray's origin: t is negative.",
            misses::behind(),
        )
        .only(&[HitOrMiss, RayAfter]),
        case(
            "range",
            "Only min_t <= t <= max_t counts, for any min_t; a hit sets max_t, a miss does not \
             change it.",
            misses::range(),
        )
        .only(&[HitOrMiss, RayAfter]),
        case(
            "range_ends",
            "t is exactly min_t or exactly max_t: both ends count. The next float beyond an end \
             does not.",
            boundary::range_ends(),
        )
        .only(&[HitOrMiss]),
        case(
            "edges_and_vertices",
            "Rays exactly through edges and vertices, with small integer coordinates: they hit. \
             Pitfall: strict comparisons leave cracks between adjacent triangles.",
            boundary::edges_and_vertices(),
        )
        .only(&[HitOrMiss]),
        case(
            "parallel_rays",
            "Rays parallel to the triangle, above it and inside its plane: all miss. Pitfall: \
             dividing by the determinant, 0, gives NaN, and a test that rejects values by < and > \
             does not reject NaN.",
            boundary::parallel(),
        )
        .only(&[HitOrMiss, RayAfter]),
        case(
            "no_area",
            "Triangles that are a segment or a point: always a miss.",
            boundary::no_area(),
        )
        .only(&[HitOrMiss]),
        case(
            "length_of_direction",
            "d need not have length 1: t is in units of the length of d, so that doubling d \
             halves t.",
            hits::length_of_direction(),
        )
        .only(&[HitOrMiss, T, Position, RayAfter]),
        case(
            "interpolated_normals",
            "Each vertex has a normal of its own: n is their sum weighted by the barycentric \
             weights, scaled to length 1, and the same on both sides.",
            hits::interpolated_normals(),
        )
        .only(&[Normal, GeometricNormal, Barycentrics]),
        case(
            "close_up",
            "Hits at distances from 0.0001 to 0.01: the range starts at min_t. Then triangles as \
             small as those of a fine mesh. Pitfall: a lower bound on t of your own leaves holes \
             close to the camera, one on the determinant lets small triangles vanish.",
            hits::close_up(),
        )
        .only(&[HitOrMiss, T]),
        heap_case(
            "nearest_of_many",
            "A ray through a heap of triangles in arbitrary order: each hit shortens max_t, and \
             nothing else changes it.",
            hits::nearest_of_many(),
        )
        .only(&[HitOrMiss, Primitive, T, RayAfter]),
        heap_case(
            "fresh_triangles",
            "Random triangles and rays that depend on the seed.",
            hits::fresh(seed),
        ),
        picture::torus(),
    ];
    core.into_iter().chain(hard::cases(seed)).collect()
}

/// A case of probes at single shapes.
fn case(name: &'static str, about: &'static str, work: TriangleWork) -> Spec {
    Spec::new::<kind::Triangles>("part1.task3", name, about, work)
}

/// A case of rays through a heap of shapes.
fn heap_case(name: &'static str, about: &'static str, work: BruteForceWork) -> Spec {
    Spec::new::<kind::BruteForce>("part1.task3", name, about, work)
}
