//! Three precomputed planes and no division before the decision (Havel, Herout, "Yet Faster
//! Ray-Triangle Intersection (Using SSE4)", TVCG 16(3), 2010).

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let n = e1.cross(e2);
    let nn = n.length_squared();
    if nn == 0.0 {
        return None;
    }
    let n1 = e2.cross(n) / nn;
    let n2 = n.cross(e1) / nn;
    let det = ray.d.dot(n);
    if det == 0.0 {
        return None;
    }
    let from_p0 = ray.o - tri.p0;
    let det_t = -from_p0.dot(n);
    let det_p = det * from_p0 + det_t * ray.d;
    let (u, v) = (det_p.dot(n1) * det.signum(), det_p.dot(n2) * det.signum());
    if !(u >= 0.0 && v >= 0.0 && u + v <= det.abs()) {
        return None;
    }
    let t = det_t / det;
    ray.in_range(t).then(|| TriangleHit { t, b1: u / det.abs(), b2: v / det.abs() })
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    let ng = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize();
    let n = (tri.n0 * (1.0 - b1 - b2) + tri.n1 * b1 + tri.n2 * b2).normalize();
    Some(Hit { t, p: ray.at(t), n, ng, uv: Vec2::new(b1, b2), prim: id })
}
