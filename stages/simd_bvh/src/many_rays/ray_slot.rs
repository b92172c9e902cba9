//! The state of one of many rays that are traced together.

use crate::intersect::ExactTest;
use crate::kernels::found::Found;
use crate::kernels::ray_in_tree::{RayInTree, TScale};
use crate::kernels::simd_box_test::Key;
use crate::kernels::simd_box_test::{SimdBoxTest, range_end};
use crate::kernels::triangle_filter::TriangleFilter;
use crate::kernels::woop::{self, Decision};
use crate::many_rays::slot_stack::SlotStack;
use crate::rounding::at_least;
use crate::wide::WideBvh;
use fearless_simd::Simd;
use kit::{PrimId, Ray};

/// The state of one ray.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct RaySlot {
    pub(crate) boxes: SimdBoxTest,
    /// At least the end of the range, for boxes and for triangles.
    pub(crate) end: Key,
    pub(crate) limit: f32,
    /// A number that no primitive has if the ray may hit all.
    pub(crate) skip: PrimId,
    /// Whether any primitive is hit.
    pub(crate) is_hit: bool,
    pub(crate) filter: TriangleFilter,
    pub(crate) stack: SlotStack,
    scale: TScale,
    /// The nearest of the triangles that are hit for certain and not computed yet.
    candidate: Option<Candidate>,
    /// The closest hit that is computed.
    pub(crate) found: Found,
}

/// A triangle that a ray hits for certain.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    at: TriangleAt,
    /// At most the `t` of the hit, in the tree's space.
    nearest: f32,
}

/// The block and the lane of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleAt {
    pub(crate) block: u32,
    pub(crate) lane: u32,
}

/// No primitive has this number: a tree has at most 2³⁰.
const NO_PRIM: PrimId = PrimId(u32::MAX);

impl Default for RaySlot {
    fn default() -> RaySlot {
        RaySlot {
            boxes: SimdBoxTest::default(),
            end: 0,
            limit: 0.0,
            skip: NO_PRIM,
            is_hit: false,
            filter: TriangleFilter::default(),
            stack: SlotStack::default(),
            scale: TScale::default(),
            candidate: None,
            found: Found::default(),
        }
    }
}

impl RaySlot {
    /// Removes all hits.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.is_hit = false;
        self.candidate = None;
        self.found = Found::default();
    }

    /// Prepares the slot for a ray, except the stack.
    #[inline(always)]
    pub(crate) fn start<S: Simd>(&mut self, simd: S, ray: &RayInTree, skip: Option<PrimId>) {
        self.boxes = SimdBoxTest::new(simd, ray);
        self.filter = TriangleFilter::new(ray);
        self.limit = at_least(ray.max_t);
        self.end = range_end(self.limit);
        self.skip = skip.unwrap_or(NO_PRIM);
        self.scale = ray.scale;
    }

    /// Adds a hit that is certain, with a `t` in `interval`. Most often only the last of them is
    /// computed: one that is farther than another for certain is not needed.
    #[inline(always)]
    pub(crate) fn add_candidate(
        &mut self,
        tree: &WideBvh,
        at: TriangleAt,
        interval: [f32; 2],
        ray: &Ray,
        exact: &mut ExactTest,
    ) {
        let [nearest, farthest] = interval;
        self.limit = self.limit.min(farthest);
        if self.candidate.is_none_or(|other| farthest < other.nearest) {
            // They are needed after the traversal.
            tree.prefetch_vertices(at.block as usize, at.lane as usize);
            self.candidate = Some(Candidate { at, nearest });
        } else {
            self.test(tree, at, ray, exact);
        }
    }

    /// Computes the hit that is still to be computed.
    #[inline(always)]
    pub(crate) fn compute_candidate(&mut self, tree: &WideBvh, ray: &Ray, exact: &mut ExactTest) {
        if let Some(candidate) = self.candidate {
            self.test(tree, candidate.at, ray, exact);
        }
    }

    /// Tests a triangle in double precision. Returns whether it is hit in the range.
    #[inline(always)]
    pub(crate) fn test(
        &mut self,
        tree: &WideBvh,
        at: TriangleAt,
        ray: &Ray,
        exact: &mut ExactTest,
    ) -> bool {
        let (block, lane) = (at.block as usize, at.lane as usize & 7);
        let id = tree.blocks[block].id(lane);
        match woop::test(tree.vertices(block, lane), ray, self.filter.axes) {
            Decision::Hit(hit) => {
                self.found.accept(id, hit);
                self.shorten(hit.t);
                true
            }
            Decision::Miss => false,
            Decision::Undecided => self.test_scalar(id, ray, exact),
        }
    }

    /// Tests a primitive with the scalar kernel. Returns whether it is hit in the range.
    #[inline(always)]
    pub(crate) fn test_scalar(&mut self, id: PrimId, ray: &Ray, exact: &mut ExactTest) -> bool {
        match self.found.test(id, ray, exact) {
            Some(t) => {
                self.shorten(t);
                true
            }
            None => false,
        }
    }

    /// Ends the range for triangles at a hit at `t` of the world's ray.
    #[inline(always)]
    fn shorten(&mut self, t: f64) {
        self.limit = self.limit.min(at_least(self.scale.local_t(t)));
    }

    /// Ends the range for boxes where that for triangles ends, and removes the children behind.
    #[inline(always)]
    pub(crate) fn cull<S: Simd>(&mut self, simd: S) {
        self.end = range_end(self.limit);
        self.stack.cull(simd, self.end);
    }
}
