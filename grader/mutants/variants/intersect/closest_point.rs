//! The point of the line closest to the centre, and Pythagoras.

pub use base::*;
use kit::{Hit, PrimId, Ray, Sphere, Vec2};

pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    let dd = ray.d.length_squared();
    if dd == 0.0 {
        return None;
    }
    let t_mid = (s.center - ray.o).dot(ray.d) / dd;
    let distance_squared = (ray.at(t_mid) - s.center).length_squared();
    let spare = s.radius * s.radius - distance_squared;
    if spare < 0.0 {
        return None;
    }
    let half = (spare / dd).sqrt();
    if ray.min_t <= t_mid - half && t_mid - half <= ray.max_t {
        return Some(t_mid - half);
    }
    if ray.min_t <= t_mid + half && t_mid + half <= ray.max_t {
        return Some(t_mid + half);
    }
    None
}

pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let p = ray.at(t);
    let n = (p - s.center).normalize();
    Some(Hit { t, p, n, ng: n, uv: Vec2::ZERO, prim: id })
}
