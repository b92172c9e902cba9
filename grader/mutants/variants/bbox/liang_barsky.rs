//! The ray clipped by one half space after the other (Liang, Barsky, "A New Concept and Method for
//! Line Clipping", TOG 3(1), 1984).

pub use base::*;
use kit::{Aabb, Interval, Ray};

/// Clips `t·slope <= room` off the interval; false if nothing is left.
fn clip(slope: f64, room: f64, inside: &mut Interval) -> bool {
    if slope > 0.0 {
        inside.max = inside.max.min(room / slope);
    } else if slope < 0.0 {
        inside.min = inside.min.max(room / slope);
    } else if !(room >= 0.0) {
        return false;
    }
    inside.min <= inside.max
}

pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    let mut inside = Interval { min: ray.min_t, max: ray.max_t };
    let stays = (0..3).all(|axis| {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        clip(d, b.max[axis] - o, &mut inside) && clip(-d, o - b.min[axis], &mut inside)
    });
    (stays && !b.is_empty()).then_some(inside)
}
