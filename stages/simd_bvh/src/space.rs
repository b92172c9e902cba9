// BEGIN SOLUTION(part6.task1)
//! The space that the tree lives in: around its origin, of size 1.
//!
//! Single precision has 24 digits, and they should go to what rays meet: so primitives are moved and scaled first, and
//! rays with them. A scene a million away from its origin, or a billionth in size, is as fast as any other.

use kit::{Aabb, Ray, Vec3};
use std::ops::Range;

/// `local = (world - center)·scale`, with a power of two for the scale, so that the one rounding is that of the difference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space {
    /// `center·scale`.
    shift: Vec3,
    scale: f64,
}

impl Space {
    /// The space of primitives with these boxes, which are finite and not empty. Its centre is the median of theirs: one
    /// large primitive, say a ground, does not move it away from many small ones.
    pub(crate) fn around(bounds: &[Aabb]) -> Space {
        let middle = |axis: usize| {
            let mut centers: Vec<f64> = bounds
                .iter()
                .map(|b| 0.5 * b.min[axis] + 0.5 * b.max[axis])
                .collect();
            let middle = centers.len() / 2;
            match centers.get(middle) {
                Some(_) => *centers.select_nth_unstable_by(middle, f64::total_cmp).1,
                None => 0.0,
            }
        };
        let center = Vec3::new(middle(0), middle(1), middle(2));
        let all = bounds.iter().fold(Aabb::EMPTY, |all, &b| all.union(b));
        // Half of it: the whole may overflow.
        let extent = (0.5 * all.max - 0.5 * all.min).max_element();
        // What is smaller than its distance from the world's origin by so much has few digits, however it is scaled.
        let size = extent.max(SMALLEST_SHARE * center.abs().max_element());
        let scale = power_of_two(-exponent(size));
        Space {
            shift: center * scale,
            scale,
        }
    }

    /// A point of the world.
    #[inline(always)]
    pub(crate) fn point(&self, p: Vec3) -> Vec3 {
        p * self.scale - self.shift
    }

    /// A box of the world, never smaller than what it held: the margin is a few times the rounding errors.
    pub(crate) fn bounds(&self, b: Aabb) -> Aabb {
        Aabb {
            min: self.point(b.min),
            max: self.point(b.max),
        }
    }

    /// A ray of the world.
    #[inline(always)]
    pub(crate) fn ray(&self, ray: &Ray) -> LocalRay {
        let o = self.point(ray.o);
        // Nearly all rays: nothing waits for the exponent.
        if ORDINARY.contains(&ray.d.abs().element_sum()) {
            return LocalRay {
                o,
                d: ray.d,
                speed: self.scale,
            };
        }
        let exponent = exponent(ray.d.abs().max_element()) + 2;
        LocalRay {
            o,
            d: ray.d * power_of_two(-exponent),
            speed: power_of_two(exponent) * self.scale,
        }
    }
}

/// Of an extent in a coordinate.
const SMALLEST_SHARE: f64 = 1.0 / (1_u64 << 40) as f64;

/// Where the sum of a direction's components has to be, regardless of their signs. That of a unit vector is.
pub(crate) const ORDINARY: Range<f64> = 0.25..2.0;

/// A ray in the tree's space, with an [`ORDINARY`] direction (unless it is extreme).
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalRay {
    pub(crate) o: Vec3,
    pub(crate) d: Vec3,
    /// Here a point is at `t·speed`, where in the world it is at `t`.
    pub(crate) speed: f64,
}

/// Powers of two from the inverse of this one's to this one's are used, so that they and their products are ordinary.
const LARGEST_EXPONENT: i32 = 500;

/// Of a number that is not negative; of extreme ones the nearest that is used.
#[inline(always)]
fn exponent(x: f64) -> i32 {
    let exponent = (x.to_bits() >> 52) as i32 - 1023;
    exponent.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT)
}

#[inline(always)]
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
// END SOLUTION(part6.task1)
