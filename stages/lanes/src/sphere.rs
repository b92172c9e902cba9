// BEGIN SOLUTION(part6.task2)
//! The sphere test (Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere
//! Intersection", Ray Tracing Gems, 2019, chapter 7), in the steps of `intersect::test_sphere`.

use crate::real::{Mask, Real};
use crate::shapes::{Ray, Sphere};
use kit::rounding::{CANCELLATION, FARTHEST2, LARGEST_SQUARE, SMALLEST_SQUARE};

/// The equation `a·t² - 2·b·t + c = 0` of the points where a line crosses a sphere.
#[derive(Clone, Copy, Debug)]
pub struct SphereEquation<R: Real> {
    /// Whether plain arithmetic decides; else `intersect::test_sphere` does.
    pub is_sound: R::Mask,
    a: R,
    b: R,
    c: R,
    /// The discriminant divided by `a`.
    disc: R,
}

impl<R: Real> SphereEquation<R> {
    /// The equation of a line and a sphere.
    #[inline(always)]
    pub fn of(ray: &Ray<R>, sphere: &Sphere<R>) -> SphereEquation<R> {
        let (d, r2) = (ray.d, sphere.radius * sphere.radius);
        let f = ray.o - sphere.center;
        let a = d.dot(d);
        let b = -f.dot(d);
        let f2 = f.dot(f);
        let c = f2 - r2;
        let beside = f + d * (b / a);
        let disc = r2 - beside.dot(beside);
        let smallest_difference = a.constant(CANCELLATION) * r2;
        let (smallest, largest) = (a.constant(SMALLEST_SQUARE), a.constant(LARGEST_SQUARE));
        SphereEquation {
            is_sound: smallest_difference.less(disc.abs())
                & smallest_difference.less(c.abs())
                & f2.less(a.constant(FARTHEST2) * r2)
                & (smallest.less(r2) & r2.less(largest))
                & (smallest.less(a) & a.less(largest))
                & a.constant(0.0).less(sphere.radius),
            a,
            b,
            c,
            disc,
        }
    }

    /// Whether there is a root.
    #[inline(always)]
    pub fn has_roots(&self) -> R::Mask {
        self.disc.constant(0.0).at_most(self.disc)
    }

    /// The two roots, the near one first.
    #[inline(always)]
    pub fn roots(&self) -> [R; 2] {
        let SphereEquation { a, b, c, disc, .. } = *self;
        let root = (a * disc).sqrt();
        let goes_away = b.less(b.constant(0.0));
        let q = goes_away.choose(b - root, b + root);
        let (by_sum, by_product) = (q / a, c / q);
        [
            goes_away.choose(by_sum, by_product),
            goes_away.choose(by_product, by_sum),
        ]
    }
}
// END SOLUTION(part6.task2)
