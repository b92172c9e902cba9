//! The plane first, then the edge functions in two dimensions, without the normal's largest axis
//! (Badouel 1990).

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let n = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
    let slope = n.dot(ray.d);
    if slope == 0.0 {
        return None;
    }
    let t = (tri.p0 - ray.o).dot(n) / slope;
    if !ray.in_range(t) {
        return None;
    }
    let size = n.abs();
    let (i, j, area) = if size.x >= size.y && size.x >= size.z {
        (1, 2, n.x)
    } else if size.y >= size.z {
        (2, 0, n.y)
    } else {
        (0, 1, n.z)
    };
    let p = ray.at(t) - tri.p0;
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let b1 = (p[i] * e2[j] - p[j] * e2[i]) / area;
    let b2 = (e1[i] * p[j] - e1[j] * p[i]) / area;
    (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0).then_some(TriangleHit { t, b1, b2 })
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
