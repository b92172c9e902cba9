//! The assignment's slide: s1 = d x e2, s2 = s x e1, everything over s1 . e1.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2, Vec3};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let (e1, e2, s) = (tri.p1 - tri.p0, tri.p2 - tri.p0, ray.o - tri.p0);
    let s1 = ray.d.cross(e2);
    let s2 = s.cross(e1);
    let denominator = s1.dot(e1);
    if denominator == 0.0 {
        return None;
    }
    let solution = Vec3::new(s2.dot(e2), s1.dot(s), s2.dot(ray.d)) / denominator;
    let (t, b1, b2) = (solution.x, solution.y, solution.z);
    let b0 = 1.0 - b1 - b2;
    if b0 >= 0.0 && b1 >= 0.0 && b2 >= 0.0 && t >= ray.min_t && t <= ray.max_t {
        return Some(TriangleHit { t, b1, b2 });
    }
    None
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
