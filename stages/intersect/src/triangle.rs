//! Part 1, task 3: triangles.

// BEGIN SOLUTION(part1.task3)
use crate::exact::{Scale, accurate_cross, difference_of_products};
use crate::rounding::{CANCELLATION, CANCELLED_NORMAL, SMALLEST_PRODUCT};
use kit::{Vec2, Vec3};
// END SOLUTION(part1.task3)

use kit::{Hit, PrimId, Ray, Triangle, TriangleHit};

/// Intersects `ray` with `tri` within the ray's range. Both faces, all edges and all vertices
/// count.
///
/// Chapter: stages/book/src/part1/task3.md
///
/// The hit point is `o + t·d = b0·p0 + b1·p1 + b2·p2` with `b0 + b1 + b2 = 1` and no negative
/// weight. These are equations for `t`, `b1` and `b2`, which can be solved in many ways. The
/// assignment recommends Möller and Trumbore's algorithm. A watertight algorithm lets no ray pass
/// between two adjacent triangles of a closed mesh.
///
/// - A triangle without area and a ray in the plane of the triangle are misses.
/// - A vertex or a ray with a NaN or an infinite coordinate is a miss. `d = 0` is a miss.
///
/// See it: `cargo grader picture part1.task3`.
#[inline]
pub fn test_triangle(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
    // BEGIN SOLUTION(part1.task3)
    // Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, without the
    // divisions. Coordinates are relative to the origin of the ray, with the axes permuted so that
    // z is the largest component of d.
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
    // Rounding is monotonic: a difference of two rounded products has the exact sign, or it is 0.
    // So the ray certainly misses if two signs differ.
    let agreement = weights.agreement();
    if agreement < 0.0 {
        return None;
    }
    let det = weights.sum();
    let scale_is_ordinary = is_ordinary(weights.of(a.z, b.z, c.z)) & is_ordinary(det * d.z);
    let is_reliable = (agreement > 0.0)
        & (det.abs() > CANCELLATION * (cb.abs() + ac.abs() + ba.abs()))
        & scale_is_ordinary;
    if !is_reliable {
        return robust_test(tri, ray);
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

/// Intersects `ray` with `tri`, which is primitive `id`. On a hit within the ray's range, sets
/// `ray.max_t` to its `t`.
///
/// Chapter: stages/book/src/part1/task3.md
///
/// - `p` is on the triangle even if the origin is far away. The rounding error of `o + t·d` grows
///   with `t`.
/// - `ng` is the unit normal of the triangle's plane, on the side of `(p1 - p0) x (p2 - p0)`.
/// - `n` is the unit vector interpolated between the vertex normals. If the three cancel, or one is
///   not finite, it is `ng`. Neither normal is flipped towards the ray.
/// - `uv` is `(b1, b2)`.
///
/// See it: `cargo grader picture part1.task3`.
pub fn intersect_triangle(tri: &Triangle, id: PrimId, ray: &mut Ray) -> Option<Hit> {
    // BEGIN SOLUTION(part1.task3)
    let hit = test_triangle(tri, ray)?;
    Some(record_triangle(tri, id, ray, hit))
    // STUB: kit::hole!("part1.task3", tri, id, ray)
    // END SOLUTION(part1.task3)
}

/// Records a hit that [`test_triangle`] found between `ray` and `tri`, which is primitive `id`, and
/// sets `ray.max_t` to its `t`.
///
/// Chapter: stages/book/src/part1/task3.md
///
/// This is for callers that test many triangles first and need the record of only one of them.
///
/// See it: `cargo grader picture part1.task3`.
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
/// Whether no intermediate step of a product underflowed or overflowed, with a margin for the
/// digits of its terms. The weights need no such test: the product in [`Weights::agreement`]
/// underflows long before a weight does.
#[inline]
fn is_ordinary(x: f64) -> bool {
    (SMALLEST_PRODUCT < x.abs()) & (x.abs() < f64::INFINITY)
}

/// The edge functions: for each edge, twice the signed area of the triangle that the edge forms
/// with the ray, projected along the ray. They are the barycentric weights, multiplied by the
/// determinant, which is the sum of the edge functions.
struct Weights {
    u: f64,
    v: f64,
    w: f64,
}

impl Weights {
    /// Negative if two weights have different signs, positive if all have the same sign. 0 if one
    /// weight is 0 and the others do not differ in sign, or if the product underflows.
    #[inline]
    fn agreement(&self) -> f64 {
        // A product instead of a chain of comparisons: which weight is negative is unpredictable,
        // and branch mispredictions would cost more than the rest of the test.
        let [smallest, largest] = self.extremes();
        smallest * largest
    }

    /// The smallest and the largest weight.
    #[inline]
    fn extremes(&self) -> [f64; 2] {
        let smaller = |a: f64, b: f64| if a < b { a } else { b };
        let larger = |a: f64, b: f64| if a > b { a } else { b };
        [
            smaller(self.u, smaller(self.v, self.w)),
            larger(self.u, larger(self.v, self.w)),
        ]
    }

    #[inline]
    fn sum(&self) -> f64 {
        self.u + self.v + self.w
    }

    /// Interpolates the values of the three vertices, without division by the determinant.
    #[inline]
    fn of(&self, a: f64, b: f64, c: f64) -> f64 {
        self.u * a + self.v * b + self.w * c
    }
}

/// A cyclic permutation of the axes, such that z is the axis of the largest component of a
/// direction.
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

    /// `v` with permuted axes.
    #[inline]
    fn of_vec(self, v: &Vec3) -> Vec3 {
        let v: &[f64; 3] = v.as_ref();
        Vec3::new(v[self.x], v[self.y], v[self.z])
    }
}

/// The shear transformation: the point where the line through `p` along `d` intersects the plane
/// `z = 0`, times `d.z`. In this plane the ray is the origin and the triangle is two-dimensional.
/// There is no division, so small integers stay exact.
///
/// Adjacent triangles compute the same two numbers for a shared vertex, rounding errors included.
/// So the projected mesh has no gaps, and from here on only the signs must be exact.
#[inline]
fn sheared(p: Vec3, d: Vec3) -> Vec2 {
    Vec2::new(p.x * d.z - d.x * p.z, p.y * d.z - d.y * p.z)
}

/// Computes [`test_triangle`] for all remaining cases, more slowly: at a scale without overflow and
/// underflow, with edge functions that have exact signs and stay accurate when products cancel.
#[cold]
#[inline(never)]
fn robust_test(tri: &Triangle, ray: &Ray) -> Option<TriangleHit> {
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
    // No product of weights: for a ray that is almost in the plane it underflows.
    let [smallest, largest] = weights.extremes();
    if (smallest < 0.0 && largest > 0.0) || det == 0.0 {
        return None;
    }
    let t = space.restore(weights.of(a.z, b.z, c.z) / det / d.z, speed);
    ray.in_range(t).then(|| TriangleHit {
        t,
        b1: weights.v / det,
        b2: weights.w / det,
    })
}

/// The unit geometric normal: `p0 p1 p2` are counter-clockwise around it.
fn geometric_normal(tri: &Triangle) -> Vec3 {
    let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let normal = e1.cross(e2);
    let length2 = normal.length_squared();
    // Compares squares, because a square root costs more than the rest of this test.
    let extent2 = e1.length_squared() * e2.length_squared();
    if length2 > CANCELLATION * CANCELLATION * extent2 && is_ordinary(length2) {
        return normal / length2.sqrt();
    }
    let space = Scale::of(e1.abs().max(e2.abs()).max_element());
    let normal = accurate_cross(space.shrink(e1), space.shrink(e2));
    let size = Scale::of(normal.abs().max_element());
    size.shrink(normal).normalize_or_zero()
}

/// The interpolated vertex normal, normalised. `None` if the three normals cancel.
fn shading_normal(tri: &Triangle, b1: f64, b2: f64) -> Option<Vec3> {
    let normal = (1.0 - b1 - b2) * tri.n0 + b1 * tri.n1 + b2 * tri.n2;
    let length = normal.length();
    (length > CANCELLED_NORMAL && length.is_finite()).then(|| normal / length)
}
// END SOLUTION(part1.task3)
