//! The sphere test (Haines, Günther, Akenine-Möller, "Precision Improvements for Ray/Sphere
//! Intersection", Ray Tracing Gems, 2019, chapter 7), in the steps of `intersect::test_sphere`.

use crate::real::{Mask, Real};
use crate::rounding::{CANCELLATION, FARTHEST2, LARGEST_SQUARE, SMALLEST_SQUARE};
use crate::shapes::{Ray, Sphere};
use crate::vec3::Vec3;

/// The equation `a·t² - 2·b·t + c = 0` of the points where a line crosses a sphere.
///
/// ```
/// use lanes::{Ray, Sphere, sphere::SphereEquation};
/// let ray = Ray::from_kit(&kit::Ray::new(kit::Vec3::new(0.0, 0.0, 3.0), -kit::Vec3::Z));
/// let center = lanes::Vec3::from_kit(kit::Vec3::ZERO);
/// let equation = SphereEquation::<f64>::of(&ray, &Sphere { center, radius: 1.0 });
/// assert!(equation.is_sound() && equation.has_roots());
/// assert_eq!(equation.roots(), [2.0, 4.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SphereEquation<R> {
    /// The ray's origin relative to the centre.
    f: Vec3<R>,
    a: R,
    b: R,
    /// The discriminant divided by `a`.
    disc: R,
    r2: R,
    radius: R,
}

impl<R: Real> SphereEquation<R> {
    /// The equation of a line and a sphere.
    #[inline(always)]
    pub fn of(ray: &Ray<R>, sphere: &Sphere<R>) -> SphereEquation<R> {
        let (d, r2) = (ray.d, sphere.radius * sphere.radius);
        let f = ray.o - sphere.center;
        let a = d.dot(d);
        let b = -f.dot(d);
        let beside = f + d * (b / a);
        SphereEquation {
            f,
            a,
            b,
            disc: r2 - beside.dot(beside),
            r2,
            radius: sphere.radius,
        }
    }

    /// Whether plain arithmetic decides; else `intersect::test_sphere` does, with more care.
    #[inline(always)]
    pub fn is_sound(&self) -> R::Mask {
        let SphereEquation { f, a, r2, .. } = *self;
        let smallest_difference = a.constant(CANCELLATION) * r2;
        let (smallest, largest) = (a.constant(SMALLEST_SQUARE), a.constant(LARGEST_SQUARE));
        smallest_difference.less(self.disc.abs())
            & smallest_difference.less(self.c().abs())
            & f.dot(f).less(a.constant(FARTHEST2) * r2)
            & (smallest.less(r2) & r2.less(largest))
            & (smallest.less(a) & a.less(largest))
            & a.constant(0.0).less(self.radius)
    }

    #[inline(always)]
    fn c(&self) -> R {
        self.f.dot(self.f) - self.r2
    }

    /// Whether there is a root.
    #[inline(always)]
    pub fn has_roots(&self) -> R::Mask {
        self.disc.constant(0.0).at_most(self.disc)
    }

    /// The two roots, the near one first.
    #[inline(always)]
    pub fn roots(&self) -> [R; 2] {
        let SphereEquation { a, b, disc, .. } = *self;
        let root = (a * disc).sqrt();
        let goes_away = b.less(b.constant(0.0));
        let q = b + goes_away.choose(-root, root);
        let (by_sum, by_product) = (q / a, self.c() / q);
        [
            goes_away.choose(by_sum, by_product),
            goes_away.choose(by_product, by_sum),
        ]
    }
}
