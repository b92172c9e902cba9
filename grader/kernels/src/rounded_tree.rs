//! Trees that store boxes and triangles in one precision and are traversed in it, with one pair of
//! tests.

use crate::bbox::BoxTest;
use crate::bbox::ize::Ize;
use crate::bbox::kay_kajiya::KayKajiya;
use crate::bbox::williams::Williams;
use crate::shapes::{Aabb, Ray, Shape, Triangle};
use crate::traversal::walk;
use crate::tree::RoundedTree;
use crate::triangle::TriangleTest;
use crate::triangle::moller_trumbore::MollerTrumbore;
use crate::triangle::plucker::Plucker;
use crate::triangle::woop::Woop;
use kit::{Bvh, BvhNode, NodeKind};
use lanes::Scalar;

/// Returns the same tree with different tests, the exact one first. In f32, pbrt-v4 uses a pair
/// like Ize's and Woop's tests, Embree's robust mode one like Ize's and Plücker coordinates, and
/// most others use slabs with Möller and Trumbore's test. Naive slabs lose a box to 0/0
/// where a ray lies in the plane of a face.
pub(crate) fn trees<'a>(bvh: &'a Bvh, triangles: &[kit::Triangle]) -> Vec<RoundedTree<'a>> {
    vec![
        tree::<f64, Ize, Woop>(16, bvh, triangles),
        tree::<f64, Ize, MollerTrumbore>(16, bvh, triangles),
        tree::<f64, Williams, MollerTrumbore>(0, bvh, triangles),
        tree::<f32, Ize, Woop>(16, bvh, triangles),
        tree::<f32, Ize, Plucker>(16, bvh, triangles),
        tree::<f32, Williams, Woop>(0, bvh, triangles),
        tree::<f32, Williams, MollerTrumbore>(0, bvh, triangles),
        tree::<f64, KayKajiya, Woop>(16, bvh, triangles),
    ]
}

/// A node as small as its precision allows: fewer bytes are fetched for single precision.
struct Node<R> {
    bounds: Aabb<R>,
    kind: NodeKind,
}

fn tree<'a, R: Scalar, B: BoxTest, T: TriangleTest>(
    slack_ulp: u32,
    bvh: &'a Bvh,
    triangles: &[kit::Triangle],
) -> RoundedTree<'a> {
    let node = |node: &BvhNode| Node::<R> {
        bounds: node.bounds.rounded(),
        kind: node.kind,
    };
    let nodes: Vec<Node<R>> = bvh.nodes.iter().map(node).collect();
    let triangles: Vec<Triangle<R>> = triangles.iter().map(Shape::rounded).collect();
    let slack = R::from_f64(1.0 + f64::from(slack_ulp) * R::PRECISION.epsilon());
    let mut stack = Vec::new();
    RoundedTree {
        box_test: B::INFO.name,
        triangle_test: T::INFO.name,
        precision: R::PRECISION,
        slack_ulp,
        closest: Box::new(move |ray| {
            let entry =
                |node: usize, ray: &Ray<R>| Some(B::intersect(&nodes[node].bounds, ray)?.near);
            let hit = |id: kit::PrimId, ray: &Ray<R>| {
                Some((T::intersect(&triangles[id.0 as usize], ray)?.t, id))
            };
            let kind = |node: usize| nodes[node].kind;
            let (t, id) = walk(bvh, Ray::from_kit(ray), slack, &mut stack, kind, entry, hit)?;
            Some((t.to_f64(), id))
        }),
    }
}
