//! Space is translated and sheared so that the ray becomes the z axis; then the test computes three
//! signed areas in the plane. Triangles that share a vertex shear it to the same two numbers, so no
//! ray passes between them.
//!
//! S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", Journal of Computer
//! Graphics Techniques 2(1), 2013. Here an edge function of 0 counts as a hit for both triangles;
//! the paper recomputes it in double precision.

use super::test::{TriangleHit, TriangleTest, sum_if_same_sign};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Triangle, Vec3};
use lanes::Scalar;
use lanes::triangle::edge_factors;

pub(crate) struct Woop;

impl TriangleTest for Woop {
    const INFO: KernelInfo = KernelInfo::new("Woop", "Woop, Benthin, Wald 2013");

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        sheared(tri, ray, |corners| {
            areas(corners, |a, b, c, d| a * b - c * d)
        })
    }
}

/// Returns twice the signed areas of the triangles formed by the z axis and each edge.
#[inline(always)]
pub(super) fn areas<R: Scalar>(
    corners: [Vec3<R>; 3],
    difference: impl Fn(R, R, R, R) -> R,
) -> [R; 3] {
    edge_factors(corners).map(|[a, b, c, d]| difference(a, b, c, d))
}

/// The paper's test, given a function that computes the three areas.
#[inline(always)]
pub(super) fn sheared<R: Scalar>(
    tri: &Triangle<R>,
    ray: &Ray<R>,
    areas: impl Fn([Vec3<R>; 3]) -> [R; 3],
) -> Option<TriangleHit<R>> {
    let kz = ray.d.longest_axis();
    let d = ray.d.permuted(kz);
    let sz = R::from_f64(1.0) / d.z;
    let (sx, sy) = (d.x * sz, d.y * sz);
    let corners = [tri.p0, tri.p1, tri.p2].map(|p| {
        let p = (p - ray.o).permuted(kz);
        Vec3 {
            x: p.x - sx * p.z,
            y: p.y - sy * p.z,
            z: sz * p.z,
        }
    });
    let [u, v, w] = areas(corners);
    let det = sum_if_same_sign([u, v, w])?;
    let [a, b, c] = corners;
    let inv_det = R::from_f64(1.0) / det;
    let t = (u * a.z + v * b.z + w * c.z) * inv_det;
    ray.in_range(t).then_some(TriangleHit {
        t,
        b1: v * inv_det,
        b2: w * inv_det,
    })
}
