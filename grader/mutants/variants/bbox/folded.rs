//! The three slabs folded into one interval.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let whole = (ray.min_t, ray.max_t);
    let (min, max) = (0..3).fold(whole, |(min, max), axis| {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        let (t0, t1) = ((b.min[axis] - o) / d, (b.max[axis] - o) / d);
        (min.max(t0.min(t1)), max.min(t0.max(t1)))
    });
    if min > max || min.is_nan() || max.is_nan() {
        return None;
    }
    Some(Interval { min, max })
}
