//! Woop's test with accurate areas: Kahan's difference of products, with two fused multiply-adds
//! per edge, is accurate although the products cancel. The areas of a sliver cancel almost
//! completely.
//!
//! See [`crate::exact::difference_of_products`].

use super::test::{TriangleHit, TriangleTest};
use super::woop::{areas, sheared};
use crate::exact::difference_of_products;
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Triangle};
use lanes::Scalar;

const PAPER: &str = "Woop et al. 2013; Jeannerod et al. 2013";

/// Uses it for every area.
pub(super) struct Fused;

impl TriangleTest for Fused {
    const INFO: KernelInfo = KernelInfo::new("Woop, FMA edges", PAPER).fused();

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        sheared(tri, ray, |corners| areas(corners, difference_of_products))
    }
}

/// Uses it only if a plain area is 0. The plain difference of two rounded products has the correct
/// sign or is 0, because rounding is monotonic: so the decisions are the same, and only the
/// accuracy differs.
pub(super) struct FusedAtZero;

impl TriangleTest for FusedAtZero {
    const INFO: KernelInfo = KernelInfo::new("Woop, FMA at zero", PAPER).fused();

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        sheared(tri, ray, |corners| {
            let plain = areas(corners, |a, b, c, d| a * b - c * d);
            let zero = R::from_f64(0.0);
            if plain[0] == zero || plain[1] == zero || plain[2] == zero {
                areas(corners, difference_of_products)
            } else {
                plain
            }
        })
    }
}
