// BEGIN SOLUTION(part1.task3)
//! Edge functions in plain arithmetic with a bound of their error; where the bound does not settle the sign, exact
//! arithmetic does. The decision is always that of exact arithmetic on these inputs.
//!
//! J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
//! Computational Geometry 18, 1997.

use super::{Meeting, TriangleTest, if_all_agree};
use crate::exact::Expansion;
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Triangle, V3};

pub(super) struct Filtered;

impl TriangleTest for Filtered {
    const ABOUT: About = About {
        name: "filter, exact fallback",
        paper: "Shewchuk 1997",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        let [a, b, c] = [tri.p0 - ray.o, tri.p1 - ray.o, tri.p2 - ray.o];
        let zero = R::of(0.0);
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
        let det = if_all_agree(edges)?;
        let z = ray.d.longest_axis();
        let [e0, e1, e2] = edges;
        let t = (e0 * a.on(z) + e1 * b.on(z) + e2 * c.on(z)) / (det * ray.d.on(z));
        ray.in_range(t).then_some(Meeting {
            t,
            b1: e1 / det,
            b2: e2 / det,
        })
    }
}

/// Roundings in `d·(A×B)`, half an epsilon each: two in the differences, one in a product, one in a difference, one in
/// a product, two in the sum are 7; and as many again in the sum of sizes that they are measured by.
const ROUNDINGS: f64 = 16.0;

/// `d·(A×B)`, and by how much it may be off.
#[inline(always)]
fn volume<R: Real>(d: V3<R>, a: V3<R>, b: V3<R>) -> (R, R) {
    let half_epsilon = R::epsilon() * R::of(0.5);
    let minor = |p: R, q: R, r: R, s: R| (p * q - r * s, (p * q).abs() + (r * s).abs());
    let (x, x_size) = minor(a.y, b.z, a.z, b.y);
    let (y, y_size) = minor(a.z, b.x, a.x, b.z);
    let (z, z_size) = minor(a.x, b.y, a.y, b.x);
    let value = d.x * x + d.y * y + d.z * z;
    let size = d.x.abs() * x_size + d.y.abs() * y_size + d.z.abs() * z_size;
    (value, R::of(ROUNDINGS) * half_epsilon * size)
}

/// The three edge functions without rounding; only their values are rounded, at the end.
#[cold]
#[inline(never)]
fn exact_volumes<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> [R; 3] {
    let seen = |p: V3<R>| {
        [(p.x, ray.o.x), (p.y, ray.o.y), (p.z, ray.o.z)].map(|(p, o)| Expansion::difference(p, o))
    };
    let [a, b, c] = [seen(tri.p0), seen(tri.p1), seen(tri.p2)];
    let volume = |a: &[Expansion<R>; 3], b: &[Expansion<R>; 3]| {
        let minor = |i: usize, j: usize| {
            let minus = a[j].times(&b[i]).scaled(R::of(-1.0));
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
// END SOLUTION(part1.task3)
