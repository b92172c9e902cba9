//! Woop, Benthin, Wald 2013 as published: translate, permute, shear and scale, plain edge
//! functions.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let size = ray.d.abs();
    let kz = if size.x > size.y && size.x > size.z {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    };
    let (kx, ky) = ((kz + 1) % 3, (kz + 2) % 3);
    let (a, b, c) = (tri.p0 - ray.o, tri.p1 - ray.o, tri.p2 - ray.o);
    let (sx, sy, sz) = (ray.d[kx] / ray.d[kz], ray.d[ky] / ray.d[kz], 1.0 / ray.d[kz]);
    let (ax, ay) = (a[kx] - sx * a[kz], a[ky] - sy * a[kz]);
    let (bx, by) = (b[kx] - sx * b[kz], b[ky] - sy * b[kz]);
    let (cx, cy) = (c[kx] - sx * c[kz], c[ky] - sy * c[kz]);
    let u = cx * by - cy * bx;
    let v = ax * cy - ay * cx;
    let w = bx * ay - by * ax;
    if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
        return None;
    }
    let det = u + v + w;
    if det == 0.0 {
        return None;
    }
    let t = (u * sz * a[kz] + v * sz * b[kz] + w * sz * c[kz]) / det;
    ray.in_range(t).then_some(TriangleHit { t, b1: v / det, b2: w / det })
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
