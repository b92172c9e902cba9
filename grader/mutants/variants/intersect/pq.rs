//! t² + p t + q = 0, as schools teach it where the leading coefficient is divided away first.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let a = ray.d.length_squared();
    let e = ray.o - s.center;
    let p = 2.0 * ray.d.dot(e) / a;
    let q = (e.length_squared() - s.radius.powi(2)) / a;
    let half_p = p / 2.0;
    let d = half_p * half_p - q;
    if !(d >= 0.0) {
        return None;
    }
    let t1 = -half_p - d.sqrt();
    let t2 = -half_p + d.sqrt();
    if t1 >= ray.min_t && t1 <= ray.max_t {
        return Some(t1);
    }
    if t2 >= ray.min_t && t2 <= ray.max_t {
        return Some(t2);
    }
    None
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let local = ray.o + t * ray.d - s.center;
    let n = local / local.length();
    Some(Hit { t, p: s.center + n * s.radius, n, ng: n, uv: Vec2::ZERO, prim: id })
}
