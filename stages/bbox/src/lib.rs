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
// Always: a traversal tests one ray against many boxes, and only within its loop is `1/d` seen to stay
// the same.
#[inline(always)]
pub fn intersect_bbox(b: &Aabb, ray: &Ray) -> Option<Interval> {
    // BEGIN SOLUTION(part2.task2)
    let inv_d = 1.0 / ray.d;
    if !has_inverse(inv_d) {
        return intersect_by_division(b, *ray);
    }
    let to_min = b.min - ray.o;
    let to_max = b.max - ray.o;
    let (t_min, t_max) = (to_min * inv_d, to_max * inv_d);
    // On each axis the smaller one is the entry.
    let entry = later(earlier(t_min.x, t_max.x), ray.min_t);
    let entry = later(earlier(t_min.y, t_max.y), entry);
    let entry = later(earlier(t_min.z, t_max.z), entry);
    let exit = later(t_min.x, t_max.x);
    let exit = earlier(later(t_min.y, t_max.y), exit);
    let exit = earlier(later(t_min.z, t_max.z), exit);
    let exit = widened(exit);
    if entry <= exit && entry <= ray.max_t {
        // Asked last, because most tests end in a miss: the comparisons above let NaN and turned-round
        // boxes pass.
        let is_box = !b.is_empty() && !ray.o.is_nan();
        return is_box.then_some(Interval {
            min: entry,
            max: earlier(exit, ray.max_t),
        });
    }
    None
    // STUB: kit::hole!("part2.task2", b, ray)
    // END SOLUTION(part2.task2)
}

// BEGIN SOLUTION(part2.task2)
/// How much later the exit is taken to be, relative to itself: 8u, with u = 2^-53.
///
/// Entry and exit are each off by up to three roundings (subtract, invert, multiply), so they can swap
/// places by twice that, 2·γ(3) = 6u/(1 - 3u); widening rounds once more; and a power of two is free of
/// a rounding of its own. Thiago Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013; the bound is that of
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.8.2.
const EXIT_WIDENING: f64 = 4.0 * f64::EPSILON;

/// The exit, later by [`EXIT_WIDENING`] whatever its sign. +∞ stays; -∞ becomes NaN, before which
/// nothing enters.
#[inline]
fn widened(exit: f64) -> f64 {
    exit + exit.abs() * EXIT_WIDENING
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

/// Whether every component of the direction has a finite inverse: none is 0, denormal or NaN.
#[inline]
fn has_inverse(inv_d: Vec3) -> bool {
    inv_d.x.abs() + inv_d.y.abs() + inv_d.z.abs() < f64::INFINITY
}

/// The same test, slower, for rays along a slab or nearly so. Which plane comes first is read off the
/// direction's sign, not found by comparing: so NaN, from 0/0 for an origin on a plane and a ray along
/// it, stays on its own side and can be ignored there.
///
/// The ray comes by value: a reference would keep the caller's ray in memory, and `1/d` in its loop
/// over boxes.
#[cold]
#[inline(never)]
fn intersect_by_division(b: &Aabb, ray: Ray) -> Option<Interval> {
    if b.is_empty() || ray.o.is_nan() || ray.d.is_nan() {
        return None;
    }
    let mut entry = ray.min_t;
    let mut exit = f64::INFINITY;
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        let (first, last) = if d.is_sign_negative() {
            (b.max[axis], b.min[axis])
        } else {
            (b.min[axis], b.max[axis])
        };
        entry = later((first - o) / d, entry);
        exit = earlier((last - o) / d, exit);
    }
    let exit = widened(exit);
    // An entry at infinity is a slab that a ray along it never enters.
    let is_inside = entry <= exit && entry <= ray.max_t && entry < f64::INFINITY;
    is_inside.then_some(Interval {
        min: entry,
        max: earlier(exit, ray.max_t),
    })
}
// END SOLUTION(part2.task2)
