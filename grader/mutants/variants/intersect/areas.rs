//! The point of the plane is inside if it splits the triangle into three parts that have no larger
//! area together.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    let denom = n.dot(ray.d);
    if denom == 0.0 {
        return None;
    }
    let t = n.dot(tri.p0 - ray.o) / denom;
    if t < ray.min_t || t > ray.max_t {
        return None;
    }
    let p = ray.at(t);
    let area = 0.5 * n.length();
    let a0 = 0.5 * (tri.p1 - p).cross(tri.p2 - p).length();
    let a1 = 0.5 * (tri.p2 - p).cross(tri.p0 - p).length();
    let a2 = 0.5 * (tri.p0 - p).cross(tri.p1 - p).length();
    if (a0 + a1 + a2 - area).abs() > 1e-9 * area {
        return None;
    }
    Some(TriangleHit { t, b1: a1 / area, b2: a2 / area })
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
