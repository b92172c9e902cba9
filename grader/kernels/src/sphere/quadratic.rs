//! The textbook quadratic formula. `b² - 4ac` cancels if the sphere is far away, `-b + √` if the
//! origin is near the surface.
//!
//! E. Haines, "Essential Ray Tracing Algorithms", in A. Glassner (ed.), An Introduction to Ray
//! Tracing, 1989.

use super::test::{SphereTest, first_in_range};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Sphere};
use lanes::Scalar;

pub(super) struct Quadratic;

impl SphereTest for Quadratic {
    const INFO: KernelInfo = KernelInfo::new("quadratic formula", "Haines 1989");
    const REPROJECTED: KernelInfo = KernelInfo {
        name: "quadratic, reprojected",
        ..Self::INFO
    };

    #[inline(always)]
    fn intersect<R: Scalar>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R> {
        let two = R::from_f64(2.0);
        let f = ray.o - s.center;
        let a = ray.d.dot(ray.d);
        let b = two * f.dot(ray.d);
        let c = f.dot(f) - s.radius * s.radius;
        let discriminant = b * b - R::from_f64(4.0) * a * c;
        if discriminant < R::from_f64(0.0) {
            return None;
        }
        let root = discriminant.sqrt();
        first_in_range(ray, (-b - root) / (two * a), (-b + root) / (two * a))
    }
}
