//! One step of the ladder: a way to find hits, built over one mesh.

use bvh::{construct_bvh, intersect_bvh, occludes_bvh};
use kit::{Aabb, Bvh, BvhNode, Hit, Interval, PrimId, Ray, Triangle, World};
use serde::Serialize;
use simd_bvh::{TestCounts, WideBvh};
use std::mem::size_of;

/// The largest number of primitives in a leaf of a binary tree: the assignment's choice.
const MAX_LEAF_SIZE: usize = 4;

/// The steps, from the slowest to the fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum RungKind {
    /// Every ray tests every triangle.
    BruteForce,
    /// The tree of stage `bvh`.
    Student,
    /// A tree that the surface area heuristic splits, traversed by stage `bvh`.
    Sah,
    /// The tree of stage `simd_bvh`.
    Wide,
}

impl RungKind {
    /// All steps.
    pub const ALL: [RungKind; 4] = [
        RungKind::BruteForce,
        RungKind::Student,
        RungKind::Sah,
        RungKind::Wide,
    ];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            RungKind::BruteForce => "brute force",
            RungKind::Student => "bvh *",
            RungKind::Sah => "bvh, SAH",
            RungKind::Wide => "simd_bvh *",
        }
    }
}

/// A way to find hits in `triangles`.
pub struct Rung<'a> {
    triangles: &'a [Triangle],
    tree: Tree,
}

enum Tree {
    None,
    Binary(Bvh),
    Wide(WideBvh),
}

impl<'a> Rung<'a> {
    /// Builds the tree of `kind`. `None` if this checkout does not contain its builder, because it
    /// would be a solution.
    pub fn build(kind: RungKind, triangles: &'a [Triangle]) -> Option<Rung<'a>> {
        let bounds = || -> Vec<Aabb> { triangles.iter().map(Triangle::bounds).collect() };
        let tree = match kind {
            RungKind::BruteForce => Tree::None,
            RungKind::Student => Tree::Binary(construct_bvh(&bounds(), MAX_LEAF_SIZE)),
            RungKind::Sah => {
                let builders = kernels::builders();
                let sah = builders
                    .iter()
                    .find(|builder| builder.name.starts_with("SAH"))?;
                Tree::Binary((sah.build)(&bounds(), MAX_LEAF_SIZE))
            }
            RungKind::Wide => Tree::Wide(WideBvh::build(triangles, &[])),
        };
        Some(Rung { triangles, tree })
    }

    /// The memory of the tree in bytes, without the triangles of the scene.
    pub fn bytes(&self) -> usize {
        match &self.tree {
            Tree::None => 0,
            Tree::Binary(tree) => {
                tree.nodes.len() * size_of::<BvhNode>() + tree.order.len() * size_of::<PrimId>()
            }
            Tree::Wide(tree) => tree.byte_count(),
        }
    }

    /// The `t` and the primitive of the closest hit. Adds to `counts`.
    pub fn closest(&self, ray: &Ray, counts: &mut TestCounts) -> Option<(f64, PrimId)> {
        let triangles = self.triangles;
        let exact =
            &mut |id: PrimId, ray: &Ray| intersect::test_triangle(&triangles[id.0 as usize], ray);
        match &self.tree {
            Tree::None => {
                counts.prim_tests += triangles.len() as u64;
                let hits = (0..)
                    .map(PrimId)
                    .zip(triangles)
                    .filter_map(|(id, triangle)| {
                        Some((intersect::test_triangle(triangle, ray)?.t, id))
                    });
                hits.reduce(|a, b| if b.0 < a.0 { b } else { a })
            }
            Tree::Binary(tree) => {
                let mut world = Mesh { triangles, counts };
                let hit = intersect_bvh(tree, &mut { *ray }, &mut world)?;
                Some((hit.t, hit.prim))
            }
            Tree::Wide(tree) => {
                let (id, hit) = tree.closest(ray, None, exact, counts)?;
                Some((hit.t, id))
            }
        }
    }

    /// Whether there is any hit. Adds to `counts`.
    pub fn occluded(&self, ray: &Ray, counts: &mut TestCounts) -> bool {
        let triangles = self.triangles;
        let exact =
            &mut |id: PrimId, ray: &Ray| intersect::test_triangle(&triangles[id.0 as usize], ray);
        match &self.tree {
            Tree::None => {
                let mut tests = 0;
                let is_hit = triangles.iter().any(|triangle| {
                    tests += 1;
                    intersect::test_triangle(triangle, ray).is_some()
                });
                counts.prim_tests += tests;
                is_hit
            }
            Tree::Binary(tree) => occludes_bvh(tree, ray, &mut Mesh { triangles, counts }),
            Tree::Wide(tree) => tree.occluded(ray, None, exact, counts),
        }
    }
}

/// The triangles that a binary tree is traversed with, and the number of tests.
struct Mesh<'a> {
    triangles: &'a [Triangle],
    counts: &'a mut TestCounts,
}

impl World for Mesh<'_> {
    #[inline(always)]
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        self.counts.box_tests += 1;
        bbox::intersect_bbox(b, ray)
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        self.counts.prim_tests += 1;
        intersect::intersect_triangle(&self.triangles[id.0 as usize], id, ray)
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        self.counts.prim_tests += 1;
        intersect::test_triangle(&self.triangles[id.0 as usize], ray).is_some()
    }
}
