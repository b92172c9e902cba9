// BEGIN SOLUTION(part6.task1)
//! What one ray tests on its way through the tree: boxes and blocks of triangles.

use crate::box_test::{BoxHits, Key, ScalarBoxTest};
use crate::node::Node;
use crate::ray_in_tree::RayInTree;
use crate::simd_box_test::SimdBoxTest;
use crate::triangle_block::TriangleBlock;
use crate::triangle_filter::{FilterHits, TriangleFilter};
use fearless_simd::Simd;

/// One ray and its range, whose end comes closer with every hit.
pub(crate) trait RayTests<S: Simd> {
    /// The boxes of `node` that the ray hits in its range.
    fn boxes(&self, node: &Node) -> BoxHits;

    /// Whether a box with this key is still in the range.
    fn is_within(&self, key: Key) -> bool;

    /// The triangles of `block`, which has `count`, that the ray may hit in its range.
    fn triangles(&mut self, simd: S, block: &TriangleBlock, count: u32) -> FilterHits<S>;

    /// The axes that a triangle test permutes. Only defined after a test of triangles.
    fn axes(&self) -> Option<[usize; 3]>;

    /// Ends the range at `max_t` of the ray in world space, where it has a hit.
    fn shorten(&mut self, max_t: f64);

    /// Ends the range at `farthest` of [`FilterHits::interval`].
    fn shorten_local(&mut self, farthest: f32);

    /// Whether a hit at `nearest` of [`FilterHits::interval`] may be in the range.
    fn reaches(&self, nearest: f32) -> bool;

    /// Has to be called before the next test of boxes if the range was shortened.
    fn update(&mut self);
}

/// A ray of ordinary size, tested in single precision.
pub(crate) struct OrdinaryRay<S: Simd> {
    ray: RayInTree,
    boxes: SimdBoxTest<S>,
    /// Computed at the first block: many rays reach none.
    filter: Option<TriangleFilter>,
    /// At least the end of the range, in the tree's space.
    limit: f32,
    is_shortened: bool,
}

impl<S: Simd> OrdinaryRay<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: RayInTree) -> OrdinaryRay<S> {
        let limit = (ray.max_t as f32).next_up();
        let mut boxes = SimdBoxTest::new(simd, &ray);
        boxes.shorten(limit);
        OrdinaryRay {
            ray,
            boxes,
            filter: None,
            limit,
            is_shortened: false,
        }
    }
}

impl<S: Simd> RayTests<S> for OrdinaryRay<S> {
    #[inline(always)]
    fn boxes(&self, node: &Node) -> BoxHits {
        self.boxes.test(node)
    }

    #[inline(always)]
    fn is_within(&self, key: Key) -> bool {
        self.boxes.is_within(key)
    }

    #[inline(always)]
    fn triangles(&mut self, simd: S, block: &TriangleBlock, count: u32) -> FilterHits<S> {
        if self.filter.is_none() {
            self.filter = Some(TriangleFilter::new(&self.ray));
        }
        match &self.filter {
            Some(filter) => filter.test(simd, block, count, self.limit),
            None => FilterHits::all(simd, 0),
        }
    }

    #[inline(always)]
    fn axes(&self) -> Option<[usize; 3]> {
        self.filter.as_ref().map(|filter| filter.axes)
    }

    #[inline(always)]
    fn shorten(&mut self, max_t: f64) {
        self.shorten_local((self.ray.local_t(max_t) as f32).next_up());
    }

    #[inline(always)]
    fn shorten_local(&mut self, farthest: f32) {
        self.limit = self.limit.min(farthest);
        self.is_shortened = true;
    }

    #[inline(always)]
    fn reaches(&self, nearest: f32) -> bool {
        nearest <= self.limit
    }

    #[inline(always)]
    fn update(&mut self) {
        if self.is_shortened {
            self.is_shortened = false;
            self.boxes.shorten(self.limit);
        }
    }
}

/// Any other ray: every triangle of a block needs the scalar kernel.
impl<S: Simd> RayTests<S> for ScalarBoxTest {
    fn boxes(&self, node: &Node) -> BoxHits {
        self.test(node)
    }

    fn is_within(&self, key: Key) -> bool {
        ScalarBoxTest::is_within(self, key)
    }

    fn triangles(&mut self, simd: S, _: &TriangleBlock, count: u32) -> FilterHits<S> {
        FilterHits::all(simd, count)
    }

    fn axes(&self) -> Option<[usize; 3]> {
        None
    }

    fn shorten(&mut self, max_t: f64) {
        ScalarBoxTest::shorten(self, max_t);
    }

    fn shorten_local(&mut self, _: f32) {}

    fn reaches(&self, _: f32) -> bool {
        true
    }

    fn update(&mut self) {}
}
// END SOLUTION(part6.task1)
