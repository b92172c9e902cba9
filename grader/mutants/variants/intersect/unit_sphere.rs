//! The ray moved and scaled by 1/r, so that every sphere is the unit sphere.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let o = (ray.o - s.center) / s.radius;
    let d = ray.d / s.radius;
    let a = d.length_squared();
    let half_b = o.dot(d);
    let discriminant = half_b * half_b - a * (o.length_squared() - 1.0);
    if !(discriminant >= 0.0) {
        return None;
    }
    let root = discriminant.sqrt();
    [(-half_b - root) / a, (-half_b + root) / a].into_iter().find(|t| ray.in_range(*t))
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let n = (((ray.o - s.center) + t * ray.d) / s.radius).normalize();
    Some(Hit { t, p: s.center + s.radius * n, n, ng: n, uv: Vec2::ZERO, prim: id })
}
