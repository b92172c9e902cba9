//! The wide tree: nodes of eight children and leaves of eight primitives, laid out for SIMD lanes.

// BEGIN SOLUTION(part6.task1)
use crate::binary;
use crate::collapse::Collapse;
use crate::node::{Child, ChildKind, Node};
use crate::presplit;
use crate::sah::{BuildPrimitive, LANES};
use crate::space::TreeSpace;
use crate::sphere_block::SphereBlock;
use crate::triangle_block::{ExactBlock, TriangleBlock, exact_block};
use kit::{Bvh, BvhNode, NodeKind, PrimId};
use std::collections::VecDeque;
// END SOLUTION(part6.task1)

use fearless_simd::Level;
use kit::{Aabb, Sphere, Triangle};

/// A wide bounding volume hierarchy over triangles and spheres.
///
/// It copies the vertices of triangles, rounded to 16 bits a coordinate, the centres and the squared
/// radii. Primitives are numbered as in a [`kit::Scene`]: triangles first, then spheres.
#[derive(Clone, Debug)]
pub struct WideBvh {
    // BEGIN SOLUTION(part6.task1)
    /// Where a traversal starts: at the root node, or in a scene of a few blocks at each of them.
    pub(crate) roots: Vec<Child>,
    /// The nodes, the root first.
    pub(crate) nodes: Vec<Node>,
    /// The triangles, in blocks of eight.
    pub(crate) blocks: Vec<TriangleBlock>,
    /// The same triangles in double precision.
    pub(crate) exact_blocks: Vec<ExactBlock>,
    /// The spheres, in blocks of eight.
    pub(crate) spheres: Vec<SphereBlock>,
    /// The space of the boxes. Triangles and spheres are in world space.
    pub(crate) space: TreeSpace,
    /// The instruction set of the traversal.
    pub(crate) level: Level,
    // STUB: // Add the fields that you need.
    // END SOLUTION(part6.task1)
}

impl WideBvh {
    /// Builds the tree. A primitive with a NaN or infinite coordinate or a negative radius is
    /// omitted, because no ray hits it.
    pub fn build(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
        // BEGIN SOLUTION(part6.task1)
        let boxes = triangles.iter().map(Triangle::bounds);
        let mut bounds: Vec<Aabb> = boxes.chain(spheres.iter().map(Sphere::bounds)).collect();
        for b in &mut bounds {
            if !(b.min.is_finite() && b.max.is_finite()) {
                *b = Aabb::EMPTY;
            }
        }
        let prims: Vec<PrimId> = (0..bounds.len() as u32)
            .map(PrimId)
            .filter(|id| !bounds[id.0 as usize].is_empty())
            .collect();
        let sound: Vec<Aabb> = prims.iter().map(|id| bounds[id.0 as usize]).collect();
        let space = TreeSpace::around(&sound);
        for b in bounds.iter_mut().filter(|b| !b.is_empty()) {
            *b = space.bounds(*b);
        }
        let mut builder = Builder {
            bounds: &bounds,
            triangles,
            spheres,
            tree: WideBvh {
                roots: Vec::new(),
                nodes: Vec::new(),
                blocks: Vec::new(),
                exact_blocks: Vec::new(),
                spheres: Vec::new(),
                space,
                level: Level::new(),
            },
        };
        let (triangles, spheres) = builder.by_kind(&prims);
        if triangles.len() <= MAX_TRIANGLES_WITHOUT_NODES && spheres.len() <= LANES {
            for block in triangles.chunks(LANES).chain(spheres.chunks(LANES)) {
                let child = builder.block(block);
                builder.tree.roots.push(child);
            }
        } else {
            let binary_tree = binary::build(builder.build_primitives(triangles, spheres));
            let is_mixed = |node: &BvhNode| builder.kinds(&binary_tree, node).is_some();
            let collapse = Collapse::cheapest(&binary_tree, is_mixed);
            let root = builder.widen(&binary_tree, &collapse, 0);
            builder.tree.roots.push(root);
        }
        builder.tree
        // STUB: kit::hole!("part6.task1", triangles, spheres)
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
            + size_of_val(&*self.exact_blocks)
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

// BEGIN SOLUTION(part6.task1)
/// Up to this many triangles need no nodes: testing a node costs about as much as testing a block.
const MAX_TRIANGLES_WITHOUT_NODES: usize = 2 * LANES;

struct Builder<'a> {
    bounds: &'a [Aabb],
    triangles: &'a [Triangle],
    spheres: &'a [Sphere],
    tree: WideBvh,
}

impl Builder<'_> {
    /// Adds the wide node for node `root` of `binary` and the nodes below it.
    fn widen(&mut self, binary: &Bvh, collapse: &Collapse, root: u32) -> Child {
        let number = self.tree.nodes.len();
        self.tree.nodes.push(Node::new(&[]));
        let parts = collapse.children(binary, root);
        let mut children = Vec::with_capacity(LANES);
        // If lanes are free, the triangles and the spheres of a mixed leaf become two children.
        let mut free = LANES - parts.len();
        for number in parts {
            let part = &binary.nodes[number as usize];
            match (part.kind, self.kinds(binary, part)) {
                (NodeKind::Leaf { .. }, Some(kinds)) if free > 0 || number == root => {
                    free = free.saturating_sub(1);
                    for prims in kinds {
                        children.push((self.bounds_of(prims), self.block(prims)));
                    }
                }
                (NodeKind::Leaf { first, count }, None) => {
                    children.push((part.bounds, self.block(binary.leaf(first, count))));
                }
                _ => children.push((part.bounds, self.widen(binary, collapse, number))),
            }
        }
        self.tree.nodes[number] = Node::new(&children);
        Child::node(number, children.len())
    }

    /// The boxes that the tree is built over: of spheres, of triangles and of their parts.
    fn build_primitives(&self, triangles: &[PrimId], spheres: &[PrimId]) -> Vec<BuildPrimitive> {
        let mut prims = Vec::with_capacity(triangles.len() + spheres.len());
        let vertices = triangles.iter().map(|id| {
            let t = &self.triangles[id.0 as usize];
            (id.0, [t.p0, t.p1, t.p2].map(|p| self.tree.space.point(p)))
        });
        presplit::add_triangles(&mut prims, vertices);
        let spheres = spheres.iter();
        prims.extend(spheres.map(|id| BuildPrimitive::new(id.0, self.bounds[id.0 as usize])));
        prims
    }

    /// The triangles and the spheres of a mixed leaf; `None` for other nodes.
    fn kinds<'b>(&self, binary: &'b Bvh, node: &BvhNode) -> Option<[&'b [PrimId]; 2]> {
        let NodeKind::Leaf { first, count } = node.kind else {
            return None;
        };
        let (triangles, spheres) = self.by_kind(binary.leaf(first, count));
        (!triangles.is_empty() && !spheres.is_empty()).then_some([triangles, spheres])
    }

    fn bounds_of(&self, prims: &[PrimId]) -> Aabb {
        let boxes = prims.iter().map(|id| self.bounds[id.0 as usize]);
        boxes.fold(Aabb::EMPTY, Aabb::union)
    }

    /// Splits a list with ascending ids into triangles and spheres.
    fn by_kind<'p>(&self, prims: &'p [PrimId]) -> (&'p [PrimId], &'p [PrimId]) {
        prims.split_at(prims.partition_point(|id| (id.0 as usize) < self.triangles.len()))
    }

    /// Adds a block of up to eight primitives of one kind, whose ids ascend. Parts of one triangle
    /// become one triangle.
    fn block(&mut self, prims: &[PrimId]) -> Child {
        let mut prims = prims.to_vec();
        prims.dedup();
        let prims = &*prims;
        let first = self.triangles.len();
        if (prims[0].0 as usize) < first {
            let block = TriangleBlock::of(self.triangles, prims, &self.tree.space);
            self.tree.blocks.push(block);
            let exact = exact_block(self.triangles, prims);
            self.tree.exact_blocks.push(exact);
            Child::triangles(self.tree.blocks.len() - 1, prims.len())
        } else {
            let block = SphereBlock::of(self.spheres, first, prims);
            self.tree.spheres.push(block);
            Child::spheres(self.tree.spheres.len() - 1, prims.len())
        }
    }
}
// END SOLUTION(part6.task1)
