//! The side on which the ray passes each edge, in Plücker coordinates: a line is its direction and
//! its moment about the world's origin. Far from the origin the moments are large, and their
//! differences cancel.
//!
//! J. Amanatides, K. Choi, "Ray Tracing Triangular Meshes", Western Computer Graphics Symposium,
//! 1997.

use super::test::{TriangleHit, TriangleTest, sum_if_same_sign};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Triangle, Vec3};
use lanes::Scalar;

pub(crate) struct Plucker;

impl TriangleTest for Plucker {
    const INFO: KernelInfo = KernelInfo::new("Plücker", "Amanatides, Choi 1997");

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        let moment = ray.o.cross(ray.d);
        let side = |from: Vec3<R>, to: Vec3<R>| ray.d.dot(from.cross(to)) + moment.dot(to - from);
        let edges = [
            side(tri.p1, tri.p2),
            side(tri.p2, tri.p0),
            side(tri.p0, tri.p1),
        ];
        let sum = sum_if_same_sign(edges)?;
        let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
        let t = n.dot(tri.p0 - ray.o) / n.dot(ray.d);
        ray.in_range(t).then_some(TriangleHit {
            t,
            b1: edges[1] / sum,
            b2: edges[2] / sum,
        })
    }
}
