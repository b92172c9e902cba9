//! The triangle test (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1),
//! 2013), in the steps of `intersect::test_triangle`.
//!
//! Where that function switches to its careful variant, the result is not certain, and the caller
//! asks that function.

use crate::real::{Mask, Real};
use crate::rounding::{CANCELLATION, SMALLEST_PRODUCT};
use crate::vec3::Vec3;

/// A cyclic permutation of the axes, such that z is the axis of the largest coordinate of a
/// direction.
///
/// ```
/// use lanes::{Vec3, triangle::Axes};
/// let d = Vec3 { x: 1.0, y: -3.0_f64, z: 2.0 };
/// assert_eq!(Axes::of(d).permute(d).z, -3.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Axes<R: Real> {
    z_stays: R::Mask,
    y_becomes_z: R::Mask,
}

impl<R: Real> Axes<R> {
    /// The permutation for the direction `d`.
    #[inline(always)]
    pub fn of(d: Vec3<R>) -> Axes<R> {
        let size = d.abs();
        Axes {
            z_stays: size.x.at_most(size.z) & size.y.at_most(size.z),
            y_becomes_z: size.x.at_most(size.y),
        }
    }

    /// `v` with permuted axes.
    #[inline(always)]
    pub fn permute(&self, v: Vec3<R>) -> Vec3<R> {
        let (z, y) = (self.z_stays, self.y_becomes_z);
        Vec3 {
            x: z.choose(v.x, y.choose(v.z, v.y)),
            y: z.choose(v.y, y.choose(v.x, v.z)),
            z: z.choose(v.z, y.choose(v.y, v.x)),
        }
    }
}

/// Projects the vertex `p` along the ray onto the plane z = 0. `p` is relative to the ray's origin,
/// and the axes of `p` and the direction `d` are permuted. Returns x and y of the projected vertex,
/// times `d.z`, and the z of `p`.
#[inline(always)]
pub fn project<R: Real>(p: Vec3<R>, d: Vec3<R>) -> Vec3<R> {
    Vec3 {
        x: p.x * d.z - d.x * p.z,
        y: p.y * d.z - d.y * p.z,
        z: p.z,
    }
}

/// The factors `[a, b, c, d]` of each edge function `a·b - c·d` of the projected vertices: twice
/// the signed area of the triangle of the ray, which is the point 0, and an edge.
#[inline(always)]
pub fn edge_factors<R: Real>([a, b, c]: [Vec3<R>; 3]) -> [[R; 4]; 3] {
    [
        [c.x, b.y, c.y, b.x],
        [a.x, c.y, a.y, c.x],
        [b.x, a.y, b.y, a.x],
    ]
}

/// The edge functions of a triangle: the barycentric weights of its vertices, times their sum.
///
/// ```
/// use lanes::{Vec3, triangle::Edges};
/// let at = |x, y| Vec3 { x, y, z: -2.0_f64 };
/// let around = Edges::of([at(-1.0, -1.0), at(2.0, -1.0), at(-1.0, 2.0)]);
/// assert!(around.crossing([-2.0; 3], -1.0).is_certain);
/// assert_eq!(around.crossing([-2.0; 3], -1.0).t, 2.0);
/// let beside = Edges::of([at(1.0, 1.0), at(2.0, 1.0), at(1.0, 2.0)]);
/// assert!(beside.agreement() < 0.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Edges<R> {
    u: R,
    v: R,
    w: R,
    /// The first product of each.
    products: [R; 3],
}

/// Where a ray crosses the plane of a triangle that it does not miss.
#[derive(Clone, Copy, Debug)]
pub struct PlaneCrossing<R: Real> {
    /// Whether the ray passes the inside of the triangle, and `t` is accurate.
    pub is_certain: R::Mask,
    /// The distance along the ray, in lengths of its direction.
    pub t: R,
    /// The barycentric weight of the second vertex, times `det`.
    pub v: R,
    /// The barycentric weight of the third vertex, times `det`.
    pub w: R,
    /// The sum of the edge functions.
    pub det: R,
}

impl<R: Real> Edges<R> {
    /// The edge functions for three vertices from [`project`].
    #[inline(always)]
    pub fn of(vertices: [Vec3<R>; 3]) -> Edges<R> {
        let [u, v, w] = edge_factors(vertices);
        let products = [u[0] * u[1], v[0] * v[1], w[0] * w[1]];
        Edges {
            u: products[0] - u[2] * u[3],
            v: products[1] - v[2] * v[3],
            w: products[2] - w[2] * w[3],
            products,
        }
    }

    /// Negative if two edge functions have different signs, so that the ray misses for certain:
    /// a difference of two rounded products has the exact sign, or it is 0. Positive if all have
    /// the same sign and their product does not underflow.
    #[inline(always)]
    pub fn agreement(&self) -> R {
        let smallest = self.u.smaller(self.v.smaller(self.w));
        smallest * self.u.larger(self.v.larger(self.w))
    }

    /// Where the ray crosses the plane of the triangle. `depths` are the z of the vertices, `d_z`
    /// that of the direction.
    #[inline(always)]
    pub fn crossing(&self, depths: [R; 3], d_z: R) -> PlaneCrossing<R> {
        let Edges { u, v, w, products } = *self;
        let det = u + v + w;
        let numerator = u * depths[0] + v * depths[1] + w * depths[2];
        let denominator = det * d_z;
        let terms = products[0].abs() + products[1].abs() + products[2].abs();
        let zero = det.constant(0.0);
        PlaneCrossing {
            is_certain: zero.less(self.agreement())
                & (terms * det.constant(CANCELLATION)).less(det.abs())
                & is_ordinary(numerator)
                & is_ordinary(denominator),
            t: numerator / denominator,
            v,
            w,
            det,
        }
    }
}

/// Whether a product of several factors has neither underflowed nor overflowed.
#[inline(always)]
pub(crate) fn is_ordinary<R: Real>(x: R) -> R::Mask {
    let size = x.abs();
    x.constant(SMALLEST_PRODUCT).less(size) & size.less(x.constant(f64::INFINITY))
}
