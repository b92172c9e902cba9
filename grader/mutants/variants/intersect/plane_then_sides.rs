//! First the plane, then which side of each edge the point is on.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let normal = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    let slope = normal.dot(ray.d);
    if slope == 0.0 {
        return None;
    }
    let t = normal.dot(tri.p0 - ray.o) / slope;
    if !ray.in_range(t) {
        return None;
    }
    let p = ray.at(t);
    let side0 = (tri.p2 - tri.p1).cross(p - tri.p1).dot(normal);
    let side1 = (tri.p0 - tri.p2).cross(p - tri.p2).dot(normal);
    let side2 = (tri.p1 - tri.p0).cross(p - tri.p0).dot(normal);
    if side0 >= 0.0 && side1 >= 0.0 && side2 >= 0.0 {
        let area = normal.dot(normal);
        Some(TriangleHit { t, b1: side1 / area, b2: side2 / area })
    } else {
        None
    }
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
