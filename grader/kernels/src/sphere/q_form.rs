//! Computes the root whose terms add, and the other one from the product of the roots,
//! `t0 t1 = c / a`: neither cancels. The discriminant still cancels.
//!
//! W. Press et al., Numerical Recipes, §5.6.

use super::test::{SphereTest, first_in_range};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Sphere};
use lanes::Scalar;

pub(super) struct QForm;

impl SphereTest for QForm {
    const INFO: KernelInfo = KernelInfo::new("q form", "Press et al. 1992");
    const REPROJECTED: KernelInfo = KernelInfo {
        name: "q form, reprojected",
        ..Self::INFO
    };

    #[inline(always)]
    fn intersect<R: Scalar>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R> {
        let f = ray.o - s.center;
        let a = ray.d.dot(ray.d);
        let b = f.dot(ray.d);
        let c = f.dot(f) - s.radius * s.radius;
        let discriminant = b * b - a * c;
        if discriminant < R::from_f64(0.0) {
            return None;
        }
        roots(ray, a, b, c, discriminant.sqrt())
    }
}

/// Returns the first root of `a t² + 2 b t + c` in the range, given the square root of `b² - a c`.
#[inline(always)]
fn roots<R: Scalar>(ray: &Ray<R>, a: R, b: R, c: R, root: R) -> Option<R> {
    if b > R::from_f64(0.0) {
        let q = -b - root;
        first_in_range(ray, q / a, c / q)
    } else {
        let q = root - b;
        first_in_range(ray, c / q, q / a)
    }
}
