//! The plane first, then barycentric weights from dot products of the edges (Ericson, Real-Time
//! Collision Detection, 3.4).

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let e1 = tri.p1 - tri.p0;
    let e2 = tri.p2 - tri.p0;
    let n = e1.cross(e2);
    let nd = n.dot(ray.d);
    if nd == 0.0 {
        return None;
    }
    let t = n.dot(tri.p0 - ray.o) / nd;
    let w = ray.at(t) - tri.p0;
    let (d00, d01, d11) = (e1.dot(e1), e1.dot(e2), e2.dot(e2));
    let (d20, d21) = (w.dot(e1), w.dot(e2));
    let denom = d00 * d11 - d01 * d01;
    let b1 = (d11 * d20 - d01 * d21) / denom;
    let b2 = (d00 * d21 - d01 * d20) / denom;
    let inside = b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    (inside && ray.in_range(t)).then_some(TriangleHit { t, b1, b2 })
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    let b0 = 1.0 - b1 - b2;
    let ng = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize();
    Some(Hit {
        t,
        p: ray.o + t * ray.d,
        n: (b0 * tri.n0 + b1 * tri.n1 + b2 * tri.n2).normalize(),
        ng,
        uv: Vec2::new(b1, b2),
        prim: id,
    })
}
