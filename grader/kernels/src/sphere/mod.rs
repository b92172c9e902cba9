// BEGIN SOLUTION(part1.task4)
//! Rays and spheres: the smaller root of `a t² + 2 b t + c` that lies in the ray's range, with `f = o - center`,
//! `a = d·d`, `b = f·d`, `c = f·f - r²`. Tangents count.

mod haines;
mod q_form;
mod quadratic;

use crate::kernel::{About, Found, Hit, Kernel, Test};
use crate::real::Real;
use crate::shapes::{Ray, Sphere};
use std::marker::PhantomData;

/// A test that finds `t`.
pub(crate) trait SphereTest: 'static {
    const ABOUT: About;
    /// The same with its hit point pulled back to the sphere.
    const REPROJECTED: About;

    fn meet<R: Real>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R>;
}

/// The first of two roots, in order, that counts.
#[inline(always)]
fn first_in_range<R: Real>(ray: &Ray<R>, near: R, far: R) -> Option<R> {
    if ray.in_range(near) {
        Some(near)
    } else {
        ray.in_range(far).then_some(far)
    }
}

/// The hit point is `o + t·d`: off by what `t` is off.
struct Walked<K>(PhantomData<K>);

impl<K: SphereTest> Test for Walked<K> {
    type Shape = kit::Sphere;
    type Prepared<R: Real> = Sphere<R>;
    type Answer<R: Real> = Hit<R>;
    type Wide = Found;

    const ABOUT: About = K::ABOUT;

    fn prepare<R: Real>(s: &Sphere<R>) -> Sphere<R> {
        *s
    }

    #[inline(always)]
    fn test<R: Real>(s: &Sphere<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let t = K::meet(s, ray)?;
        Some(Hit { t, p: ray.at(t) })
    }
}

/// The hit point is `o + t·d`, pulled back to the sphere along the line to its centre (PBRT §6.8.5): on the surface,
/// though perhaps beside the place.
struct Reprojected<K>(PhantomData<K>);

impl<K: SphereTest> Test for Reprojected<K> {
    type Shape = kit::Sphere;
    type Prepared<R: Real> = Sphere<R>;
    type Answer<R: Real> = Hit<R>;
    type Wide = Found;

    const ABOUT: About = K::REPROJECTED;

    fn prepare<R: Real>(s: &Sphere<R>) -> Sphere<R> {
        *s
    }

    #[inline(always)]
    fn test<R: Real>(s: &Sphere<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let t = K::meet(s, ray)?;
        let from_center = ray.at(t) - s.center;
        let stretch = s.radius / from_center.dot(from_center).sqrt();
        Some(Hit {
            t,
            p: s.center + from_center * stretch,
        })
    }
}

/// All of them, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Sphere, Found>> {
    use haines::Haines;
    use q_form::QForm;
    use quadratic::Quadratic;
    vec![
        Kernel::of::<Walked<Quadratic>, f64>(),
        Kernel::of::<Walked<Quadratic>, f32>(),
        Kernel::of::<Reprojected<Quadratic>, f64>(),
        Kernel::of::<Reprojected<Quadratic>, f32>(),
        Kernel::of::<Walked<QForm>, f64>(),
        Kernel::of::<Walked<QForm>, f32>(),
        Kernel::of::<Reprojected<QForm>, f64>(),
        Kernel::of::<Reprojected<QForm>, f32>(),
        Kernel::of::<Walked<Haines>, f64>(),
        Kernel::of::<Walked<Haines>, f32>(),
        Kernel::of::<Reprojected<Haines>, f64>(),
        Kernel::of::<Reprojected<Haines>, f32>(),
    ]
}
// END SOLUTION(part1.task4)
