//! The discriminant as r² less the squared distance of the line (Haines, Günther, Akenine-Möller,
//! "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7), and the root
//! that does not cancel.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let f = ray.o - s.center;
    let a = ray.d.dot(ray.d);
    let b = -f.dot(ray.d);
    let r2 = s.radius * s.radius;
    let spare = r2 - (f + b / a * ray.d).length_squared();
    if !(spare >= 0.0) {
        return None;
    }
    let c = f.dot(f) - r2;
    let q = b + (a * spare).sqrt().copysign(b);
    let (one, other) = (q / a, if q == 0.0 { 0.0 } else { c / q });
    let (near, far) = if one < other { (one, other) } else { (other, one) };
    [near, far].into_iter().find(|t| ray.in_range(*t))
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let n = (ray.at(t) - s.center).normalize();
    Some(Hit { t, p: s.center + s.radius * n, n, ng: n, uv: Vec2::ZERO, prim: id })
}
