//! Boxes in single precision while the tree is built: 32 bytes, and a union is one operation.
//!
//! # Why a box contains every hit of its primitive
//!
//! The scalar kernels have a few rounding errors, each of about 2⁻⁵³ of the primitive's size, so
//! they may report a hit for a ray that passes a primitive at such a distance.
//! [`PackedBox::around`] enlarges the box of each primitive in double precision by [`MARGIN`] of
//! its largest edge and by [`MIN_MARGIN`], and then rounds each plane outwards. All later boxes are
//! unions of these, and the larger of two numbers has no rounding error. So the box of a node
//! contains the enlarged box of every primitive below it, and a ray that hits the primitive also
//! hits the boxes above it.

use crate::layout::LANES;
use crate::rounding::at_most;
use fearless_simd::{Simd, f32x8, prelude::*};
use kit::Aabb;

/// The margin of a primitive's box as a share of its largest edge.
const MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// The smallest margin, in the tree's space, where the tree has a size of about 1. It gives a flat
/// box a thickness, so that a ray in the plane of the box hits it. It also keeps surface areas
/// above 2⁻¹²⁰, where single precision has all its bits.
const MIN_MARGIN: f64 = 1.0 / (1_u64 << 60) as f64;

/// A box in the tree's space: `-min` in lanes 0 to 2, `max` in lanes 4 to 6. The other two are
/// free; a union leaves a number without meaning in them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct PackedBox(pub(crate) [f32; LANES]);

impl PackedBox {
    /// The box that contains nothing.
    pub(crate) const EMPTY: PackedBox = PackedBox([f32::NEG_INFINITY; LANES]);

    /// A box around `bounds` with the margin that the module describes.
    #[inline(always)]
    pub(crate) fn around(bounds: Aabb) -> PackedBox {
        let margin = MARGIN * bounds.extent().max_element() + MIN_MARGIN;
        let (min, max) = (bounds.min - margin, bounds.max + margin);
        PackedBox([
            -at_most(min.x),
            -at_most(min.y),
            -at_most(min.z),
            0.0,
            -at_most(-max.x),
            -at_most(-max.y),
            -at_most(-max.z),
            0.0,
        ])
    }

    /// The lower plane on an axis.
    #[inline(always)]
    pub(crate) fn min(&self, axis: usize) -> f32 {
        -self.0[axis]
    }

    /// The upper plane on an axis.
    #[inline(always)]
    pub(crate) fn max(&self, axis: usize) -> f32 {
        self.0[axis + 4]
    }

    #[inline(always)]
    pub(crate) fn union(self, other: PackedBox) -> PackedBox {
        PackedBox(std::array::from_fn(|lane| self.0[lane].max(other.0[lane])))
    }

    /// Whether all planes are finite. In a scene of extreme size they are not.
    pub(crate) fn is_finite(&self) -> bool {
        (0..3).all(|axis| self.min(axis).is_finite() && self.max(axis).is_finite())
    }

    /// Half the surface.
    #[inline(always)]
    pub(crate) fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.0[axis + 4] + self.0[axis]);
        x * y + y * z + z * x
    }

    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S) -> f32x8<S> {
        f32x8::load_array_ref(simd, &self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Vec3;

    #[test]
    fn boxes_are_always_rounded_outwards() {
        for x in [
            0.0, 1.0, -1.0, 0.1, -0.1, 1e-300, -1e-300, 1e30, -1e30, 3.5e38, -3.5e38, 1e300, -1e300,
        ] {
            let packed = PackedBox::around(Aabb {
                min: Vec3::splat(x),
                max: Vec3::splat(x),
            });
            // Half a unit in the last place is left for the rounding errors of double precision.
            let least = MIN_MARGIN.max(x.abs() * 0.5_f64.powi(26)).min(1e30);
            for axis in 0..3 {
                assert!(f64::from(packed.min(axis)) <= x - least, "{x}: {packed:?}");
                assert!(f64::from(packed.max(axis)) >= x + least, "{x}: {packed:?}");
            }
            assert_eq!(packed.is_finite(), x.abs() < 1e38, "{x}: {packed:?}");
        }
    }

    #[test]
    fn a_long_box_has_a_margin_of_its_size() {
        let bounds = Aabb {
            min: Vec3::ZERO,
            max: Vec3::new(0.0, 1.0, 0.0),
        };
        let packed = PackedBox::around(bounds);
        assert!(f64::from(packed.min(0)) <= -MARGIN && f64::from(packed.max(2)) >= MARGIN);
        let tiny = PackedBox::around(Aabb {
            min: Vec3::ZERO,
            max: Vec3::ZERO,
        });
        assert!(tiny.half_area() > 2.0 * f32::MIN_POSITIVE);
        let both = tiny.union(packed);
        assert_eq!(both.half_area(), packed.half_area());
    }
}
