//! Slabs by division, an axis after the other, sorted by swapping.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let mut t_min = ray.min_t;
    let mut t_max = ray.max_t;
    for axis in 0..3 {
        if ray.d[axis] == 0.0 {
            if ray.o[axis] < b.min[axis] || ray.o[axis] > b.max[axis] {
                return None;
            }
            continue;
        }
        let mut t1 = (b.min[axis] - ray.o[axis]) / ray.d[axis];
        let mut t2 = (b.max[axis] - ray.o[axis]) / ray.d[axis];
        if t1 > t2 {
            std::mem::swap(&mut t1, &mut t2);
        }
        t_min = t_min.max(t1);
        t_max = t_max.min(t2);
        if t_min > t_max {
            return None;
        }
    }
    Some(Interval { min: t_min, max: t_max })
}
