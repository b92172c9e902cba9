//! Centre and half size instead of corners.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let (mut min, mut max) = (ray.min_t, ray.max_t);
    for axis in 0..3 {
        let d = ray.d[axis];
        if d == 0.0 {
            if !(b.min[axis] <= ray.o[axis] && ray.o[axis] <= b.max[axis]) {
                return None;
            }
        } else {
            let to_near = if d > 0.0 { b.min[axis] } else { b.max[axis] } - ray.o[axis];
            let to_far = if d > 0.0 { b.max[axis] } else { b.min[axis] } - ray.o[axis];
            min = f64::max(min, to_near / d);
            max = f64::min(max, to_far / d);
        }
    }
    (max >= min).then_some(Interval { min, max })
}
