//! The quadratic formula with half of b.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let oc = s.center - ray.o;
    let a = ray.d.length_squared();
    let h = ray.d.dot(oc);
    let c = oc.length_squared() - s.radius * s.radius;
    let d = h * h - a * c;
    if d < 0.0 || a == 0.0 {
        return None;
    }
    let sqrt_d = d.sqrt();
    [(h - sqrt_d) / a, (h + sqrt_d) / a].into_iter().find(|&t| ray.in_range(t))
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let p = ray.at(t);
    let n = (p - s.center) / s.radius;
    Some(Hit { t, p, n, ng: n, uv: Vec2::ZERO, prim: id })
}
