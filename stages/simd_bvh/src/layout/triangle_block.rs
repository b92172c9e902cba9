//! A leaf of up to eight triangles with 16 bits a coordinate.

use crate::layout::LANES;
use crate::layout::space::TreeSpace;
use fearless_simd::{Simd, prelude::*, u32x8};
use kit::{PrimId, Triangle, Vec3};

/// Up to eight triangles, one per lane, in the tree's space.
///
/// A coordinate is an integer from 0 to 65535: `origin + unit·integer`, rounded to the nearest. So
/// a block has 24 bytes a triangle, with its number, and large meshes wait less for memory. The
/// blocks decide which triangles a ray misses for certain and which it hits for certain; the hit
/// itself is computed from the exact vertices.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct TriangleBlock {
    /// Coordinates by vertex and axis; 0 in lanes without a triangle.
    pub(crate) vertices: [[[u16; LANES]; 3]; 3],
    ids: [u32; LANES],
    /// A point below all vertices.
    pub(crate) origin: [f32; 3],
    /// A power of two.
    pub(crate) unit: f32,
}

/// The smallest unit. It is far above the rounding errors of double precision, relative to a tree
/// of size 1.
pub(crate) const SMALLEST_UNIT: f64 = 1.0 / (1_u64 << 38) as f64;

/// A number from 0 to 65535 plus this one is rounded to the nearest integer: the last bits of the
/// sum.
const ROUND: f64 = (1_u64 << 52) as f64;

impl TriangleBlock {
    /// A block of the triangles `prims` of `triangles`, one to eight.
    #[inline(always)]
    pub(crate) fn of(triangles: &[Triangle], prims: &[PrimId], space: &TreeSpace) -> TriangleBlock {
        let mut points = [[Vec3::ZERO; 3]; LANES];
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for (points, &id) in points.iter_mut().zip(prims) {
            let triangle = &triangles[id.0 as usize];
            *points = [triangle.p0, triangle.p1, triangle.p2].map(|p| space.point(p));
            for &point in &*points {
                (low, high) = (low.min(point), high.max(point));
            }
        }
        let origin = low.to_array().map(|x| (x as f32).next_down());
        let corner = Vec3::from(origin.map(f64::from));
        let unit = unit_for((high - corner).max_element());
        let per_unit = 1.0 / unit;
        let mut block = TriangleBlock {
            vertices: [[[0; LANES]; 3]; 3],
            ids: [0; LANES],
            origin,
            unit: unit as f32,
        };
        for (lane, (points, &id)) in points.iter().zip(prims).enumerate() {
            for (vertex, &point) in points.iter().enumerate() {
                let steps = (point - corner) * per_unit + ROUND;
                for axis in 0..3 {
                    block.vertices[vertex][axis][lane] = steps[axis].to_bits() as u16;
                }
            }
            block.ids[lane] = id.0;
        }
        block
    }

    /// The inverse of the unit, exactly.
    #[inline(always)]
    pub(crate) fn steps_per_length(&self) -> f32 {
        // The bits of a power of two are its exponent plus 127, shifted by 23.
        f32::from_bits((254 << 23) - self.unit.to_bits())
    }

    /// One bit for each lane that has triangle `id`.
    #[inline(always)]
    pub(crate) fn lanes_of<S: Simd>(&self, simd: S, id: PrimId) -> u32 {
        let ids = u32x8::load_array_ref(simd, &self.ids);
        ids.simd_eq(id.0).to_bitmask() as u32
    }

    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> PrimId {
        PrimId(self.ids[lane & (LANES - 1)])
    }
}

/// The smallest power of two that divides `extent` into at most 65535 steps.
#[inline(always)]
fn unit_for(extent: f64) -> f64 {
    let unit = (extent / 65535.0).max(SMALLEST_UNIT);
    // The bits of the exponent alone are the power of two at or below.
    let floor = f64::from_bits(unit.to_bits() & !((1 << 52) - 1));
    if floor < unit { 2.0 * floor } else { floor }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_are_rounded_to_the_nearest_step() {
        let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
        let triangles = [
            Triangle::flat(at(0.1, 0.2, 0.3), at(0.7, -0.4, 0.31), at(0.5, 0.9, -1.0)),
            Triangle::flat(at(-0.1, 0.0, 0.0), at(0.0, 1e-9, 0.0), at(0.3, 0.3, 0.3)),
        ];
        let bounds: Vec<_> = triangles.iter().map(Triangle::bounds).collect();
        let space = TreeSpace::around(2, |number| Some(bounds[number]));
        let block = TriangleBlock::of(&triangles, &[PrimId(0), PrimId(1)], &space);
        let unit = f64::from(block.unit);
        assert_eq!(f64::from(block.steps_per_length()), 1.0 / unit);
        for (lane, t) in triangles.iter().enumerate() {
            for (vertex, p) in [t.p0, t.p1, t.p2].into_iter().enumerate() {
                for axis in 0..3 {
                    let steps = f64::from(block.vertices[vertex][axis][lane]);
                    let stored = f64::from(block.origin[axis]) + unit * steps;
                    assert!((stored - space.point(p)[axis]).abs() <= 0.5 * unit);
                }
            }
        }
    }

    #[test]
    fn units_are_the_smallest_powers_of_two() {
        assert_eq!(unit_for(65535.0), 1.0);
        assert_eq!(unit_for(65536.0), 2.0);
        assert_eq!(unit_for(32767.0), 0.5);
        assert_eq!(unit_for(0.0), SMALLEST_UNIT);
    }
}
