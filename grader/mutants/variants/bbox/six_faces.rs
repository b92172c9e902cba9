//! Each of the six faces as a rectangle: the ray enters at the first that it meets, and leaves at
//! the last.

pub use base::*;
use kit::{Aabb, Interval, Ray};

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    let within = |p: kit::Vec3, skipped: usize| (0..3).all(|axis| axis == skipped || (b.min[axis] <= p[axis] && p[axis] <= b.max[axis]));
    let mut met: Vec<f64> = Vec::new();
    for axis in (0..3).filter(|&axis| ray.d[axis] != 0.0) {
        for plane in [b.min[axis], b.max[axis]] {
            let t = (plane - ray.o[axis]) / ray.d[axis];
            if within(ray.at(t), axis) {
                met.push(t);
            }
        }
    }
    let enters = met.iter().copied().reduce(f64::min)?.max(ray.min_t);
    let leaves = met.iter().copied().reduce(f64::max)?.min(ray.max_t);
    (enters <= leaves).then_some(Interval { min: enters, max: leaves })
}
