//! Intersects the ray with the plane, then tests on which side of each edge the point is.
//!
//! E. Haines, "Essential Ray Tracing Algorithms", in A. Glassner (ed.), An Introduction to Ray
//! Tracing, 1989. The point is rounded before the edge tests: two triangles that share an edge test
//! it with different points.

use super::test::{TriangleHit, TriangleTest};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Triangle, Vec3};
use lanes::Scalar;

pub(super) struct PlaneThenSides;

impl TriangleTest for PlaneThenSides {
    const INFO: KernelInfo = KernelInfo::new("plane, then sides", "Haines 1989");

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
        let facing = n.dot(ray.d);
        if facing == R::from_f64(0.0) {
            return None;
        }
        let t = n.dot(tri.p0 - ray.o) / facing;
        if !ray.in_range(t) {
            return None;
        }
        let p = ray.at(t);
        let area = |from: Vec3<R>, to: Vec3<R>| n.dot((to - from).cross(p - from));
        let (w, u, v) = (
            area(tri.p0, tri.p1),
            area(tri.p1, tri.p2),
            area(tri.p2, tri.p0),
        );
        let zero = R::from_f64(0.0);
        if u < zero || v < zero || w < zero {
            return None;
        }
        let all = u + v + w;
        Some(TriangleHit {
            t,
            b1: v / all,
            b2: w / all,
        })
    }
}
