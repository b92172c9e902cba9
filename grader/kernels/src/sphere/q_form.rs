// BEGIN SOLUTION(part1.task4)
//! The root whose terms add up, and the other from their product, `t0 t1 = c / a`: neither cancels. The discriminant
//! still does.
//!
//! W. Press et al., Numerical Recipes, §5.6.

use super::{SphereTest, first_in_range};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Sphere};

pub(super) struct QForm;

impl SphereTest for QForm {
    const ABOUT: About = About {
        name: "q form",
        paper: "Press et al. 1992",
        culls: false,
    };
    const REPROJECTED: About = About {
        name: "q form, reprojected",
        ..Self::ABOUT
    };

    #[inline(always)]
    fn meet<R: Real>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R> {
        let f = ray.o - s.center;
        let a = ray.d.dot(ray.d);
        let b = f.dot(ray.d);
        let c = f.dot(f) - s.radius * s.radius;
        let discriminant = b * b - a * c;
        if discriminant < R::of(0.0) {
            return None;
        }
        roots(ray, a, b, c, discriminant.sqrt())
    }
}

/// The first root of `a t² + 2 b t + c` that counts, given the root of `b² - a c`.
#[inline(always)]
pub(super) fn roots<R: Real>(ray: &Ray<R>, a: R, b: R, c: R, root: R) -> Option<R> {
    if b > R::of(0.0) {
        let q = -b - root;
        first_in_range(ray, q / a, c / q)
    } else {
        let q = root - b;
        first_in_range(ray, c / q, q / a)
    }
}
// END SOLUTION(part1.task4)
