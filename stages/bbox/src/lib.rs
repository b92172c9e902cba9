//! Part 2, task 2: ray/box intersection.

// BEGIN SOLUTION(part2.task2)
use kit::Vec3;
// END SOLUTION(part2.task2)

use kit::{Aabb, Interval, Ray};

/// Intersects `ray` with the box `b`: returns the interval of all `t` in the ray's range with
/// `b.min <= o + t·d <= b.max` on every axis, or `None` if there is no such `t`.
///
/// Chapter: stages/book/src/part2/task2.md
///
/// A box is the intersection of three slabs, each the space between two parallel planes. How the
/// interval follows from them is open. Special cases:
///
/// - Faces, edges and corners belong to the box, and both ends of the ray's range count. A flat box
///   and a box of a single point can be hit.
/// - If the ray starts inside, the interval starts at `min_t`.
/// - If a component of `d` is 0 (of either sign), the whole ray is inside that slab or outside. If
///   all are 0 the ray is a point, inside the box or outside.
/// - There are no false misses, which would be holes in the image. For this, the exit is increased
///   by the rounding error of the division. So a ray that passes a corner within a few units in the
///   last place can be a hit, and the interval can end that much late. (This holds while `t` is
///   neither denormal nor infinite.)
/// - An empty box and a box or a ray with a NaN are misses.
///
/// See it: `cargo grader picture part2.task2`.
// Always inlined: a traversal tests one ray against many boxes, and only then does the compiler
// compute `1/d` once outside of the loop.
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
    // On each axis the smaller of the two is the entry.
    let entry = later(earlier(t_min.x, t_max.x), ray.min_t);
    let entry = later(earlier(t_min.y, t_max.y), entry);
    let entry = later(earlier(t_min.z, t_max.z), entry);
    let exit = later(t_min.x, t_max.x);
    let exit = earlier(later(t_min.y, t_max.y), exit);
    let exit = earlier(later(t_min.z, t_max.z), exit);
    let exit = widened(exit);
    if entry <= exit && entry <= ray.max_t {
        // Tested last, because most tests are misses. The comparisons above accept NaN and inverted
        // boxes.
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
/// Relative amount by which the exit is increased: 8u, with u = 2^-53.
///
/// Entry and exit each have up to three roundings (subtract, invert, multiply), so their order can
/// be wrong by twice that error, 2·γ(3) = 6u/(1 - 3u). The increase itself rounds once more, and a
/// multiplication by a power of two is exact. Thiago Ize, "Robust BVH Ray Traversal", JCGT 2(2),
/// 2013; the bound is from Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition,
/// section 6.8.2.
const EXIT_WIDENING: f64 = 4.0 * f64::EPSILON;

/// The exit, increased by [`EXIT_WIDENING`], whatever its sign. +∞ stays +∞. -∞ becomes NaN, which
/// no entry is below.
#[inline]
fn widened(exit: f64) -> f64 {
    exit + exit.abs() * EXIT_WIDENING
}

/// The larger of the two; `so_far` if `t` is NaN. It compiles to a single instruction, unlike
/// `f64::max`.
#[inline]
fn later(t: f64, so_far: f64) -> f64 {
    if t > so_far { t } else { so_far }
}

/// The smaller of the two; `so_far` if `t` is NaN.
#[inline]
fn earlier(t: f64, so_far: f64) -> f64 {
    if t < so_far { t } else { so_far }
}

/// Whether every component of the direction has a finite inverse: none is 0, NaN or too close to 0.
#[inline]
fn has_inverse(inv_d: Vec3) -> bool {
    inv_d.x.abs() + inv_d.y.abs() + inv_d.z.abs() < f64::INFINITY
}

/// Computes [`intersect_bbox`] for rays that are parallel to a slab, or nearly so, more slowly.
///
/// The order of the two planes is determined by the sign of the direction, not by a comparison. So
/// a NaN (0/0, for an origin on a plane and a parallel ray) stays an entry or an exit, and can be
/// ignored there.
///
/// The ray is passed by value: a reference would force the caller to keep the ray in memory, and to
/// compute `1/d` again for each box.
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
    // An infinite entry belongs to a ray that is parallel to a slab and outside of it.
    let is_inside = entry <= exit && entry <= ray.max_t && entry < f64::INFINITY;
    is_inside.then_some(Interval {
        min: entry,
        max: earlier(exit, ray.max_t),
    })
}
// END SOLUTION(part2.task2)
