//! The corners picked by the sign of the direction (Williams et al., JGT 10(1), 2005).

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() {
        return None;
    }
    let corners = [b.min, b.max];
    let inv = [1.0 / ray.d.x, 1.0 / ray.d.y, 1.0 / ray.d.z];
    let sign = inv.map(|i| usize::from(i < 0.0));
    let mut t_min = (corners[sign[0]].x - ray.o.x) * inv[0];
    let mut t_max = (corners[1 - sign[0]].x - ray.o.x) * inv[0];
    for axis in 1..3 {
        let lo = (corners[sign[axis]][axis] - ray.o[axis]) * inv[axis];
        let hi = (corners[1 - sign[axis]][axis] - ray.o[axis]) * inv[axis];
        if t_min > hi || lo > t_max {
            return None;
        }
        if lo > t_min {
            t_min = lo;
        }
        if hi < t_max {
            t_max = hi;
        }
    }
    let (min, max) = (t_min.max(ray.min_t), t_max.min(ray.max_t));
    if min <= max { Some(Interval { min, max }) } else { None }
}
