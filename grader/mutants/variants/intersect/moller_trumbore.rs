//! Möller, Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997: without culling.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let e1 = tri.p1 - tri.p0;
    let e2 = tri.p2 - tri.p0;
    let p = ray.d.cross(e2);
    let det = e1.dot(p);
    if det == 0.0 {
        return None;
    }
    let inv_det = 1.0 / det;
    let s = ray.o - tri.p0;
    let b1 = s.dot(p) * inv_det;
    let q = s.cross(e1);
    let b2 = ray.d.dot(q) * inv_det;
    let t = e2.dot(q) * inv_det;
    if b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && ray.min_t <= t && t <= ray.max_t {
        Some(TriangleHit { t, b1, b2 })
    } else {
        None
    }
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    Some(Hit {
        t,
        p: ray.at(t),
        n: ((1.0 - b1 - b2) * tri.n0 + b1 * tri.n1 + b2 * tri.n2).normalize(),
        ng: (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize(),
        uv: Vec2::new(b1, b2),
        prim: id,
    })
}
