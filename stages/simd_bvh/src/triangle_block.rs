// BEGIN SOLUTION(part6.task1)
//! A leaf of up to eight triangles in single precision, and their bounds on rounding errors.

use crate::sah::LANES;
use crate::space::TreeSpace;
use crate::woop::Vertices;
use kit::{PrimId, Triangle, Vec3};

/// Up to eight triangles, one per lane, in the tree's space and in single precision.
///
/// They decide which triangles a ray misses for certain and which it hits for certain. The hit
/// itself is computed in double precision.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(crate) struct TriangleBlock {
    /// Coordinates by vertex and axis; 0 in lanes without a triangle.
    pub(crate) vertices: [[[f32; LANES]; 3]; 3],
    /// For each triangle the largest edge of its box, rounded up.
    pub(crate) sizes: [f32; LANES],
    ids: [u32; LANES],
}

/// The vertices of the triangles of a [`TriangleBlock`] in world space and double precision. They
/// are apart, because few blocks need them.
pub(crate) type ExactBlock = [Vertices; LANES];

impl TriangleBlock {
    /// A block of the triangles `prims` of `triangles`, one to eight.
    pub(crate) fn of(triangles: &[Triangle], prims: &[PrimId], space: &TreeSpace) -> TriangleBlock {
        let mut block = TriangleBlock {
            vertices: [[[0.0; LANES]; 3]; 3],
            sizes: [0.0; LANES],
            ids: [0; LANES],
        };
        for (lane, &id) in prims.iter().enumerate() {
            let triangle = &triangles[id.0 as usize];
            let points = [triangle.p0, triangle.p1, triangle.p2].map(|p| space.point(p));
            for (vertex, p) in points.into_iter().enumerate() {
                for axis in 0..3 {
                    block.vertices[vertex][axis][lane] = p[axis] as f32;
                }
            }
            let size = points.into_iter().fold(Vec3::NEG_INFINITY, Vec3::max)
                - points.into_iter().fold(Vec3::INFINITY, Vec3::min);
            block.sizes[lane] = (size.max_element() as f32).next_up();
            block.ids[lane] = id.0;
        }
        block
    }

    /// The vertices of the triangles `prims` in double precision; 0 in lanes without one.
    pub(crate) fn exact(triangles: &[Triangle], prims: &[PrimId]) -> ExactBlock {
        let mut block = [[[0.0; 3]; 3]; LANES];
        for (vertices, &id) in block.iter_mut().zip(prims) {
            let triangle = &triangles[id.0 as usize];
            *vertices = [triangle.p0, triangle.p1, triangle.p2].map(|p| p.to_array());
        }
        block
    }

    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> PrimId {
        PrimId(self.ids[lane & (LANES - 1)])
    }
}
// END SOLUTION(part6.task1)
