// BEGIN SOLUTION(part1.task4)
//! The discriminant as `a (r² - |l|²)`, where `l = f - (b/a) d` goes from the centre to the nearest point of the line:
//! radius against distance, instead of the difference of two numbers as large as the distance to the sphere squared.
//!
//! E. Haines, J. Günther, T. Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
//! chapter 7, 2019.

use super::SphereTest;
use super::q_form::roots;
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Sphere};

pub(super) struct Haines;

impl SphereTest for Haines {
    const ABOUT: About = About {
        name: "Haines's discriminant",
        paper: "Haines et al. 2019",
        culls: false,
    };
    const REPROJECTED: About = About {
        name: "Haines's, reprojected",
        ..Self::ABOUT
    };

    #[inline(always)]
    fn meet<R: Real>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R> {
        let f = ray.o - s.center;
        let a = ray.d.dot(ray.d);
        let b = f.dot(ray.d);
        let l = f - ray.d * (b / a);
        let r2 = s.radius * s.radius;
        let discriminant = r2 - l.dot(l);
        if discriminant < R::of(0.0) {
            return None;
        }
        let c = f.dot(f) - r2;
        roots(ray, a, b, c, (a * discriminant).sqrt())
    }
}
// END SOLUTION(part1.task4)
