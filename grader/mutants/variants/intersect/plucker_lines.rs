//! Plücker coordinates of the ray and of the edges, as six numbers each, as seen from the first
//! vertex.

pub use base::*;
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit, Vec2, Vec3};

/// A directed line: its direction, and its moment about the origin.
struct Line {
    d: Vec3,
    m: Vec3,
}

impl Line {
    fn through(p: Vec3, d: Vec3) -> Line {
        Line { d, m: p.cross(d) }
    }

    /// On which side the other line passes: the permuted inner product.
    fn side(&self, other: &Line) -> f64 {
        self.d.dot(other.m) + other.d.dot(self.m)
    }
}

pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let (a, b) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let o = ray.o - tri.p0;
    let line = Line::through(o, ray.d);
    let s0 = line.side(&Line::through(a, b - a));
    let s1 = line.side(&Line::through(b, -b));
    let s2 = line.side(&Line::through(Vec3::ZERO, a));
    let all_left = s0 >= 0.0 && s1 >= 0.0 && s2 >= 0.0;
    let all_right = s0 <= 0.0 && s1 <= 0.0 && s2 <= 0.0;
    let total = s0 + s1 + s2;
    if !(all_left || all_right) || total == 0.0 {
        return None;
    }
    let n = a.cross(b);
    let t = -o.dot(n) / ray.d.dot(n);
    ray.in_range(t).then(|| TriangleHit { t, b1: s1 / total, b2: s2 / total })
}

pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    let ng = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize();
    let n = (tri.n0 * (1.0 - b1 - b2) + tri.n1 * b1 + tri.n2 * b2).normalize();
    Some(Hit { t, p: ray.at(t), n, ng, uv: Vec2::new(b1, b2), prim: id })
}
