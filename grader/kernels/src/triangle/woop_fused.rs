// BEGIN SOLUTION(part1.task3)
//! Woop's test with areas that keep their digits when products cancel: Kahan's difference of products, which takes two
//! fused multiply-adds an edge. A sliver's areas are nearly all cancellation.
//!
//! See [`crate::exact::difference_of_products`].

use super::woop::{areas, sheared};
use super::{Meeting, TriangleTest};
use crate::exact::difference_of_products;
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Triangle};

const PAPER: &str = "Woop et al. 2013; Jeannerod et al. 2013";

/// Every area so.
pub(super) struct Fused;

impl TriangleTest for Fused {
    const ABOUT: About = About {
        name: "Woop, FMA edges",
        paper: PAPER,
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        sheared(tri, ray, |corners| areas(corners, difference_of_products))
    }
}

/// Only where a plain area comes out as 0. The plain difference of two rounded products has the right sign or is 0,
/// since rounding is monotonic: so the decisions are the same, and only the digits are not.
pub(super) struct FusedAtZero;

impl TriangleTest for FusedAtZero {
    const ABOUT: About = About {
        name: "Woop, FMA at zero",
        paper: PAPER,
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        sheared(tri, ray, |corners| {
            let plain = areas(corners, |a, b, c, d| a * b - c * d);
            let zero = R::of(0.0);
            if plain[0] == zero || plain[1] == zero || plain[2] == zero {
                areas(corners, difference_of_products)
            } else {
                plain
            }
        })
    }
}
// END SOLUTION(part1.task3)
