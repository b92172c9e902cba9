//! Builds the wide tree: from triangles and spheres to nodes and blocks.

use crate::build::binary;
use crate::build::large;
use crate::build::presplit;
use crate::build::sah::BuildPrimitive;
use crate::build::widen::{WideNodes, widen};
use crate::layout::LANES;
use crate::layout::space::TreeSpace;
use crate::layout::sphere_block::SphereBlock;
use crate::layout::triangle_block::TriangleBlock;
use crate::layout::vertex_list::{BlockVertices, ExactVertex, VertexList};
use crate::wide::WideBvh;
use fearless_simd::Level;
use kit::{Aabb, PrimId, Sphere, Triangle, Vec3};
use lanes::dispatch;
use rayon::prelude::*;
use std::ops::Range;

/// Up to this many triangles need no nodes: testing a node costs about as much as testing a block.
const MAX_TRIANGLES_WITHOUT_NODES: usize = 2 * LANES;

/// A thread prepares at least this many primitives at once.
const MIN_PARALLEL: usize = 1 << 11;

/// Builds the tree, if `with_apart` with large primitives apart. A primitive without a finite box
/// that is not empty is omitted.
pub(crate) fn build(triangles: &[Triangle], spheres: &[Sphere], with_apart: bool) -> WideBvh {
    let input = Input { triangles, spheres };
    let count = triangles.len() + spheres.len();
    let space = TreeSpace::around(count, |number| input.bounds(number));
    let level = Level::new();
    let mut tree = WideBvh {
        roots: Vec::new(),
        inner_roots: 0,
        apart: Vec::new(),
        nodes: Vec::new(),
        blocks: Vec::new(),
        block_vertices: Vec::new(),
        vertices: Vec::new(),
        spheres: Vec::new(),
        space,
        level,
    };
    let mut prims = input.primitives(&space);
    let mut apart = Vec::new();
    if with_apart {
        let numbers = (0..count).into_par_iter();
        let boxes = numbers.map(|number| (PrimId(number as u32), input.bounds(number)));
        tree.apart = large::choose(boxes);
        let is_apart = |prim: &mut BuildPrimitive| tree.apart.contains(&PrimId(prim.id()));
        apart = prims.extract_if(.., is_apart).collect();
    }
    let apart_triangles = input.triangle_count(&apart);
    let triangle_count = input.triangle_count(&prims);
    let is_small =
        triangle_count <= MAX_TRIANGLES_WITHOUT_NODES && prims.len() - triangle_count <= LANES;
    let (mut wide, mut order);
    if is_small {
        wide = WideNodes::default();
        tree.roots = wide.add_blocks(0..triangle_count, triangle_count..prims.len());
        order = numbers(&prims);
    } else {
        let vertices = |id: u32| vertices(&triangles[id as usize]).map(|p| space.point(p));
        presplit::divide(&mut prims, triangle_count, vertices);
        let binary_tree = binary::build(&mut prims, triangles.len() as u32, level);
        let root;
        (wide, root) = widen(&binary_tree, &prims);
        tree.roots.push(root);
        // The blocks are most of the tree's memory. What is not needed any more goes before.
        order = numbers(&prims);
        drop((prims, binary_tree));
    }
    tree.inner_roots = tree.roots.len();
    let first_triangle = order.len();
    let first_sphere = first_triangle + apart_triangles;
    order.extend(apart.iter().map(|prim| PrimId(prim.id())));
    let blocks = wide.add_blocks(first_triangle..first_sphere, first_sphere..order.len());
    tree.roots.extend(blocks);
    input.fill_blocks(&mut tree, &order, wide);
    tree
}

/// The numbers of primitives.
fn numbers(prims: &[BuildPrimitive]) -> Vec<PrimId> {
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
    /// The box of a primitive in world space; `None` if it is empty or a coordinate is not finite.
    #[inline(always)]
    fn bounds(&self, number: usize) -> Option<Aabb> {
        let (bounds, is_finite) = match self.triangles.get(number) {
            Some(triangle) => (
                triangle.bounds(),
                vertices(triangle).iter().all(|p| p.is_finite()),
            ),
            None => {
                let bounds = self.spheres[number - self.triangles.len()].bounds();
                (bounds, bounds.min.is_finite() && bounds.max.is_finite())
            }
        };
        (is_finite && !bounds.is_empty()).then_some(bounds)
    }

    /// How many of `prims`, which are in ascending order, are triangles.
    fn triangle_count(&self, prims: &[BuildPrimitive]) -> usize {
        prims.partition_point(|prim| (prim.id() as usize) < self.triangles.len())
    }

    /// A primitive in the tree's space; [`BuildPrimitive::NONE`] if it has no box.
    #[inline(always)]
    fn primitive(&self, number: usize, space: &TreeSpace) -> BuildPrimitive {
        if let Some(triangle) = self.triangles.get(number) {
            // Finite coordinates are finite in the tree's space, too, and only they.
            let vertices = vertices(triangle).map(|p| space.point(p));
            if vertices.iter().all(|p| p.is_finite()) {
                return presplit::whole_triangle(number as u32, &vertices);
            }
        } else if let Some(bounds) = self.bounds(number) {
            return BuildPrimitive::new(number as u32, space.bounds(bounds), 0.0);
        }
        BuildPrimitive::NONE
    }

    /// The primitives that have a box, in ascending order.
    fn primitives(&self, space: &TreeSpace) -> Vec<BuildPrimitive> {
        let count = self.triangles.len() + self.spheres.len();
        let numbers = (0..count).into_par_iter().with_min_len(MIN_PARALLEL);
        let mut prims: Vec<BuildPrimitive> = numbers
            .map(|number| self.primitive(number, space))
            .collect();
        if prims.par_iter().any(BuildPrimitive::is_none) {
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
                dispatch!(level, _simd => TriangleBlock::of(self.triangles, ids, &space))
            })
            .collect_into_vec(&mut tree.blocks);
        let chunks = wide.triangle_blocks.par_chunks(CHUNK);
        let chunks: Vec<(Vec<BlockVertices>, Vec<ExactVertex>)> = chunks
            .map(|ranges| {
                let mut list = VertexList::new(LIKELY_VERTICES * ranges.len());
                let blocks = ranges.iter();
                let blocks = blocks.map(|range| list.add(self.triangles, in_order(range)));
                (blocks.collect(), list.vertices)
            })
            .collect();
        join(chunks, tree);
        let blocks = wide.sphere_blocks.iter();
        let first_sphere = self.triangles.len();
        tree.spheres = blocks
            .map(|range| SphereBlock::of(self.spheres, first_sphere, in_order(range)))
            .collect();
        tree.nodes = wide.nodes;
    }
}

/// A thread lists the vertices of this many blocks at once.
const CHUNK: usize = 256;

/// Few meshes have more vertices a block.
const LIKELY_VERTICES: usize = 8;

/// Adds the vertices of chunks of blocks to a tree.
fn join(chunks: Vec<(Vec<BlockVertices>, Vec<ExactVertex>)>, tree: &mut WideBvh) {
    tree.block_vertices.reserve_exact(tree.blocks.len());
    let count = chunks.iter().map(|(_, vertices)| vertices.len()).sum();
    tree.vertices.reserve_exact(count);
    for (blocks, vertices) in chunks {
        let before = tree.vertices.len() as u32;
        let blocks = blocks.into_iter().map(|block| block.moved(before));
        tree.block_vertices.extend(blocks);
        tree.vertices.extend(vertices);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meshes::{MeshKind, generate};

    /// Knots and needles are divided, and their parts share the exact vertices.
    #[test]
    fn trees_take_few_bytes_a_triangle() {
        for (kind, limit) in [
            (MeshKind::Terrain, 53),
            (MeshKind::Knot, 95),
            (MeshKind::Needles, 88),
        ] {
            let triangles = generate(kind, 40_000);
            let bytes = build(&triangles, &[], false).byte_count() / triangles.len();
            assert!(bytes <= limit, "{kind:?}: {bytes} bytes a triangle");
        }
    }

    /// Long triangles that are divided, and spheres among them: enough for every parallel step.
    #[test]
    fn the_tree_does_not_depend_on_the_number_of_threads() {
        let triangles = generate(MeshKind::Needles, 40_000);
        let spheres: Vec<Sphere> = (0..500)
            .map(|i| Sphere {
                center: triangles[79 * i].p0,
                radius: 0.01,
            })
            .collect();
        let with_threads = |count| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
            let pool = pool.expect("a pool of threads");
            let tree = pool.install(|| build(&triangles, &spheres, false));
            assert!(tree.nodes.len() > 1000 && tree.spheres.len() > 10);
            let triangles = (&tree.blocks, &tree.block_vertices, &tree.vertices);
            format!("{:?} {triangles:?} {:?}", tree.nodes, tree.spheres)
        };
        let one = with_threads(1);
        assert!(one == with_threads(2), "two threads build another tree");
        assert!(one == with_threads(5), "five threads build another tree");
    }
}
