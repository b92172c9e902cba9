//! Part 1, task 4: spheres.

// BEGIN SOLUTION(part1.task4)
use crate::exact::{DoubleDouble, Scale};
use kit::{Vec2, Vec3};
// END SOLUTION(part1.task4)

use kit::{Hit, PrimId, Ray, Sphere};

/// The smallest `t` in the ray's range at which `ray` crosses the surface of `s`; `None` if it does not.
///
/// With `f = o - center` the crossings are the roots of `a·t² - 2·b·t + c = 0`, where `a = d·d`, `b =
/// -f·d` and `c = f·f - r²`. The formula from school, `(b ± sqrt(b² - a·c)) / a`, loses its digits in
/// two places: in `b² - a·c` when the sphere is small and far or hardly touched, and in `b - sqrt(..)`
/// when the origin is near the surface.
///
/// - The far crossing counts when the near one is out of range: the ray starts inside, or `min_t` is past it.
/// - A tangent line meets the sphere, once. An origin on the surface meets it at `t = 0`.
/// - `r = 0` is a point: hit by a ray that goes exactly through it. `r < 0` or NaN, `d = 0`: no hit.
#[inline]
pub fn test_sphere(s: &Sphere, ray: &Ray) -> Option<f64> {
    // BEGIN SOLUTION(part1.task4)
    let [near, far] = crossings(s, ray)?;
    [near, far].into_iter().find(|&t| ray.in_range(t))
    // STUB: kit::hole!("part1.task4", s, ray)
    // END SOLUTION(part1.task4)
}

/// The hit of `ray` with `s`, which is primitive `id`, if there is one in the ray's range; `ray.max_t`
/// becomes its `t`.
///
/// `n` and `ng` are the unit vector from the centre to the hit point: outward, also when the ray comes
/// from inside. `p` is the centre plus `r` times that, which brings `o + t·d` back onto the surface.
/// `uv` is (0, 0). On a sphere that is a point the normal is `-d`.
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
/// The two crossings of the line, nearer first (equal for a tangent).
///
/// Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing
/// Gems, 2019, chapter 7: `b² - a·c = a·(r² - |f + (b/a)·d|²)`, which compares the radius with the
/// distance between centre and line and does not cancel for a sphere that is merely far.
#[inline]
fn crossings(s: &Sphere, ray: &Ray) -> Option<[f64; 2]> {
    let (d, r2) = (ray.d, s.radius * s.radius);
    let f = ray.o - s.center;
    let a = d.dot(d);
    let b = -f.dot(d);
    let f2 = f.dot(f);
    let c = f2 - r2;
    // The discriminant over a: r² less the square of the line's distance from the centre.
    let disc = r2 - (f + (b / a) * d).length_squared();
    let is_sound = disc.abs() > CLOSE_CALL * r2
        && c.abs() > CLOSE_CALL * r2
        && f2 < FAR * r2
        && SMALLEST < r2
        && r2 < LARGEST
        && SMALLEST < a
        && a < LARGEST
        && s.radius > 0.0;
    if !is_sound {
        return crossings_carefully(s, ray);
    }
    (disc >= 0.0).then(|| roots(a, b, c, (a * disc).sqrt()))
}

/// The roots of `a·t² - 2·b·t + c`, smaller first, given the root of `b² - a·c`: first the one whose
/// terms have equal signs, then the other from their product.
#[inline]
fn roots(a: f64, b: f64, c: f64, sqrt_disc: f64) -> [f64; 2] {
    if b < 0.0 {
        let q = b - sqrt_disc;
        [q / a, c / q]
    } else {
        let q = b + sqrt_disc;
        // If both roots are 0, a tangent from its own point, c/q is NaN: in no range, so that q/a is the hit.
        [c / q, q / a]
    }
}

/// Below this share of r² a difference has lost ten bits to cancellation, and is computed again.
const CLOSE_CALL: f64 = 1.0 / 1024.0;

/// The square of the distance in radii (2^20) from which rounding moves the line noticeably sideways.
const FAR: f64 = (1_u64 << 40) as f64;

/// Squares between these bounds can be multiplied with each other without underflow or overflow.
const SMALLEST: f64 = 1e-100;
/// See [`SMALLEST`].
const LARGEST: f64 = 1e100;

/// The same crossings, slower: at a scale where nothing overflows or underflows, with b, c and the
/// discriminant in double-double arithmetic.
///
/// The discriminant is `a·r² - |f x d|²`, by Lagrange's identity `(f·d)² + |f x d|² = (f·f)(d·d)`. For
/// whole numbers up to 2^25 it is exact, so that a tangent is told from a miss by one.
#[cold]
#[inline(never)]
fn crossings_carefully(s: &Sphere, ray: &Ray) -> Option<[f64; 2]> {
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

/// `d` brought to unit length, however short or long it is.
fn unit_direction(d: Vec3) -> Vec3 {
    Scale::of(d.abs().max_element()).shrink(d).normalize()
}
// END SOLUTION(part1.task4)
