// BEGIN SOLUTION(part1.task4)
//! The quadratic formula from school. `b² - 4ac` loses its digits when the sphere is far, `-b + √` when the origin is
//! near the surface.
//!
//! E. Haines, "Essential Ray Tracing Algorithms", in A. Glassner (ed.), An Introduction to Ray Tracing, 1989.

use super::{SphereTest, first_in_range};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Sphere};

pub(super) struct Quadratic;

impl SphereTest for Quadratic {
    const ABOUT: About = About {
        name: "quadratic formula",
        paper: "Haines 1989",
        culls: false,
    };
    const REPROJECTED: About = About {
        name: "quadratic, reprojected",
        ..Self::ABOUT
    };

    #[inline(always)]
    fn meet<R: Real>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R> {
        let two = R::of(2.0);
        let f = ray.o - s.center;
        let a = ray.d.dot(ray.d);
        let b = two * f.dot(ray.d);
        let c = f.dot(f) - s.radius * s.radius;
        let discriminant = b * b - R::of(4.0) * a * c;
        if discriminant < R::of(0.0) {
            return None;
        }
        let root = discriminant.sqrt();
        first_in_range(ray, (-b - root) / (two * a), (-b + root) / (two * a))
    }
}
// END SOLUTION(part1.task4)
