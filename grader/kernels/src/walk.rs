// BEGIN SOLUTION(part2.task3)
//! Walking a tree for the closest hit, with a choice of how much slack the pruning has.
//!
//! A box and a primitive in it round `t` in different ways: the primitive may come out a little nearer than its own box.
//! A walk that skips every box behind the closest hit so far then skips a closer one. T. Ize, "Robust BVH Ray Traversal",
//! Journal of Computer Graphics Techniques 2(2), 2013.

use crate::bbox::BoxTest;
use crate::bbox::ize::Ize;
use crate::shapes::{Ray, Shape};
use crate::tree::{Closest, Walker};
use crate::triangle::TriangleTest;
use crate::triangle::woop::Woop;
use kit::{Bvh, NodeKind, PrimId, Triangle};

/// The closest hit through the tree: the nearer of two boxes first.
pub(crate) fn closest(
    walker: &mut Walker,
    bvh: &Bvh,
    triangles: &[Triangle],
    ray: &kit::Ray,
) -> Closest {
    let mut probe: Ray<f64> = Ray::of(ray);
    let slack = 1.0 + f64::from(walker.slack_ulp) * f64::EPSILON;
    let mut closest: Closest = None;
    if !bvh.nodes.is_empty()
        && let Some(entry) = entered_at(walker, bvh, 0, &probe)
    {
        walker.later.push((0, entry));
    }
    while let Some((node, entry)) = walker.later.pop() {
        if entry > probe.max_t {
            continue;
        }
        match bvh.nodes[node as usize].kind {
            NodeKind::Leaf { first, count } => {
                for id in bvh.leaf(first, count) {
                    walker.prim_tests += 1;
                    closest = nearer(closest, hit(&triangles[id.0 as usize], *id, &probe));
                }
                if let Some((t, _)) = closest {
                    probe.max_t = (t * slack).min(ray.max_t);
                }
            }
            NodeKind::Interior { left, right } => {
                let [left, right] =
                    [left, right].map(|node| Some((node, entered_at(walker, bvh, node, &probe)?)));
                // The nearer one is put on top.
                let (far, near) = match (left, right) {
                    (Some(l), Some(r)) if l.1 > r.1 => (left, right),
                    _ => (right, left),
                };
                walker.later.extend(far.into_iter().chain(near));
            }
        }
    }
    closest
}

/// Where the ray enters the box of a node.
#[inline(always)]
fn entered_at(walker: &mut Walker, bvh: &Bvh, node: u32, ray: &Ray<f64>) -> Option<f64> {
    walker.box_tests += 1;
    let bounds = bvh.nodes[node as usize].bounds.rounded();
    Some(Ize::meet(&bounds, ray)?.near)
}

/// The closest hit by asking every triangle: what a walk should find.
pub(crate) fn brute_force(triangles: &[Triangle], ray: &kit::Ray) -> Closest {
    let ray: Ray<f64> = Ray::of(ray);
    let numbered = (0..).map(PrimId).zip(triangles);
    numbered.fold(None, |closest, (id, tri)| {
        nearer(closest, hit(tri, id, &ray))
    })
}

#[inline(always)]
fn hit(tri: &Triangle, id: PrimId, ray: &Ray<f64>) -> Closest {
    Some((Woop::meet(&tri.rounded(), ray)?.t, id))
}

#[inline(always)]
fn nearer(a: Closest, b: Closest) -> Closest {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b < a { b } else { a }),
        (a, b) => a.or(b),
    }
}
// END SOLUTION(part2.task3)
