// BEGIN SOLUTION(part1.task3)
//! The side on which the ray passes each edge, from Plücker coordinates: a line is its direction and its moment about
//! the world's origin. Far from there moments are large, and their differences are what is left.
//!
//! J. Amanatides, K. Choi, "Ray Tracing Triangular Meshes", Western Computer Graphics Symposium, 1997.

use super::{Meeting, TriangleTest, if_all_agree};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Triangle, V3};

pub(super) struct Plucker;

impl TriangleTest for Plucker {
    const ABOUT: About = About {
        name: "Plücker",
        paper: "Amanatides, Choi 1997",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        let moment = ray.o.cross(ray.d);
        let side = |from: V3<R>, to: V3<R>| ray.d.dot(from.cross(to)) + moment.dot(to - from);
        let edges = [
            side(tri.p1, tri.p2),
            side(tri.p2, tri.p0),
            side(tri.p0, tri.p1),
        ];
        let sum = if_all_agree(edges)?;
        let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
        let t = n.dot(tri.p0 - ray.o) / n.dot(ray.d);
        ray.in_range(t).then_some(Meeting {
            t,
            b1: edges[1] / sum,
            b2: edges[2] / sum,
        })
    }
}
// END SOLUTION(part1.task3)
