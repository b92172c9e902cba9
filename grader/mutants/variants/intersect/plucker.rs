//! Signed volumes of the ray with each edge (Plücker coordinates), all of one sign inside.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let a = tri.p0 - ray.o;
    let b = tri.p1 - ray.o;
    let c = tri.p2 - ray.o;
    let v0 = ray.d.dot(c.cross(b));
    let v1 = ray.d.dot(a.cross(c));
    let v2 = ray.d.dot(b.cross(a));
    let one_side = (v0 >= 0.0 && v1 >= 0.0 && v2 >= 0.0) || (v0 <= 0.0 && v1 <= 0.0 && v2 <= 0.0);
    let sum = v0 + v1 + v2;
    if !one_side || sum == 0.0 {
        return None;
    }
    let normal = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    let t = a.dot(normal) / ray.d.dot(normal);
    ray.in_range(t).then_some(TriangleHit { t, b1: v1 / sum, b2: v2 / sum })
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
