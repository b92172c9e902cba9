//! The slab of each axis by its centre and half its extent, so that no plane is chosen by the sign
//! of `d`. The difference of the two is less exact than a plane.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() || ray.o.is_nan() || ray.d.is_nan() {
        return None;
    }
    let center = 0.5 * (b.min + b.max);
    let half = 0.5 * (b.max - b.min);
    let (mut min, mut max) = (ray.min_t, ray.max_t);
    for axis in 0..3 {
        let to_center = center[axis] - ray.o[axis];
        if ray.d[axis] == 0.0 {
            if to_center.abs() > half[axis] {
                return None;
            }
            continue;
        }
        let inv = 1.0 / ray.d[axis];
        let middle = to_center * inv;
        let reach = half[axis] * inv.abs();
        min = f64::max(min, middle - reach);
        max = f64::min(max, middle + reach);
    }
    (min <= max).then_some(Interval { min, max })
}
