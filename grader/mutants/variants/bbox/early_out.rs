//! One axis after the other, with an early return between them: the form of many tutorials.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() || ray.o.is_nan() || ray.d.is_nan() {
        return None;
    }
    let inv = 1.0 / ray.d;
    let (mut t_min, mut t_max) = ((b.min.x - ray.o.x) * inv.x, (b.max.x - ray.o.x) * inv.x);
    if inv.x < 0.0 {
        (t_min, t_max) = (t_max, t_min);
    }
    let (mut ty_min, mut ty_max) = ((b.min.y - ray.o.y) * inv.y, (b.max.y - ray.o.y) * inv.y);
    if inv.y < 0.0 {
        (ty_min, ty_max) = (ty_max, ty_min);
    }
    if t_min > ty_max || ty_min > t_max {
        return None;
    }
    if ty_min > t_min {
        t_min = ty_min;
    }
    if ty_max < t_max {
        t_max = ty_max;
    }
    let (mut tz_min, mut tz_max) = ((b.min.z - ray.o.z) * inv.z, (b.max.z - ray.o.z) * inv.z);
    if inv.z < 0.0 {
        (tz_min, tz_max) = (tz_max, tz_min);
    }
    if t_min > tz_max || tz_min > t_max {
        return None;
    }
    if tz_min > t_min {
        t_min = tz_min;
    }
    if tz_max < t_max {
        t_max = tz_max;
    }
    if t_max < ray.min_t || t_min > ray.max_t {
        return None;
    }
    Some(Interval { min: t_min.max(ray.min_t), max: t_max.min(ray.max_t) })
}
