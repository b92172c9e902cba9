//! All three slabs at once with vector minima and maxima.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() || ray.o.is_nan() || ray.d.is_nan() {
        return None;
    }
    let inv = 1.0 / ray.d;
    let t0 = (b.min - ray.o) * inv;
    let t1 = (b.max - ray.o) * inv;
    let min = t0.min(t1).max_element().max(ray.min_t);
    let max = t0.max(t1).min_element().min(ray.max_t);
    (min <= max).then_some(Interval { min, max })
}
