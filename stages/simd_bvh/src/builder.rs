// BEGIN SOLUTION(part6.task1)
//! Builds the wide tree: from triangles and spheres to nodes and blocks.

use crate::binary;
use crate::node::Child;
use crate::presplit;
use crate::sah::{BuildPrimitive, LANES};
use crate::space::TreeSpace;
use crate::sphere_block::SphereBlock;
use crate::triangle_block::{TriangleBlock, exact_block};
use crate::wide::WideBvh;
use crate::widen::{WideNodes, widen};
use fearless_simd::{Level, dispatch};
use kit::{Aabb, PrimId, Sphere, Triangle, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// Up to this many triangles need no nodes: testing a node costs about as much as testing a block.
const MAX_TRIANGLES_WITHOUT_NODES: usize = 2 * LANES;

/// A thread prepares at least this many primitives at once.
const MIN_PARALLEL: usize = 1 << 11;

/// Builds the tree. A primitive without a finite box that is not empty is omitted.
pub(crate) fn build(triangles: &[Triangle], spheres: &[Sphere]) -> WideBvh {
    let input = Input { triangles, spheres };
    let count = triangles.len() + spheres.len();
    let space = TreeSpace::around(count, |number| input.bounds(number));
    let level = Level::new();
    let mut tree = WideBvh {
        roots: Vec::new(),
        nodes: Vec::new(),
        blocks: Vec::new(),
        exact_blocks: Vec::new(),
        spheres: Vec::new(),
        space,
        level,
    };
    let mut prims = input.primitives(&space);
    let is_triangle = |prim: &&BuildPrimitive| (prim.id() as usize) < triangles.len();
    let triangle_count = prims.iter().filter(is_triangle).count();
    if triangle_count <= MAX_TRIANGLES_WITHOUT_NODES && prims.len() - triangle_count <= LANES {
        let blocks = |range: Range<usize>| -> Vec<Range<u32>> {
            let starts = range.clone().step_by(LANES);
            starts
                .map(|start| start as u32..range.end.min(start + LANES) as u32)
                .collect()
        };
        let blocks = WideNodes {
            nodes: Vec::new(),
            triangle_blocks: blocks(0..triangle_count),
            sphere_blocks: blocks(triangle_count..prims.len()),
        };
        let of_triangles = blocks.triangle_blocks.iter().enumerate();
        let of_spheres = blocks.sphere_blocks.iter().enumerate();
        tree.roots
            .extend(of_triangles.map(|(number, range)| Child::triangles(number, range.len())));
        tree.roots
            .extend(of_spheres.map(|(number, range)| Child::spheres(number, range.len())));
        input.fill_blocks(&mut tree, &order(&prims), blocks);
        return tree;
    }
    let vertices = |id: u32| vertices(&triangles[id as usize]).map(|p| space.point(p));
    presplit::divide(&mut prims, triangle_count, vertices);
    let binary_tree = binary::build(&mut prims, triangles.len() as u32, level);
    let (wide, root) = widen(&binary_tree, &prims);
    tree.roots.push(root);
    // The blocks are most of the tree's memory. What is not needed any more goes before.
    let order = order(&prims);
    drop((prims, binary_tree));
    input.fill_blocks(&mut tree, &order, wide);
    tree
}

/// The numbers of primitives.
fn order(prims: &[BuildPrimitive]) -> Vec<PrimId> {
    let prims = prims.par_iter().with_min_len(MIN_PARALLEL);
    prims.map(|prim| PrimId(prim.id())).collect()
}

fn vertices(triangle: &Triangle) -> [Vec3; 3] {
    [triangle.p0, triangle.p1, triangle.p2]
}

/// The primitives of the scene.
struct Input<'a> {
    triangles: &'a [Triangle],
    spheres: &'a [Sphere],
}

impl Input<'_> {
    /// The box of a primitive in world space; `None` if it is not finite or empty.
    fn bounds(&self, number: usize) -> Option<Aabb> {
        let bounds = match self.triangles.get(number) {
            Some(triangle) => triangle.bounds(),
            None => self.spheres[number - self.triangles.len()].bounds(),
        };
        let is_sound = bounds.min.is_finite() && bounds.max.is_finite() && !bounds.is_empty();
        is_sound.then_some(bounds)
    }

    /// The primitives that have a box, in the tree's space.
    fn primitives(&self, space: &TreeSpace) -> Vec<BuildPrimitive> {
        let count = self.triangles.len() + self.spheres.len();
        let numbers = (0..count).into_par_iter().with_min_len(MIN_PARALLEL);
        let mut prims: Vec<BuildPrimitive> = numbers
            .map(|number| {
                let Some(bounds) = self.bounds(number) else {
                    return BuildPrimitive::NONE;
                };
                let excess = match self.triangles.get(number) {
                    Some(triangle) => presplit::excess(&vertices(triangle).map(|p| space.point(p))),
                    None => 0.0,
                };
                BuildPrimitive::new(number as u32, space.bounds(bounds), excess)
            })
            .collect();
        if prims.iter().any(BuildPrimitive::is_none) {
            prims.retain(|prim| !prim.is_none());
        }
        prims
    }

    /// Adds nodes and blocks to a tree, the blocks in parallel.
    fn fill_blocks(&self, tree: &mut WideBvh, order: &[PrimId], wide: WideNodes) {
        let in_order = |range: &Range<u32>| &order[range.start as usize..range.end as usize];
        let (space, level) = (tree.space, tree.level);
        let blocks = wide.triangle_blocks.par_iter().with_min_len(64);
        blocks
            .map(|range| {
                let ids = in_order(range);
                dispatch!(level, _simd => (
                    TriangleBlock::of(self.triangles, ids, &space),
                    exact_block(self.triangles, ids),
                ))
            })
            .unzip_into_vecs(&mut tree.blocks, &mut tree.exact_blocks);
        let blocks = wide.sphere_blocks.iter();
        let first_sphere = self.triangles.len();
        tree.spheres = blocks
            .map(|range| SphereBlock::of(self.spheres, first_sphere, in_order(range)))
            .collect();
        tree.nodes = wide.nodes;
    }
}
// END SOLUTION(part6.task1)
