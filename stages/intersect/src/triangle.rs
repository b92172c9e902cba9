//! Part 1, task 3: triangles.

// BEGIN SOLUTION(part1.task3)
use crate::exact::{Scale, accurate_cross, difference_of_products};
use kit::{Vec2, Vec3};
// END SOLUTION(part1.task3)
use kit::{Hit, PrimId, Ray, Triangle, TriangleHit};

/// Where `ray` meets `tri`, if it does at a `t` in its range; both faces, edges and vertices count.
///
/// The point that is hit is `o + t·d = b0·p0 + b1·p1 + b2·p2` with `b0 + b1 + b2 = 1` and no weight
/// negative: four equations for `t`, `b1` and `b2`. Of the many ways to solve them this one is
/// watertight: a ray at a closed mesh does not slip through between two triangles. (Woop, Benthin, Wald, "Watertight
/// Ray/Triangle Intersection", JCGT 2(1), 2013.)
///
/// - A triangle without area is not hit, nor is one that the ray lies in the plane of.
/// - A vertex or a ray with a NaN or an infinite coordinate: no hit. `d = 0`: no hit.
#[inline]
pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    // BEGIN SOLUTION(part1.task3)
    // Seen from the origin of the ray, along its longest axis, called z from here on.
    let [d, a, b, c] = longest_last(
        ray.d,
        [ray.d, tri.p0 - ray.o, tri.p1 - ray.o, tri.p2 - ray.o],
    );
    let (a_xy, b_xy, c_xy) = (sheared(a, d), sheared(b, d), sheared(c, d));
    let weights = Weights {
        u: c_xy.x * b_xy.y - c_xy.y * b_xy.x,
        v: a_xy.x * c_xy.y - a_xy.y * c_xy.x,
        w: b_xy.x * a_xy.y - b_xy.y * a_xy.x,
    };
    // Rounding is monotonic: a difference of two rounded products has the right sign, or it is 0. So
    // when two signs differ, the ray misses for certain.
    if weights.differ_in_sign() {
        return None;
    }
    let det = weights.sum();
    let reach = a_xy.abs().max(b_xy.abs()).max(c_xy.abs());
    let det_is_sound = det.abs() > CANCELLATION * reach.x * reach.y
        && SMALLEST < (det * d.z).abs()
        && (det * d.z).abs() < LARGEST;
    if !det_is_sound || weights.has_zero() {
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

/// The hit of `ray` with `tri`, which is primitive `id`, if there is one in the ray's range; `ray.max_t` becomes its `t`.
///
/// - `p` is `p0 + b1·(p1 - p0) + b2·(p2 - p0)`. That is on the triangle however far away the ray started,
///   where `o + t·d` is off by a rounding error that grows with `t`.
/// - `ng` is the unit vector along `(p1 - p0) x (p2 - p0)`.
/// - `n` is `b0·n0 + b1·n1 + b2·n2` brought to unit length; where the three cancel (or one is not finite), `ng`.
///   Neither normal is turned towards the ray.
/// - `uv` is `(b1, b2)`.
pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    // BEGIN SOLUTION(part1.task3)
    let TriangleHit { t, b1, b2 } = test_triangle(tri, ray)?;
    ray.max_t = t;
    let ng = geometric_normal(tri);
    Some(Hit {
        t,
        p: tri.p0 + b1 * (tri.p1 - tri.p0) + b2 * (tri.p2 - tri.p0),
        n: shading_normal(tri, b1, b2).unwrap_or(ng),
        ng,
        uv: Vec2::new(b1, b2),
        prim: id,
    })
    // STUB: kit::hole!("part1.task3", tri, id, ray)
    // END SOLUTION(part1.task3)
}

// BEGIN SOLUTION(part1.task3)
/// Below this share of the triangle's extent, the determinant is what is left after most digits cancelled, and
/// the weights are computed again: a needle of 1000:1, or a ray within a thousandth of its plane.
/// Above it they are good to about 2^-42.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// Where `det·d.z` lies when no product on the way to it has underflowed or overflowed: it is a product of five
/// factors, two coordinates and three direction components, and the square root of the smallest float is 1e-154.
const SMALLEST: f64 = 1e-150;
/// See [`SMALLEST`].
const LARGEST: f64 = 1e150;

/// The edge functions: twice the signed areas of the triangles that the ray's line makes with each
/// edge, seen along the ray. They are the barycentric weights times the determinant, their sum.
struct Weights {
    u: f64,
    v: f64,
    w: f64,
}

impl Weights {
    #[inline]
    fn differ_in_sign(&self) -> bool {
        (self.u < 0.0 || self.v < 0.0 || self.w < 0.0)
            && (self.u > 0.0 || self.v > 0.0 || self.w > 0.0)
    }

    #[inline]
    fn has_zero(&self) -> bool {
        self.u == 0.0 || self.v == 0.0 || self.w == 0.0
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

/// The vectors with their axes renamed in a circle, so that z is the one along which `d` is longest.
#[inline]
fn longest_last(d: Vec3, vectors: [Vec3; 4]) -> [Vec3; 4] {
    let size = d.abs();
    if size.z >= size.x && size.z >= size.y {
        vectors
    } else if size.y >= size.x {
        vectors.map(|v| Vec3::new(v.z, v.x, v.y))
    } else {
        vectors.map(|v| Vec3::new(v.y, v.z, v.x))
    }
}

/// Where the line through `p` along `d` crosses the plane z = 0, times `d.z`. In that plane the ray is the
/// origin and the triangle is flat; no division, so that small whole numbers stay exact.
///
/// Neighbours that share a vertex get the same two numbers for it, whatever was rounded: the mesh in the plane has
/// no gaps, and from here on only exact signs are needed.
#[inline]
fn sheared(p: Vec3, d: Vec3) -> Vec2 {
    Vec2::new(p.x * d.z - d.x * p.z, p.y * d.z - d.y * p.z)
}

/// The same test, slower: at a scale where nothing overflows or underflows, with edge functions whose signs are
/// exact and which keep all their digits when products cancel.
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
    let [d, a, b, c] = longest_last(ray.d, [speed.shrink(ray.d), p0 - o, p1 - o, p2 - o]);
    let (a_xy, b_xy, c_xy) = (sheared(a, d), sheared(b, d), sheared(c, d));
    let weights = Weights {
        u: difference_of_products(c_xy.x, b_xy.y, c_xy.y, b_xy.x),
        v: difference_of_products(a_xy.x, c_xy.y, a_xy.y, c_xy.x),
        w: difference_of_products(b_xy.x, a_xy.y, b_xy.y, a_xy.x),
    };
    let det = weights.sum();
    if weights.differ_in_sign() || det == 0.0 {
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
    let length = normal.length();
    if length > CANCELLATION * (e1.length() * e2.length()) && length > SMALLEST && length < LARGEST
    {
        return normal / length;
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
