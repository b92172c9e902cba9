//! The quadratic formula from school, with 4ac and 2a.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let oc = ray.o - s.center;
    let a = ray.d.dot(ray.d);
    let b = 2.0 * oc.dot(ray.d);
    let c = oc.dot(oc) - s.radius * s.radius;
    let discriminant = b * b - 4.0 * a * c;
    if !(discriminant >= 0.0) || a == 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let t1 = (-b - root) / (2.0 * a);
    let t2 = (-b + root) / (2.0 * a);
    if t1 >= ray.min_t && t1 <= ray.max_t {
        Some(t1)
    } else if t2 >= ray.min_t && t2 <= ray.max_t {
        Some(t2)
    } else {
        None
    }
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let p = ray.at(t);
    let n = (p - s.center).normalize();
    Some(Hit { t, p, n, ng: n, uv: Vec2::ZERO, prim: id })
}
