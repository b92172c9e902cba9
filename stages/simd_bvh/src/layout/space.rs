//! The tree's own space: centred at the origin, with a size of about 1.
//!
//! Single precision has 24 bits. To use all of them, primitives and rays are translated and scaled
//! first. A scene a million units away from the origin, or a billionth of a unit in size, is as
//! fast as any other.

use kit::{Aabb, Ray, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// `local = (world - center)·scale`. The scale is a power of two, so that only the difference
/// rounds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TreeSpace {
    /// `center·scale`.
    pub(crate) shift: Vec3,
    pub(crate) scale: f64,
    /// At least the absolute value of every coordinate of a primitive's box, and at least 1. It is
    /// above 4 only for scenes of extreme scale.
    pub(crate) size: f64,
}

impl TreeSpace {
    /// The space of primitives `0..count` with the boxes that `bounds` returns, which are finite
    /// and not empty; `None` for a primitive without a box.
    ///
    /// The centre is the median of the centres of a fixed sample: one large primitive, say a
    /// ground, does not move it away from many small ones. With [`SAMPLE`] centres the median is
    /// nearly always among the middle tenth of all, and hits do not depend on the space.
    pub(crate) fn around(count: usize, bounds: impl Fn(usize) -> Option<Aabb> + Sync) -> TreeSpace {
        let numbers = (0..count).into_par_iter().with_min_len(MIN_PARALLEL);
        let all = numbers
            .filter_map(&bounds)
            .reduce(|| Aabb::EMPTY, Aabb::union);
        let center = median_center(count, bounds).unwrap_or_else(|| {
            // The sample has no boxes.
            if all.is_empty() {
                Vec3::ZERO
            } else {
                0.5 * all.min + 0.5 * all.max
            }
        });
        // Half the extent, because the whole may overflow.
        let extent = (0.5 * all.max - 0.5 * all.min).max_element();
        // Coordinates of a scene that is much smaller than its distance from the world's origin
        // have few digits, whatever the scale.
        let size = extent.max(SMALLEST_SHARE * center.abs().max_element());
        let scale = power_of_two(-exponent(size));
        let mut space = TreeSpace {
            shift: center * scale,
            scale,
            size: 1.0,
        };
        let Aabb { min, max } = space.bounds(all);
        space.size = min.abs().max(max.abs()).max_element().max(1.0);
        space
    }

    /// Transforms a point from world space.
    #[inline(always)]
    pub(crate) fn point(&self, p: Vec3) -> Vec3 {
        p * self.scale - self.shift
    }

    /// Transforms a box from world space. The rounding errors are less than the margin of a node's
    /// box.
    pub(crate) fn bounds(&self, b: Aabb) -> Aabb {
        Aabb {
            min: self.point(b.min),
            max: self.point(b.max),
        }
    }

    /// Transforms a box to world space.
    pub(crate) fn world_bounds(&self, b: Aabb) -> Aabb {
        Aabb {
            min: (b.min + self.shift) / self.scale,
            max: (b.max + self.shift) / self.scale,
        }
    }

    /// Transforms a ray from world space.
    #[inline(always)]
    pub(crate) fn ray(&self, ray: &Ray) -> LocalRay {
        let o = self.point(ray.o);
        // Nearly all rays, for which no exponent is computed.
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

/// The median of the centres of at most [`SAMPLE`] boxes, on each axis; `None` if there are none.
fn median_center(count: usize, bounds: impl Fn(usize) -> Option<Aabb>) -> Option<Vec3> {
    let size = count.min(SAMPLE);
    let mut centers: Vec<Vec3> = (0..size)
        .filter_map(|i| bounds((i as u64 * count as u64 / size as u64) as usize))
        .map(|b| 0.5 * b.min + 0.5 * b.max)
        .collect();
    let middle = centers.len() / 2;
    let mut median = *centers.get(middle)?;
    for axis in 0..3 {
        let order = |a: &Vec3, b: &Vec3| a[axis].total_cmp(&b[axis]);
        median[axis] = centers.select_nth_unstable_by(middle, order).1[axis];
    }
    Some(median)
}

/// At most this many boxes, evenly spaced in the list, determine the centre of the space.
const SAMPLE: usize = 1 << 11;

/// A thread reads at least this many boxes at once.
const MIN_PARALLEL: usize = 1 << 12;

/// The smallest ratio of the extent to a coordinate that the scale takes into account.
const SMALLEST_SHARE: f64 = 1.0 / (1_u64 << 40) as f64;

/// The range of `|d.x| + |d.y| + |d.z|` for an ordinary direction, which includes unit vectors.
pub(crate) const ORDINARY: Range<f64> = 0.25..2.0;

/// A ray in the tree's space, with an [`ORDINARY`] direction unless the ray is extreme.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalRay {
    pub(crate) o: Vec3,
    pub(crate) d: Vec3,
    /// A point at `t` on the world's ray is at `t·speed` on this ray.
    pub(crate) speed: f64,
}

/// Exponents are clamped to this absolute value, so that products of two scales neither overflow
/// nor underflow.
const LARGEST_EXPONENT: i32 = 500;

/// The binary exponent of `x`, which is not negative, clamped to [`LARGEST_EXPONENT`].
#[inline(always)]
fn exponent(x: f64) -> i32 {
    let exponent = (x.to_bits() >> 52) as i32 - 1023;
    exponent.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT)
}

#[inline(always)]
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
