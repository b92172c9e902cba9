//! The discriminant as `a (r² - |l|²)`, where `l = f - (b/a) d` is the vector from the centre to
//! the nearest point of the line. It compares the radius with a distance, instead of subtracting
//! two numbers as large as the squared distance of the sphere.
//!
//! E. Haines, J. Günther, T. Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection",
//! Ray Tracing Gems, chapter 7, 2019.

use super::test::{SphereTest, first_in_range};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Sphere};
use lanes::Scalar;
use lanes::sphere::SphereEquation;

pub(super) struct Haines;

impl SphereTest for Haines {
    const INFO: KernelInfo = KernelInfo::new("Haines's discriminant", "Haines et al. 2019");
    const REPROJECTED: KernelInfo = KernelInfo {
        name: "Haines's, reprojected",
        ..Self::INFO
    };

    #[inline(always)]
    fn intersect<R: Scalar>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R> {
        let equation = SphereEquation::of(ray, s);
        if !equation.has_roots() {
            return None;
        }
        let [near, far] = equation.roots();
        first_in_range(ray, near, far)
    }
}
