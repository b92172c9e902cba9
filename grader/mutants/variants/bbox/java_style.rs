//! Three pairs of variables instead of a loop, ends sorted by `if`: the style of
//! a Java programmer.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    if b.min.x > b.max.x || b.min.y > b.max.y || b.min.z > b.max.z {
        return None;
    }
    let mut tx0 = (b.min.x - ray.o.x) / ray.d.x;
    let mut tx1 = (b.max.x - ray.o.x) / ray.d.x;
    let mut ty0 = (b.min.y - ray.o.y) / ray.d.y;
    let mut ty1 = (b.max.y - ray.o.y) / ray.d.y;
    let mut tz0 = (b.min.z - ray.o.z) / ray.d.z;
    let mut tz1 = (b.max.z - ray.o.z) / ray.d.z;
    if tx0 > tx1 {
        let swap = tx0;
        tx0 = tx1;
        tx1 = swap;
    }
    if ty0 > ty1 {
        let swap = ty0;
        ty0 = ty1;
        ty1 = swap;
    }
    if tz0 > tz1 {
        let swap = tz0;
        tz0 = tz1;
        tz1 = swap;
    }
    let enter = tx0.max(ty0).max(tz0);
    let leave = tx1.min(ty1).min(tz1);
    if enter > leave {
        return None;
    }
    if leave < ray.min_t || enter > ray.max_t {
        return None;
    }
    let min = enter.max(ray.min_t);
    let max = leave.min(ray.max_t);
    return Some(Interval { min, max });
}
