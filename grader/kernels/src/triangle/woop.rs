// BEGIN SOLUTION(part1.task3)
//! Space is moved and sheared so that the ray becomes the z axis; what is left are three signed areas in the plane.
//! Triangles that share a vertex shear it to the same two numbers: no ray gets through between them.
//!
//! S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2(1),
//! 2013. An edge function of 0 counts as a hit for both neighbours; the paper computes it again in double.

use super::{Meeting, TriangleTest, if_all_agree};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Triangle, V3};

pub(crate) struct Woop;

impl TriangleTest for Woop {
    const ABOUT: About = About {
        name: "Woop",
        paper: "Woop, Benthin, Wald 2013",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        sheared(tri, ray, |corners| {
            areas(corners, |a, b, c, d| a * b - c * d)
        })
    }
}

/// Twice the areas of the triangles that the z axis makes with each edge.
#[inline(always)]
pub(super) fn areas<R: Real>(
    [a, b, c]: [V3<R>; 3],
    difference: impl Fn(R, R, R, R) -> R,
) -> [R; 3] {
    [
        difference(c.x, b.y, c.y, b.x),
        difference(a.x, c.y, a.y, c.x),
        difference(b.x, a.y, b.y, a.x),
    ]
}

/// The paper's test, given how to compute the three areas.
#[inline(always)]
pub(super) fn sheared<R: Real>(
    tri: &Triangle<R>,
    ray: &Ray<R>,
    areas: impl Fn([V3<R>; 3]) -> [R; 3],
) -> Option<Meeting<R>> {
    let kz = ray.d.longest_axis();
    let d = ray.d.turned(kz);
    let sz = R::of(1.0) / d.z;
    let (sx, sy) = (d.x * sz, d.y * sz);
    let corners = [tri.p0, tri.p1, tri.p2].map(|p| {
        let p = (p - ray.o).turned(kz);
        V3 {
            x: p.x - sx * p.z,
            y: p.y - sy * p.z,
            z: sz * p.z,
        }
    });
    let [u, v, w] = areas(corners);
    let det = if_all_agree([u, v, w])?;
    let [a, b, c] = corners;
    let inv_det = R::of(1.0) / det;
    let t = (u * a.z + v * b.z + w * c.z) * inv_det;
    ray.in_range(t).then_some(Meeting {
        t,
        b1: v * inv_det,
        b2: w * inv_det,
    })
}
// END SOLUTION(part1.task3)
