//! Planes by the sign of the direction, the exit two units later (Ize, "Robust BVH Ray Traversal",
//! JCGT 2(2), 2013).

pub use base::*;
use kit::{Aabb, Interval, Ray};

/// 1 + 2 units in the last place.
const LATER: f64 = 1.000_000_000_000_000_4;

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.is_empty() || ray.o.is_nan() || ray.d.is_nan() {
        return None;
    }
    let mut min = ray.min_t;
    let mut max = ray.max_t;
    for axis in 0..3 {
        let inv = 1.0 / ray.d[axis];
        let (first, last) = if inv.is_sign_negative() { (b.max, b.min) } else { (b.min, b.max) };
        let enters = (first[axis] - ray.o[axis]) * inv;
        let leaves = (last[axis] - ray.o[axis]) * inv;
        if enters > min {
            min = enters;
        }
        if leaves * LATER < max {
            max = leaves * LATER;
        }
    }
    (min <= max && min < f64::INFINITY).then_some(Interval { min, max })
}
