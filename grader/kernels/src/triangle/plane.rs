// BEGIN SOLUTION(part1.task3)
//! Where the ray crosses the plane, then on which side of each edge that is.
//!
//! E. Haines, "Essential Ray Tracing Algorithms", in A. Glassner (ed.), An Introduction to Ray Tracing, 1989. The
//! point is rounded before the edges are looked at: neighbours that share an edge look at it from different points.

use super::{Meeting, TriangleTest};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Triangle, V3};

pub(super) struct PlaneThenSides;

impl TriangleTest for PlaneThenSides {
    const ABOUT: About = About {
        name: "plane, then sides",
        paper: "Haines 1989",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
        let facing = n.dot(ray.d);
        if facing == R::of(0.0) {
            return None;
        }
        let t = n.dot(tri.p0 - ray.o) / facing;
        if !ray.in_range(t) {
            return None;
        }
        let p = ray.at(t);
        let area = |from: V3<R>, to: V3<R>| n.dot((to - from).cross(p - from));
        let (w, u, v) = (
            area(tri.p0, tri.p1),
            area(tri.p1, tri.p2),
            area(tri.p2, tri.p0),
        );
        let zero = R::of(0.0);
        if u < zero || v < zero || w < zero {
            return None;
        }
        let all = u + v + w;
        Some(Meeting {
            t,
            b1: v / all,
            b2: w / all,
        })
    }
}
// END SOLUTION(part1.task3)
