//! Part 2, task 2: where a ray is inside a box.

// BEGIN SOLUTION(part2.task2)
use kit::Vec3;
// END SOLUTION(part2.task2)
use kit::{Aabb, Interval, Ray};

/// The part of `ray` that lies inside `b`: the `t` in the ray's range with `b.min <= o + t·d <= b.max` on
/// every axis. `None` if there is no such `t`.
///
/// A box is three slabs, each the space between two parallel planes. On one axis the ray crosses the planes
/// at `t = (plane - o) / d`; it is inside the box from the last of the three entries to the first of the
/// three exits. The odd cases:
///
/// - Faces, edges and corners count, and so do both ends of the ray's range. A flat box (a wall) and a
///   box of one point are hit.
/// - The ray starts inside: the interval starts at `min_t`.
/// - A component of `d` is 0 (of either sign): the ray never leaves that slab, or never enters it. If all are
///   0 the ray is a point, inside or outside.
/// - The answer is never a false miss, which would be a hole in the picture: the exit is widened by the
///   rounding error of the division. So a ray that passes a corner within a few units in the last place is
///   a hit, and the interval can end that little late. (Holds while `t` is neither denormal nor infinite.)
/// - An empty box, a box or a ray with a NaN: no hit.
#[inline]
pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    // BEGIN SOLUTION(part2.task2)
    let (o, d) = (ray.o, ray.d);
    let inv_d = 1.0 / d;
    let to_min = b.min - o;
    let to_max = b.max - o;
    let (near_x, far_x) = slab(to_min.x, to_max.x, inv_d.x);
    let (near_y, far_y) = slab(to_min.y, to_max.y, inv_d.y);
    let (near_z, far_z) = slab(to_min.z, to_max.z, inv_d.z);
    let entry = later(near_x, later(near_y, later(near_z, ray.min_t)));
    let exit = earlier(far_x, earlier(far_y, earlier(far_z, f64::INFINITY)));
    let exit = earlier(widened(exit), ray.max_t);
    // An entry at infinity is a slab that a parallel ray never enters.
    if entry <= exit && entry < f64::INFINITY {
        // Here, and not on the way, because most tests end in a miss: NaN got through the comparisons above.
        let is_box = (to_min.x <= to_max.x) & (to_min.y <= to_max.y) & (to_min.z <= to_max.z);
        if is_box && !d.is_nan() {
            return Some(Interval {
                min: entry,
                max: exit,
            });
        }
    } else if entry == f64::INFINITY && has_denormal(d) {
        return intersect_by_division(b, ray);
    }
    None
    // STUB: kit::hole!("part2.task2", b, ray)
    // END SOLUTION(part2.task2)
}

// BEGIN SOLUTION(part2.task2)
/// How much later the exit is taken to be, relative to itself: 2·γ(3) = 6u/(1 - 3u), rounded up, with u = 2^-53.
///
/// Entry and exit are each off by up to three roundings (subtract, invert, multiply), so they can swap
/// places by twice that. Thiago Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013; the bound is that of
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.8.2.
const EXIT_WIDENING: f64 = 3.5 * f64::EPSILON;

/// Where the ray enters and leaves a slab. Which plane comes first is read off the direction's sign, not
/// found by comparing: NaN, from 0·∞ for an origin on a plane and a ray along it, stays on its own side.
#[inline]
fn slab(to_min: f64, to_max: f64, inv_d: f64) -> (f64, f64) {
    if inv_d < 0.0 {
        (to_max * inv_d, to_min * inv_d)
    } else {
        (to_min * inv_d, to_max * inv_d)
    }
}

/// The larger of two; `so_far` if `t` is NaN. One machine instruction, which `f64::max` is not.
#[inline]
fn later(t: f64, so_far: f64) -> f64 {
    if t > so_far { t } else { so_far }
}

/// The smaller of two; `so_far` if `t` is NaN.
#[inline]
fn earlier(t: f64, so_far: f64) -> f64 {
    if t < so_far { t } else { so_far }
}

/// The exit, later by [`EXIT_WIDENING`] whatever its sign; an infinite one stays as it is.
#[inline]
fn widened(exit: f64) -> f64 {
    later(exit * (1.0 + EXIT_WIDENING), exit * (1.0 - EXIT_WIDENING))
}

/// Whether a component of `d` is so small that its inverse is infinite although it is not 0.
#[inline]
fn has_denormal(d: Vec3) -> bool {
    d.to_array()
        .into_iter()
        .any(|d| d != 0.0 && (1.0 / d).is_infinite())
}

/// The same test by division, for directions that have no inverse.
#[cold]
#[inline(never)]
fn intersect_by_division(b: &Aabb, ray: &Ray) -> Option<Interval> {
    let mut entry = ray.min_t;
    let mut exit = f64::INFINITY;
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        let (first, last) = if d < 0.0 {
            (b.max[axis], b.min[axis])
        } else {
            (b.min[axis], b.max[axis])
        };
        entry = later((first - o) / d, entry);
        exit = earlier((last - o) / d, exit);
    }
    let exit = earlier(widened(exit), ray.max_t);
    let is_box = !b.is_empty() && !ray.o.is_nan() && !ray.d.is_nan();
    (is_box && entry <= exit && entry < f64::INFINITY).then_some(Interval {
        min: entry,
        max: exit,
    })
}
// END SOLUTION(part2.task2)
