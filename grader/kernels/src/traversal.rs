// BEGIN SOLUTION(part2.task3)
//! Closest-hit traversal of a tree, with a choice of pruning slack.
//!
//! A box test and a primitive test round `t` differently: the `t` of a primitive may be slightly
//! smaller than the entry into its own box. A traversal that skips every box behind the closest hit
//! so far may then skip a closer hit. T. Ize, "Robust BVH Ray Traversal", Journal of Computer
//! Graphics Techniques 2(2), 2013.

use crate::bbox::BoxTest;
use crate::bbox::ize::Ize;
use crate::shapes::{Ray, Shape};
use crate::tree::{ClosestHit, Traversal};
use crate::triangle::TriangleTest;
use crate::triangle::woop::Woop;
use kit::{Bvh, NodeKind, PrimId, Triangle};

/// Returns the closest hit through the tree. The nearer of two children is visited first.
pub(crate) fn closest(
    traversal: &mut Traversal,
    bvh: &Bvh,
    triangles: &[Triangle],
    ray: &kit::Ray,
) -> ClosestHit {
    let mut shortened_ray: Ray<f64> = Ray::from_kit(ray);
    let slack = 1.0 + f64::from(traversal.slack_ulp) * f64::EPSILON;
    let mut closest: ClosestHit = None;
    if !bvh.nodes.is_empty()
        && let Some(entry) = entry_t(traversal, bvh, 0, &shortened_ray)
    {
        traversal.stack.push((0, entry));
    }
    while let Some((node, entry)) = traversal.stack.pop() {
        if entry > shortened_ray.max_t {
            continue;
        }
        match bvh.nodes[node as usize].kind {
            NodeKind::Leaf { first, count } => {
                for id in bvh.leaf(first, count) {
                    traversal.prim_tests += 1;
                    closest = nearer(closest, hit(&triangles[id.0 as usize], *id, &shortened_ray));
                }
                if let Some((t, _)) = closest {
                    shortened_ray.max_t = (t * slack).min(ray.max_t);
                }
            }
            NodeKind::Interior { left, right } => {
                let [left, right] = [left, right]
                    .map(|node| Some((node, entry_t(traversal, bvh, node, &shortened_ray)?)));
                // The nearer child is pushed last.
                let (far, near) = match (left, right) {
                    (Some(l), Some(r)) if l.1 > r.1 => (left, right),
                    _ => (right, left),
                };
                traversal.stack.extend(far.into_iter().chain(near));
            }
        }
    }
    closest
}

/// Tests the box of a node; returns the `t` at which the ray enters it.
#[inline(always)]
fn entry_t(traversal: &mut Traversal, bvh: &Bvh, node: u32, ray: &Ray<f64>) -> Option<f64> {
    traversal.box_tests += 1;
    let bounds = bvh.nodes[node as usize].bounds.rounded();
    Some(Ize::intersect(&bounds, ray)?.near)
}

/// Returns the closest hit by testing every triangle.
pub(crate) fn brute_force(triangles: &[Triangle], ray: &kit::Ray) -> ClosestHit {
    let ray: Ray<f64> = Ray::from_kit(ray);
    let numbered = (0..).map(PrimId).zip(triangles);
    numbered.fold(None, |closest, (id, tri)| {
        nearer(closest, hit(tri, id, &ray))
    })
}

#[inline(always)]
fn hit(tri: &Triangle, id: PrimId, ray: &Ray<f64>) -> ClosestHit {
    Some((Woop::intersect(&tri.rounded(), ray)?.t, id))
}

#[inline(always)]
fn nearer(a: ClosestHit, b: ClosestHit) -> ClosestHit {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b < a { b } else { a }),
        (a, b) => a.or(b),
    }
}
// END SOLUTION(part2.task3)
