//! The geometric way: closest approach, then half the chord back and forth.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let length = ray.d.length();
    if length == 0.0 {
        return None;
    }
    let d = ray.d / length;
    let l = s.center - ray.o;
    let tca = l.dot(d);
    let d2 = l.dot(l) - tca * tca;
    let r2 = s.radius * s.radius;
    if d2 > r2 {
        return None;
    }
    let thc = (r2 - d2).sqrt();
    let near = (tca - thc) / length;
    let far = (tca + thc) / length;
    if ray.in_range(near) {
        return Some(near);
    }
    ray.in_range(far).then_some(far)
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let p = ray.at(t);
    let n = (p - s.center).normalize();
    Some(Hit { t, p, n, ng: n, uv: Vec2::ZERO, prim: id })
}
