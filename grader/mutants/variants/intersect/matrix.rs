//! Solves [e1 e2 -d] (b1, b2, t) = o - p0 with glam's matrix inverse.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2, Mat3};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let matrix = Mat3::from_cols(tri.p1 - tri.p0, tri.p2 - tri.p0, -ray.d);
    if matrix.determinant() == 0.0 {
        return None;
    }
    let solved = matrix.inverse() * (ray.o - tri.p0);
    let (b1, b2, t) = (solved.x, solved.y, solved.z);
    if !(b1 >= 0.0) || !(b2 >= 0.0) || !(b1 + b2 <= 1.0) {
        return None;
    }
    if !(t >= ray.min_t) || !(t <= ray.max_t) {
        return None;
    }
    Some(TriangleHit { t, b1, b2 })
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
