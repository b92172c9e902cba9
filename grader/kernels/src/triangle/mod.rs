// BEGIN SOLUTION(part1.task3)
//! Rays and triangles. Edges, vertices and both ends of the ray's range count; both faces are hit.
//!
//! With the vertices seen from the ray's origin, `A = p0 - o` and so on, the ray's line passes the triangle where
//! `d·(B×C)`, `d·(C×A)` and `d·(A×B)` do not differ in sign: all of these kernels come down to that, and differ in
//! what they round on the way, and in what they leave out.

mod baldwin_weber;
mod filtered;
mod moller_trumbore;
mod plane;
mod plucker;
pub(crate) mod woop;
mod woop_fused;

use crate::kernel::{About, Found, Hit, Kernel, Test};
use crate::real::Real;
use crate::shapes::{Ray, Triangle};
use std::marker::PhantomData;

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting<R> {
    /// Distance along the ray in lengths of its direction.
    pub(crate) t: R,
    /// Barycentric weights of `p1` and `p2`.
    b1: R,
    b2: R,
}

/// A test that works on the vertices.
pub(crate) trait TriangleTest: 'static {
    const ABOUT: About;

    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>>;
}

/// The hit point is `o + t·d`: off by what `t` is off.
struct Walked<K>(PhantomData<K>);

impl<K: TriangleTest> Test for Walked<K> {
    type Shape = kit::Triangle;
    type Prepared<R: Real> = Triangle<R>;
    type Answer<R: Real> = Hit<R>;
    type Wide = Found;

    const ABOUT: About = K::ABOUT;

    fn prepare<R: Real>(tri: &Triangle<R>) -> Triangle<R> {
        *tri
    }

    #[inline(always)]
    fn test<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let Meeting { t, .. } = K::meet(tri, ray)?;
        Some(Hit { t, p: ray.at(t) })
    }
}

/// The hit point is mixed from the vertices: on the plane, however far the ray has come (PBRT §6.5.3).
struct Mixed<K>(PhantomData<K>);

impl<K: TriangleTest> Test for Mixed<K> {
    type Shape = kit::Triangle;
    type Prepared<R: Real> = Triangle<R>;
    type Answer<R: Real> = Hit<R>;
    type Wide = Found;

    const ABOUT: About = K::ABOUT;

    fn prepare<R: Real>(tri: &Triangle<R>) -> Triangle<R> {
        *tri
    }

    #[inline(always)]
    fn test<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let Meeting { t, b1, b2 } = K::meet(tri, ray)?;
        let p = tri.p0 + (tri.p1 - tri.p0) * b1 + (tri.p2 - tri.p0) * b2;
        Some(Hit { t, p })
    }
}

/// The sum of three edge functions, if all of them have one sign; the line then passes the triangle.
#[inline(always)]
fn if_all_agree<R: Real>([u, v, w]: [R; 3]) -> Option<R> {
    let zero = R::of(0.0);
    // Without a branch a comparison: which of the three differs is anyone's guess, also the processor's.
    let (is_below, is_above) = (
        (u < zero) | (v < zero) | (w < zero),
        (u > zero) | (v > zero) | (w > zero),
    );
    if is_below & is_above {
        return None;
    }
    let det = u + v + w;
    (det != zero).then_some(det)
}

/// All of them, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Triangle, Found>> {
    use baldwin_weber::BaldwinWeber;
    use filtered::Filtered;
    use moller_trumbore::{Culling, MollerTrumbore, UsualEpsilon};
    use plane::PlaneThenSides;
    use plucker::Plucker;
    use woop::Woop;
    use woop_fused::{Fused, FusedAtZero};
    vec![
        Kernel::of::<Walked<MollerTrumbore>, f64>(),
        Kernel::of::<Walked<MollerTrumbore>, f32>(),
        Kernel::of::<Walked<UsualEpsilon>, f64>(),
        Kernel::of::<Walked<UsualEpsilon>, f32>(),
        Kernel::of::<Walked<Culling>, f64>(),
        Kernel::of::<Walked<Culling>, f32>(),
        Kernel::of::<Walked<PlaneThenSides>, f64>(),
        Kernel::of::<Walked<PlaneThenSides>, f32>(),
        Kernel::of::<BaldwinWeber, f64>(),
        Kernel::of::<BaldwinWeber, f32>(),
        Kernel::of::<Walked<Plucker>, f64>(),
        Kernel::of::<Walked<Plucker>, f32>(),
        Kernel::of::<Mixed<Woop>, f64>(),
        Kernel::of::<Mixed<Woop>, f32>(),
        Kernel::of_f32_in_f64::<Mixed<Woop>>(),
        Kernel::of::<Mixed<FusedAtZero>, f64>(),
        Kernel::of::<Mixed<Fused>, f64>(),
        Kernel::of::<Mixed<Filtered>, f64>(),
    ]
}
// END SOLUTION(part1.task3)
