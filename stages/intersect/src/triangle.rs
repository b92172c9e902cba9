//! Part 1, task 3: triangles.

// BEGIN SOLUTION(part1.task3)
use crate::exact::{Scale, accurate_cross, difference_of_products};
use kit::{Vec2, Vec3};
// END SOLUTION(part1.task3)

use kit::{Hit, PrimId, Ray, Triangle, TriangleHit};

/// Where `ray` meets `tri`, if it does at a `t` in its range; both faces, edges and vertices count.
///
/// The point that is hit is `o + t·d = b0·p0 + b1·p1 + b2·p2` with `b0 + b1 + b2 = 1` and no weight
/// negative: equations for `t`, `b1` and `b2`. There are many ways to solve them. The assignment
/// recommends that of Möller and Trumbore; a watertight one lets no ray slip through between two
/// triangles of a closed mesh.
///
/// - A triangle without area is not hit, nor is one that the ray lies in the plane of.
/// - A vertex or a ray with a NaN or an infinite coordinate: no hit. `d = 0`: no hit.
#[inline]
pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    // BEGIN SOLUTION(part1.task3)
    // Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, without its divisions.
    // Seen from the origin of the ray, with axes named so that it goes mostly along z.
    let axes = Axes::of(ray.d);
    let (o, d) = (axes.of_vec(&ray.o), axes.of_vec(&ray.d));
    let [a, b, c] = [&tri.p0, &tri.p1, &tri.p2].map(|p| axes.of_vec(p) - o);
    let (a_xy, b_xy, c_xy) = (sheared(a, d), sheared(b, d), sheared(c, d));
    let (cb, ac, ba) = (c_xy.x * b_xy.y, a_xy.x * c_xy.y, b_xy.x * a_xy.y);
    let weights = Weights {
        u: cb - c_xy.y * b_xy.x,
        v: ac - a_xy.y * c_xy.x,
        w: ba - b_xy.y * a_xy.x,
    };
    // Rounding is monotonic: a difference of two rounded products has the right sign, or it is 0. So
    // when two signs differ, the ray misses for certain.
    let agreement = weights.agreement();
    if agreement < 0.0 {
        return None;
    }
    let det = weights.sum();
    let scale_is_ordinary = is_ordinary(weights.of(a.z, b.z, c.z)) & is_ordinary(det * d.z);
    let is_sound = (agreement > 0.0)
        & (det.abs() > CANCELLATION * (cb.abs() + ac.abs() + ba.abs()))
        & scale_is_ordinary;
    if !is_sound {
        return test_carefully(tri, ray);
    }
    let t = weights.of(a.z, b.z, c.z) / (det * d.z);
    ray.in_range(t).then(|| TriangleHit {
        t,
        b1: weights.v / det,
        b2: weights.w / det,
    })
    // STUB: kit::hole!("part1.task3", tri, ray)
    // END SOLUTION(part1.task3)
}

/// The hit of `ray` with `tri`, which is primitive `id`, if there is one in the ray's range;
/// `ray.max_t` becomes its `t`.
///
/// - `p` is `p0 + b1·(p1 - p0) + b2·(p2 - p0)`. That is on the triangle however far away the ray started,
///   where `o + t·d` is off by a rounding error that grows with `t`.
/// - `ng` is the unit vector along `(p1 - p0) x (p2 - p0)`.
/// - `n` is `b0·n0 + b1·n1 + b2·n2` brought to unit length; where the three cancel (or one is not
///   finite), `ng`. Neither normal is turned towards the ray.
/// - `uv` is `(b1, b2)`.
pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    // BEGIN SOLUTION(part1.task3)
    let hit = test_triangle(tri, ray)?;
    Some(record_triangle(tri, id, ray, hit))
    // STUB: kit::hole!("part1.task3", tri, id, ray)
    // END SOLUTION(part1.task3)
}

/// Records what [`test_triangle`] said of `ray` and `tri`, which is primitive `id`; `ray.max_t` becomes the hit's `t`. For
/// who has tested many triangles and wants the record of one.
pub fn record_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray, hit: TriangleHit) -> Hit {
    // BEGIN SOLUTION(part1.task3)
    let TriangleHit { t, b1, b2 } = hit;
    ray.max_t = t;
    let ng = geometric_normal(tri);
    Hit {
        t,
        p: tri.p0 + b1 * (tri.p1 - tri.p0) + b2 * (tri.p2 - tri.p0),
        n: shading_normal(tri, b1, b2).unwrap_or(ng),
        ng,
        uv: Vec2::new(b1, b2),
        prim: id,
    }
    // STUB: kit::hole!("part1.task3", tri, id, ray, hit)
    // END SOLUTION(part1.task3)
}

// BEGIN SOLUTION(part1.task3)
/// Below this share of the triangle's extent, the determinant is what is left after most digits
/// cancelled, and the weights are computed again: a needle of 1000:1, or a ray within a thousandth of
/// its plane. Above it they are good to about 2^-42.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// Whether a product of several factors has neither underflowed nor overflowed on the way, with some
/// room left for the digits of its terms. (The weights need no such test: their agreement underflows
/// long before they do.)
#[inline]
fn is_ordinary(x: f64) -> bool {
    const SMALLEST: f64 = 1e-290;
    (SMALLEST < x.abs()) & (x.abs() < f64::INFINITY)
}

/// The edge functions: twice the signed areas of the triangles that the ray's line makes with each
/// edge, seen along the ray. They are the barycentric weights times the determinant, their sum.
struct Weights {
    u: f64,
    v: f64,
    w: f64,
}

impl Weights {
    /// Negative if two of them differ in sign, positive if all have the same sign; 0 if one is 0 and
    /// the others do not differ, or if they are too small to tell.
    #[inline]
    fn agreement(&self) -> f64 {
        // A product, not a chain of comparisons: which of the three is negative is anyone's guess, and
        // a branch predictor's wrong guesses would cost more than all the rest.
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        smaller(self.u, smaller(self.v, self.w)) * larger(self.u, larger(self.v, self.w))
    }

    #[inline]
    fn sum(&self) -> f64 {
        self.u + self.v + self.w
    }

    /// The weighted sum of the vertices' values.
    #[inline]
    fn of(&self, a: f64, b: f64, c: f64) -> f64 {
        self.u * a + self.v * b + self.w * c
    }
}

/// Axes renamed in a circle, so that z is the one along which a direction is longest.
#[derive(Clone, Copy)]
struct Axes {
    x: usize,
    y: usize,
    z: usize,
}

impl Axes {
    #[inline]
    fn of(d: Vec3) -> Axes {
        let size = d.abs();
        let z_is_longest = (size.z >= size.x) & (size.z >= size.y);
        let y_or_x = usize::from(size.y >= size.x);
        let z = if z_is_longest { 2 } else { y_or_x };
        let after = |axis| if axis == 2 { 0 } else { axis + 1 };
        let x = after(z);
        Axes { x, y: after(x), z }
    }

    /// `v` with its axes renamed.
    #[inline]
    fn of_vec(self, v: &Vec3) -> Vec3 {
        let v: &[f64; 3] = v.as_ref();
        Vec3::new(v[self.x], v[self.y], v[self.z])
    }
}

/// Where the line through `p` along `d` crosses the plane z = 0, times `d.z`. In that plane the ray is the
/// origin and the triangle is flat; no division, so that small whole numbers stay exact.
///
/// Neighbours that share a vertex get the same two numbers for it, whatever was rounded: the mesh in
/// the plane has no gaps, and from here on only exact signs are needed.
#[inline]
fn sheared(p: Vec3, d: Vec3) -> Vec2 {
    Vec2::new(p.x * d.z - d.x * p.z, p.y * d.z - d.y * p.z)
}

/// The same test, slower: at a scale where nothing overflows or underflows, with edge functions whose
/// signs are exact and which keep all their digits when products cancel.
#[cold]
#[inline(never)]
fn test_carefully(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    let points = [ray.o, tri.p0, tri.p1, tri.p2];
    if !ray.d.is_finite() || points.iter().any(|p| !p.is_finite()) || ray.d == Vec3::ZERO {
        return None;
    }
    let reach = points.iter().map(|p| p.abs().max_element());
    let space = Scale::of(reach.fold(0.0, f64::max));
    let speed = Scale::of(ray.d.abs().max_element());
    let [o, p0, p1, p2] = points.map(|p| space.shrink(p));
    if accurate_cross(p1 - p0, p2 - p0) == Vec3::ZERO {
        return None;
    }
    let axes = Axes::of(ray.d);
    let [d, a, b, c] = [speed.shrink(ray.d), p0 - o, p1 - o, p2 - o].map(|v| axes.of_vec(&v));
    let (a_xy, b_xy, c_xy) = (sheared(a, d), sheared(b, d), sheared(c, d));
    let weights = Weights {
        u: difference_of_products(c_xy.x, b_xy.y, c_xy.y, b_xy.x),
        v: difference_of_products(a_xy.x, c_xy.y, a_xy.y, c_xy.x),
        w: difference_of_products(b_xy.x, a_xy.y, b_xy.y, a_xy.x),
    };
    let det = weights.sum();
    if weights.agreement() < 0.0 || det == 0.0 {
        return None;
    }
    let t = space.restore(weights.of(a.z, b.z, c.z) / det / d.z, speed);
    ray.in_range(t).then(|| TriangleHit {
        t,
        b1: weights.v / det,
        b2: weights.w / det,
    })
}

/// The unit normal of the triangle's plane, `p0 p1 p2` counter-clockwise around it.
fn geometric_normal(tri: &Triangle) -> Vec3 {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let normal = e1.cross(e2);
    let length2 = normal.length_squared();
    // Squares: a root is dearer than all the rest here.
    let extent2 = e1.length_squared() * e2.length_squared();
    if length2 > CANCELLATION * CANCELLATION * extent2 && is_ordinary(length2) {
        return normal / length2.sqrt();
    }
    let space = Scale::of(e1.abs().max(e2.abs()).max_element());
    let normal = accurate_cross(space.shrink(e1), space.shrink(e2));
    let size = Scale::of(normal.abs().max_element());
    size.shrink(normal).normalize_or_zero()
}

/// The interpolated normal, if the three do not cancel.
fn shading_normal(tri: &Triangle, b1: f64, b2: f64) -> Option<Vec3> {
    let normal = (1.0 - b1 - b2) * tri.n0 + b1 * tri.n1 + b2 * tri.n2;
    let length = normal.length();
    (length > CANCELLED_NORMAL && length.is_finite()).then(|| normal / length)
}

/// Of three unit normals, a weighted sum this short points where rounding errors say.
const CANCELLED_NORMAL: f64 = 1e-12;
// END SOLUTION(part1.task3)
