//! The ray in the coordinates in which the triangle is (0,0,0) (1,0,0) (0,1,0) (Baldwin, Weber,
//! JCGT 5(3), 2016).

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2, Mat3};

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let n = e1.cross(e2);
    if n.length_squared() == 0.0 {
        return None;
    }
    let to_unit = Mat3::from_cols(e1, e2, n).inverse();
    let o = to_unit * (ray.o - tri.p0);
    let d = to_unit * ray.d;
    if d.z == 0.0 {
        return None;
    }
    let t = -o.z / d.z;
    let b1 = o.x + t * d.x;
    let b2 = o.y + t * d.y;
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
