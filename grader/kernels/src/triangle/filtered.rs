//! Edge functions in plain arithmetic with an error bound; if the bound does not decide the sign,
//! exact arithmetic does. The decision is always that of exact arithmetic on the rounded inputs.
//!
//! J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
//! Predicates", Discrete & Computational Geometry 18, 1997.

use super::test::{TriangleHit, TriangleTest, sum_if_same_sign};
use crate::exact::Expansion;
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Triangle, Vec3};
use lanes::Scalar;

pub(super) struct Filtered;

impl TriangleTest for Filtered {
    const INFO: KernelInfo = KernelInfo::new("filter, exact fallback", "Shewchuk 1997").fused();

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        let [a, b, c] = [tri.p0 - ray.o, tri.p1 - ray.o, tri.p2 - ray.o];
        let zero = R::from_f64(0.0);
        let mut edges = [zero; 3];
        let mut is_settled = true;
        for (edge, (from, to)) in edges.iter_mut().zip([(b, c), (c, a), (a, b)]) {
            let (value, bound) = volume(ray.d, from, to);
            *edge = value;
            is_settled &= value.abs() > bound;
        }
        if !is_settled {
            edges = exact_volumes(tri, ray);
        }
        let det = sum_if_same_sign(edges)?;
        let z = ray.d.longest_axis();
        let [e0, e1, e2] = edges;
        let t = (e0 * a.component(z) + e1 * b.component(z) + e2 * c.component(z))
            / (det * ray.d.component(z));
        ray.in_range(t).then_some(TriangleHit {
            t,
            b1: e1 / det,
            b2: e2 / det,
        })
    }
}

/// Roundings in `d·(A×B)`, half an epsilon each: two in the differences, one in a product, one in a
/// difference, one in a product, two in the sum, 7 in all; and as many again in the sum of absolute
/// products that they are relative to.
const ROUNDINGS: f64 = 16.0;

/// Returns `d·(A×B)` and its error bound.
#[inline(always)]
fn volume<R: Scalar>(d: Vec3<R>, a: Vec3<R>, b: Vec3<R>) -> (R, R) {
    let half_epsilon = R::epsilon() * R::from_f64(0.5);
    let minor = |p: R, q: R, r: R, s: R| (p * q - r * s, (p * q).abs() + (r * s).abs());
    let (x, x_size) = minor(a.y, b.z, a.z, b.y);
    let (y, y_size) = minor(a.z, b.x, a.x, b.z);
    let (z, z_size) = minor(a.x, b.y, a.y, b.x);
    let value = d.x * x + d.y * y + d.z * z;
    let size = d.x.abs() * x_size + d.y.abs() * y_size + d.z.abs() * z_size;
    (value, R::from_f64(ROUNDINGS) * half_epsilon * size)
}

/// Computes the three edge functions exactly; only the results are rounded.
#[cold]
#[inline(never)]
fn exact_volumes<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> [R; 3] {
    let relative_to_origin = |p: Vec3<R>| {
        [(p.x, ray.o.x), (p.y, ray.o.y), (p.z, ray.o.z)].map(|(p, o)| Expansion::difference(p, o))
    };
    let [a, b, c] = [
        relative_to_origin(tri.p0),
        relative_to_origin(tri.p1),
        relative_to_origin(tri.p2),
    ];
    let volume = |a: &[Expansion<R>; 3], b: &[Expansion<R>; 3]| {
        let minor = |i: usize, j: usize| {
            let minus = a[j].times(&b[i]).scaled(R::from_f64(-1.0));
            a[i].times(&b[j]).plus(&minus)
        };
        minor(1, 2)
            .scaled(ray.d.x)
            .plus(&minor(2, 0).scaled(ray.d.y))
            .plus(&minor(0, 1).scaled(ray.d.z))
            .value()
    };
    [volume(&b, &c), volume(&c, &a), volume(&a, &b)]
}
