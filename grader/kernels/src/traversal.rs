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
use lanes::Scalar;

/// Returns the closest hit through the tree.
pub(crate) fn closest(
    traversal: &mut Traversal,
    bvh: &Bvh,
    triangles: &[Triangle],
    ray: &kit::Ray,
) -> ClosestHit {
    let slack = 1.0 + f64::from(traversal.slack_ulp) * f64::EPSILON;
    let Traversal {
        box_tests,
        prim_tests,
        stack,
        ..
    } = traversal;
    let entry = |node: usize, ray: &Ray<f64>| {
        *box_tests += 1;
        Some(Ize::intersect(&bvh.nodes[node].bounds.rounded(), ray)?.near)
    };
    let hit = |id: PrimId, ray: &Ray<f64>| {
        *prim_tests += 1;
        hit(&triangles[id.0 as usize], id, ray)
    };
    let kind = |node: usize| bvh.nodes[node].kind;
    walk(bvh, Ray::from_kit(ray), slack, stack, kind, entry, hit)
}

/// Returns the closest hit through the tree, in any precision. The nearer of two children is
/// visited first. `kind` returns the kind of a node, `entry` the `t` at which a ray enters its box,
/// `hit` the hit with a primitive. `stack` is empty before and after.
#[inline(always)]
pub(crate) fn walk<R: Scalar>(
    bvh: &Bvh,
    mut ray: Ray<R>,
    slack: R,
    stack: &mut Vec<(u32, R)>,
    kind: impl Fn(usize) -> NodeKind,
    mut entry: impl FnMut(usize, &Ray<R>) -> Option<R>,
    mut hit: impl FnMut(PrimId, &Ray<R>) -> Option<(R, PrimId)>,
) -> Option<(R, PrimId)> {
    let end = ray.max_t;
    let mut closest = None;
    if !bvh.nodes.is_empty()
        && let Some(t) = entry(0, &ray)
    {
        stack.push((0, t));
    }
    while let Some((node, t)) = stack.pop() {
        if t > ray.max_t {
            continue;
        }
        match kind(node as usize) {
            NodeKind::Leaf { first, count } => {
                for &id in bvh.leaf(first, count) {
                    closest = nearer(closest, hit(id, &ray));
                }
                if let Some((t, _)) = closest {
                    ray.max_t = (t * slack).smaller(end);
                }
            }
            NodeKind::Interior { left, right } => {
                let [left, right] =
                    [left, right].map(|node| Some((node, entry(node as usize, &ray)?)));
                // The nearer child is pushed last.
                let (far, near) = match (left, right) {
                    (Some(l), Some(r)) if l.1 > r.1 => (left, right),
                    _ => (right, left),
                };
                stack.extend(far.into_iter().chain(near));
            }
        }
    }
    closest
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
fn nearer<R: Scalar>(a: Option<(R, PrimId)>, b: Option<(R, PrimId)>) -> Option<(R, PrimId)> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b < a { b } else { a }),
        (a, b) => a.or(b),
    }
}
