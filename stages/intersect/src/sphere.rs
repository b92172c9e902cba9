//! Part 1, task 4: spheres.

// BEGIN SOLUTION(part1.task4)
use crate::exact::{DoubleDouble, Scale};
use crate::rounding::{CANCELLATION, FARTHEST2, LARGEST_SQUARE, SMALLEST_SQUARE};
use kit::{Vec2, Vec3};
// END SOLUTION(part1.task4)

use kit::{Hit, PrimId, Ray, Sphere};

/// The smallest `t` in the ray's range at which `ray` intersects the surface of `s`; `None` on a
/// miss.
///
/// Chapter: stages/book/src/part1/task4.md
///
/// The textbook's formula for the roots of a quadratic loses digits by cancellation in two places.
/// The discriminant cancels if the sphere is small and far away or the ray is nearly tangent, the
/// numerator if the origin is near the surface.
///
/// - If the near root is out of range, the far root counts: the ray starts inside, or `min_t` is
///   beyond the near root.
/// - A tangent ray hits the sphere once. A ray that starts on the surface hits it at `t = 0`.
/// - A radius of 0 is a point, which is hit by a ray that passes exactly through it. A negative
///   radius, a radius of NaN and `d = 0` are misses.
///
/// See it: `cargo grader picture part1.task4`.
#[inline]
pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    // BEGIN SOLUTION(part1.task4)
    let [near, far] = crossings(s, ray)?;
    [near, far].into_iter().find(|&t| ray.in_range(t))
    // STUB: kit::hole!("part1.task4", s, ray)
    // END SOLUTION(part1.task4)
}

/// Intersects `ray` with `s`, which is primitive `id`. On a hit within the ray's range, sets
/// `ray.max_t` to its `t`.
///
/// Chapter: stages/book/src/part1/task4.md
///
/// `n` and `ng` are the unit vector from the centre to the hit point: outward, also if the ray
/// starts inside. `p` is on the surface: `o + t·d` is projected back onto it. `uv` is (0, 0). For a
/// radius of 0 the normal is `-d`, normalised.
///
/// See it: `cargo grader picture part1.task4`.
pub fn intersect_sphere(s: &Sphere, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    // BEGIN SOLUTION(part1.task4)
    let t = test_sphere(s, ray)?;
    ray.max_t = t;
    let from_center = ((ray.o - s.center) + t * ray.d) / s.radius;
    let n = from_center
        .try_normalize()
        .unwrap_or_else(|| -unit_direction(ray.d));
    Some(Hit {
        t,
        p: s.center + s.radius * n,
        n,
        ng: n,
        uv: Vec2::ZERO,
        prim: id,
    })
    // STUB: kit::hole!("part1.task4", s, id, ray)
    // END SOLUTION(part1.task4)
}

// BEGIN SOLUTION(part1.task4)
/// The two intersections of the line with the sphere, near one first. Both are equal for a tangent.
///
/// Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray
/// Tracing Gems, 2019, chapter 7: `b² - a·c = a·(r² - |f + (b/a)·d|²)`. This form compares the
/// radius with the distance between centre and line, and does not cancel for a sphere that is only
/// far away.
#[inline]
fn crossings(s: &Sphere, ray: &Ray) -> Option<[f64; 2]> {
    let (d, r2) = (ray.d, s.radius * s.radius);
    let f = ray.o - s.center;
    let a = d.dot(d);
    let b = -f.dot(d);
    let f2 = f.dot(f);
    let c = f2 - r2;
    // The discriminant divided by a: r² minus the squared distance of the line from the centre.
    let disc = r2 - (f + (b / a) * d).length_squared();
    let is_reliable = disc.abs() > CANCELLATION * r2
        && c.abs() > CANCELLATION * r2
        && f2 < FARTHEST2 * r2
        && SMALLEST_SQUARE < r2
        && r2 < LARGEST_SQUARE
        && SMALLEST_SQUARE < a
        && a < LARGEST_SQUARE
        && s.radius > 0.0;
    if !is_reliable {
        return robust_crossings(s, ray);
    }
    (disc >= 0.0).then(|| roots(a, b, c, (a * disc).sqrt()))
}

/// The roots of `a·t² - 2·b·t + c`, smaller first, given `sqrt_disc = sqrt(b² - a·c)`. Computes the
/// root that adds terms of equal sign, then the other root: their product is `c / a`.
#[inline]
fn roots(a: f64, b: f64, c: f64, sqrt_disc: f64) -> [f64; 2] {
    if b < 0.0 {
        let q = b - sqrt_disc;
        [q / a, c / q]
    } else {
        let q = b + sqrt_disc;
        // If both roots are 0 (a tangent at its own origin), c/q is NaN. It is in no range, and q/a
        // is the hit.
        [c / q, q / a]
    }
}

/// Computes [`crossings`] for all remaining cases, more slowly: at a scale without overflow and
/// underflow, with b, c and the discriminant in double-double arithmetic.
///
/// The discriminant is `a·r² - |f x d|²`, by Lagrange's identity `(f·d)² + |f x d|² = (f·f)(d·d)`.
/// For integers up to 2^25 it is exact, so a tangent is distinguished from a miss.
#[cold]
#[inline(never)]
fn robust_crossings(s: &Sphere, ray: &Ray) -> Option<[f64; 2]> {
    let finite = ray.o.is_finite() && ray.d.is_finite() && s.center.is_finite();
    if !finite || ray.d == Vec3::ZERO || !(s.radius >= 0.0 && s.radius.is_finite()) {
        return None;
    }
    let reach = ray.o.abs().max(s.center.abs()).max_element().max(s.radius);
    let space = Scale::of(reach);
    let speed = Scale::of(ray.d.abs().max_element());
    let d = speed.shrink(ray.d);
    let (o, center) = (space.shrink(ray.o), space.shrink(s.center));
    let r = space.shrink(Vec3::splat(s.radius)).x;
    let f = [0, 1, 2].map(|axis| DoubleDouble::sum(o[axis], -center[axis]));
    let d2 = [0, 1, 2].map(|axis| DoubleDouble::product(d[axis], d[axis]));
    let r2 = DoubleDouble::product(r, r);
    let a = d2[0] + d2[1] + d2[2];
    let b = -(f[0] * d.x + f[1] * d.y + f[2] * d.z);
    let c = f[0] * f[0] + f[1] * f[1] + f[2] * f[2] - r2;
    let moment = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| f[i] * d[j] - f[j] * d[i]);
    let disc = a * r2 - moment[0] * moment[0] - moment[1] * moment[1] - moment[2] * moment[2];
    if disc.hi < 0.0 {
        return None;
    }
    let scaled = roots(a.hi, b.hi, c.hi, disc.hi.sqrt());
    Some(scaled.map(|t| space.restore(t, speed)))
}

/// `d` normalised without overflow or underflow.
fn unit_direction(d: Vec3) -> Vec3 {
    Scale::of(d.abs().max_element()).shrink(d).normalize()
}
// END SOLUTION(part1.task4)
