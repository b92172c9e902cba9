//! The quadratic formula without the cancelling root (Numerical Recipes, 5.6).

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let f = ray.o - s.center;
    let a = ray.d.dot(ray.d);
    let b = 2.0 * f.dot(ray.d);
    let c = f.dot(f) - s.radius * s.radius;
    let disc = b * b - 4.0 * a * c;
    if disc < 0.0 || a == 0.0 {
        return None;
    }
    let q = if b < 0.0 { -0.5 * (b - disc.sqrt()) } else { -0.5 * (b + disc.sqrt()) };
    let (mut t0, mut t1) = (q / a, if q == 0.0 { 0.0 } else { c / q });
    if t0 > t1 {
        std::mem::swap(&mut t0, &mut t1);
    }
    if ray.in_range(t0) {
        Some(t0)
    } else if ray.in_range(t1) {
        Some(t1)
    } else {
        None
    }
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let p = ray.at(t);
    let n = (p - s.center) / s.radius;
    Some(Hit { t, p, n, ng: n, uv: Vec2::ZERO, prim: id })
}
