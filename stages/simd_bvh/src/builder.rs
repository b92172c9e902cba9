// BEGIN SOLUTION(part6.task1)
//! Builds the wide tree: from triangles and spheres to nodes and blocks.

use crate::binary;
use crate::collapse::Collapse;
use crate::node::{Child, Node};
use crate::presplit;
use crate::sah::{BuildPrimitive, LANES};
use crate::space::TreeSpace;
use crate::sphere_block::SphereBlock;
use crate::triangle_block::{TriangleBlock, exact_block};
use crate::wide::WideBvh;
use fearless_simd::Level;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId, Sphere, Triangle};
use rayon::prelude::*;

/// Up to this many triangles need no nodes: testing a node costs about as much as testing a block.
const MAX_TRIANGLES_WITHOUT_NODES: usize = 2 * LANES;

/// Builds the tree. A primitive without a finite box that is not empty is omitted.
pub(crate) fn build(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
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
        blocks: Vec::new(),
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
    builder.finish()
}

struct Builder<'a> {
    /// The boxes of all primitives in the tree's space.
    bounds: &'a [Aabb],
    triangles: &'a [Triangle],
    spheres: &'a [Sphere],
    /// The triangles of each block.
    blocks: Vec<Vec<PrimId>>,
    /// The tree, so far without blocks of triangles.
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
        for child in parts {
            let part = &binary.nodes[child as usize];
            match (part.kind, self.kinds(binary, part)) {
                (NodeKind::Leaf { .. }, Some(kinds)) if free > 0 || child == root => {
                    free = free.saturating_sub(1);
                    for prims in kinds {
                        children.push((self.bounds_of(prims), self.block(prims)));
                    }
                }
                (NodeKind::Leaf { first, count }, None) => {
                    children.push((part.bounds, self.block(binary.leaf(first, count))));
                }
                _ => children.push((part.bounds, self.widen(binary, collapse, child))),
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
        let count = prims.len();
        let first_sphere = self.triangles.len();
        if (prims[0].0 as usize) < first_sphere {
            self.blocks.push(prims);
            Child::triangles(self.blocks.len() - 1, count)
        } else {
            let block = SphereBlock::of(self.spheres, first_sphere, &prims);
            self.tree.spheres.push(block);
            Child::spheres(self.tree.spheres.len() - 1, count)
        }
    }

    /// The tree with its blocks of triangles, in parallel.
    fn finish(self) -> WideBvh {
        let (triangles, space) = (self.triangles, &self.tree.space);
        let blocks = self.blocks.par_iter();
        let (blocks, exact_blocks) = blocks
            .map(|prims| {
                let block = TriangleBlock::of(triangles, prims, space);
                (block, exact_block(triangles, prims))
            })
            .unzip();
        let mut tree = self.tree;
        tree.nodes.shrink_to_fit();
        WideBvh {
            blocks,
            exact_blocks,
            ..tree
        }
    }
}
// END SOLUTION(part6.task1)
