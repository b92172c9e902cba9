//! Nine precomputed numbers, the tenth to twelfth are 0 and 1 (Baldwin, Weber, "Fast Ray-Triangle
//! Intersections by Coordinate Transformation", JCGT 5(3), 2016), as published.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2, Vec3};

/// A row of an affine map.
struct Row(Vec3, f64);

impl Row {
    fn point(&self, p: Vec3) -> f64 {
        self.0.dot(p) + self.1
    }
}

fn rows(tri: &Triangle) -> [Row; 3] {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let n = e1.cross(e2);
    let x1 = tri.p1.cross(tri.p0);
    let x2 = tri.p2.cross(tri.p0);
    let num = tri.p0.dot(n);
    if n.x.abs() > n.y.abs() && n.x.abs() > n.z.abs() {
        [
            Row(Vec3::new(0.0, e2.z / n.x, -e2.y / n.x), x2.x / n.x),
            Row(Vec3::new(0.0, -e1.z / n.x, e1.y / n.x), -x1.x / n.x),
            Row(Vec3::new(1.0, n.y / n.x, n.z / n.x), -num / n.x),
        ]
    } else if n.y.abs() > n.z.abs() {
        [
            Row(Vec3::new(-e2.z / n.y, 0.0, e2.x / n.y), x2.y / n.y),
            Row(Vec3::new(e1.z / n.y, 0.0, -e1.x / n.y), -x1.y / n.y),
            Row(Vec3::new(n.x / n.y, 1.0, n.z / n.y), -num / n.y),
        ]
    } else {
        [
            Row(Vec3::new(e2.y / n.z, -e2.x / n.z, 0.0), x2.z / n.z),
            Row(Vec3::new(-e1.y / n.z, e1.x / n.z, 0.0), -x1.z / n.z),
            Row(Vec3::new(n.x / n.z, n.y / n.z, 1.0), -num / n.z),
        ]
    }
}

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let [along_e1, along_e2, above] = rows(tri);
    let slope = above.0.dot(ray.d);
    let t = -above.point(ray.o) / slope;
    if slope == 0.0 || !ray.in_range(t) {
        return None;
    }
    let p = ray.at(t);
    let (b1, b2) = (along_e1.point(p), along_e2.point(p));
    (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0).then_some(TriangleHit { t, b1, b2 })
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    let ng = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize();
    let n = (tri.n0 * (1.0 - b1 - b2) + tri.n1 * b1 + tri.n2 * b2).normalize();
    Some(Hit { t, p: ray.at(t), n, ng, uv: Vec2::new(b1, b2), prim: id })
}
