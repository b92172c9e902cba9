//! Planes and origin are each multiplied by 1/d, as where a fused multiply-add computes the
//! difference.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let (mut min, mut max) = (ray.min_t, ray.max_t);
    for axis in 0..3 {
        if ray.d[axis] == 0.0 {
            let inside = b.min[axis] <= ray.o[axis] && ray.o[axis] <= b.max[axis];
            if !inside {
                return None;
            }
        } else {
            let inv = 1.0 / ray.d[axis];
            let shift = ray.o[axis] * inv;
            let [a, z] = [b.min[axis], b.max[axis]].map(|plane| plane * inv - shift);
            min = min.max(a.min(z));
            max = max.min(a.max(z));
        }
    }
    (min <= max).then_some(Interval { min, max })
}
