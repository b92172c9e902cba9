//! Coordinates in the plane from the normal over its square, as for a quadrilateral (Shirley,
//! Black, Hollasch, Ray Tracing: The Next Week, chapter 6).

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let u = tri.p1 - tri.p0;
    let v = tri.p2 - tri.p0;
    let n = u.cross(v);
    let w = n / n.dot(n);
    let normal = n.normalize();
    let denom = normal.dot(ray.d);
    if denom.abs() < 1e-14 {
        return None;
    }
    let t = (normal.dot(tri.p0) - normal.dot(ray.o)) / denom;
    if !ray.in_range(t) {
        return None;
    }
    let planar = ray.at(t) - tri.p0;
    let alpha = w.dot(planar.cross(v));
    let beta = w.dot(u.cross(planar));
    if alpha < 0.0 || beta < 0.0 || alpha + beta > 1.0 {
        return None;
    }
    Some(TriangleHit { t, b1: alpha, b2: beta })
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    let (u, v) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let n = tri.n0 + b1 * (tri.n1 - tri.n0) + b2 * (tri.n2 - tri.n0);
    let ng = u.cross(v).normalize();
    Some(Hit { t, p: tri.p0 + b1 * u + b2 * v, n: n.normalize(), ng, uv: Vec2::new(b1, b2), prim: id })
}
