//! The wide tree: nodes of eight children and leaves of eight primitives, laid out for SIMD lanes.

// BEGIN SOLUTION(part6.task1)
use crate::build::builder;
use crate::kernels::woop::Vertices;
use crate::layout::node::{Child, ChildKind, Node};
use crate::layout::prefetch::prefetch;
use crate::layout::space::TreeSpace;
use crate::layout::sphere_block::SphereBlock;
use crate::layout::triangle_block::TriangleBlock;
use crate::layout::vertex_list::{BLOCK_BYTES, BlockVertices, ExactVertex};
use std::collections::VecDeque;
use std::hint::select_unpredictable;
// END SOLUTION(part6.task1)

use fearless_simd::Level;
use kit::{Aabb, PrimId, Sphere, Triangle};

/// A wide bounding volume hierarchy over triangles and spheres.
///
/// It copies the vertices of triangles, rounded to 16 bits a coordinate and in double precision,
/// the centres and the squared radii. Primitives are numbered as in a [`kit::Scene`]: triangles
/// first, then spheres.
#[derive(Clone, Debug)]
pub struct WideBvh {
    // BEGIN SOLUTION(part6.task1)
    /// Where a traversal starts: at the root node, or in a scene of a few blocks at each of them;
    /// and at the blocks of large primitives that are apart.
    pub(crate) roots: Vec<Child>,
    /// How many of the roots are not blocks of primitives that are apart.
    pub(crate) inner_roots: usize,
    /// The primitives that are apart, in ascending order.
    pub(crate) apart: Vec<PrimId>,
    /// The nodes, the root first.
    pub(crate) nodes: Vec<Node>,
    /// The triangles, in blocks of eight.
    pub(crate) blocks: Vec<TriangleBlock>,
    /// Where the vertices of each block's triangles are.
    pub(crate) block_vertices: Vec<BlockVertices>,
    /// The vertices of the triangles in double precision, near others of their block.
    pub(crate) vertices: Vec<ExactVertex>,
    /// The spheres, in blocks of eight.
    pub(crate) spheres: Vec<SphereBlock>,
    /// The space of the boxes. Triangles and spheres are in world space.
    pub(crate) space: TreeSpace,
    /// The instruction set of the traversal.
    pub(crate) level: Level,
    // STUB: // Add the fields that you need.
    // END SOLUTION(part6.task1)
}

/// Which primitives of a tree rays may hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subset {
    /// All.
    #[default]
    All,
    /// Those that are not apart ([`WideBvh::build_apart`]). The others may be hit, too.
    Inner,
}

impl WideBvh {
    /// Builds the tree. A primitive with a NaN or infinite coordinate or a negative radius is
    /// omitted, because no ray hits it.
    pub fn build(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        builder::build(triangles, spheres, false)
        // STUB: kit::hole!("part6.task1", triangles, spheres)
        // END SOLUTION(part6.task1)
    }

    /// Builds the tree with a few large primitives apart, such as the walls of a room, if rays may
    /// take less time so: a traversal can leave them out ([`Subset::Inner`]), because they are
    /// beside the root and not below it. Otherwise like [`WideBvh::build`].
    pub fn build_apart(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        builder::build(triangles, spheres, true)
        // STUB: kit::hole!("part6.task1", triangles, spheres)
        // END SOLUTION(part6.task1)
    }

    /// The primitives that are apart, in ascending order.
    pub fn apart(&self) -> &[PrimId] {
        // BEGIN SOLUTION(part6.task1)
        &self.apart
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }

    /// The same tree for the instruction set `level` instead of the best one of this machine. Hits
    /// and counts are the same.
    #[must_use]
    pub fn at_level(self, level: Level) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        WideBvh { level, ..self }
        // STUB: kit::hole!("part6.task1", self, level)
        // END SOLUTION(part6.task1)
    }

    /// The number of nodes.
    pub fn node_count(&self) -> usize {
        // BEGIN SOLUTION(part6.task1)
        self.nodes.len()
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }

    /// The memory of the tree in bytes, without unused capacity.
    pub fn byte_count(&self) -> usize {
        // BEGIN SOLUTION(part6.task1)
        size_of_val(&*self.nodes)
            + size_of_val(&*self.blocks)
            + size_of_val(&*self.block_vertices)
            + size_of_val(&*self.vertices)
            + size_of_val(&*self.spheres)
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }

    /// The number of blocks of up to eight triangles or spheres.
    pub fn block_count(&self) -> usize {
        // BEGIN SOLUTION(part6.task1)
        self.blocks.len() + self.spheres.len()
        // STUB: kit::hole!("part6.task1", self)
        // END SOLUTION(part6.task1)
    }

    // BEGIN SOLUTION(part6.task1)
    /// Where a traversal of `subset` starts.
    #[inline(always)]
    pub(crate) fn roots_of(&self, subset: Subset) -> &[Child] {
        match subset {
            Subset::All => &self.roots,
            Subset::Inner => &self.roots[..self.inner_roots],
        }
    }

    /// The vertices of the triangle in a lane of block number `index`.
    #[inline(always)]
    pub(crate) fn vertices(&self, index: usize, lane: usize) -> Vertices<'_> {
        let [a, b, c] = self.block_vertices[index].corners(lane);
        [&self.vertices[a], &self.vertices[b], &self.vertices[c]]
    }

    /// Starts to load the vertices of the triangle in a lane of block number `index`. In the end
    /// its hit is computed from them.
    #[inline(always)]
    pub(crate) fn prefetch_vertices(&self, index: usize, lane: usize) {
        for corner in self.block_vertices[index].corners(lane) {
            let vertex = self.vertices.as_ptr().wrapping_add(corner);
            prefetch::<{ size_of::<ExactVertex>() }>(vertex.cast());
        }
    }

    /// Starts to load the vertices of block number `index`, before it is known which are needed.
    #[inline(always)]
    pub(crate) fn prefetch_block_vertices(&self, index: usize) {
        let first = self.block_vertices[index].first as usize;
        let vertices = self.vertices.as_ptr().wrapping_add(first);
        prefetch::<BLOCK_BYTES>(vertices.cast());
    }

    /// Starts to load a node or a block of triangles. Which of them is hard to predict, so it does
    /// not branch, and loads as many bytes for either.
    #[inline(always)]
    pub(crate) fn prefetch(&self, child: Child) {
        let node = self.nodes.as_ptr().wrapping_add(child.index());
        let block = self.blocks.as_ptr().wrapping_add(child.index());
        let start = select_unpredictable(child.is_node(), node.cast(), block.cast());
        prefetch::<{ size_of::<Node>() }>(start);
    }
    // END SOLUTION(part6.task1)

    /// The boxes of the children of nodes in world space, each with its depth (0 for the children of
    /// the root), breadth first: at most `most` of them. For drawing.
    pub fn boxes(&self, most: usize) -> Vec<(Aabb, usize)> {
        // BEGIN SOLUTION(part6.task1)
        let mut boxes = Vec::new();
        let mut pending: VecDeque<_> = self.roots.iter().map(|&root| (root, 0)).collect();
        while let Some((child, depth)) = pending.pop_front() {
            let ChildKind::Node { index, count } = child.kind() else {
                continue;
            };
            let node = &self.nodes[index];
            for lane in 0..count as usize {
                if boxes.len() == most {
                    return boxes;
                }
                boxes.push((self.space.world_bounds(node.bounds(lane)), depth));
                pending.push_back((Child(node.children[lane]), depth + 1));
            }
        }
        boxes
        // STUB: kit::hole!("part6.task1", self, most)
        // END SOLUTION(part6.task1)
    }
}
