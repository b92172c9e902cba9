//! Traversal by a ray that single precision cannot handle: one box after the other in double
//! precision, and every primitive with the scalar kernel.

use crate::intersect::{ExactTest, TestCounts};
use crate::kernels::box_test::ScalarBoxTest;
use crate::kernels::found::Found;
use crate::layout::node::{Child, ChildKind};
use crate::wide::WideBvh;
use kit::{PrimId, Ray, TriangleHit};

/// The closest hit, or with `any` the first that is found.
#[cold]
#[inline(never)]
pub(crate) fn closest(
    tree: &WideBvh,
    ray: &Ray,
    skip: Option<PrimId>,
    any: bool,
    exact: &mut ExactTest,
    counts: &mut TestCounts,
) -> Option<(PrimId, TriangleHit)> {
    let mut boxes = ScalarBoxTest::new(ray, &tree.space);
    let mut found = Found::default();
    let mut pending: Vec<(f64, Child)> = Vec::new();
    pending.extend(tree.roots.iter().map(|&root| (f64::NEG_INFINITY, root)));
    while let Some((entry, child)) = pending.pop() {
        if !boxes.is_within(entry) {
            continue;
        }
        let (index, count) = match child.kind() {
            ChildKind::Node { index, count } => {
                let node = &tree.nodes[index];
                counts.box_tests += u64::from(count);
                let first = pending.len();
                for lane in 0..count as usize {
                    if let Some(entry) = boxes.entry(node.bounds(lane)) {
                        pending.push((entry, Child(node.children[lane])));
                    }
                }
                // The nearest last: it is visited next.
                pending[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
                continue;
            }
            ChildKind::Triangles { index, count } | ChildKind::Spheres { index, count } => {
                (index, count as usize)
            }
        };
        counts.prim_tests += count as u64;
        for lane in 0..count {
            let id = match child.kind() {
                ChildKind::Spheres { .. } => tree.spheres[index].id(lane),
                _ => tree.blocks[index].id(lane),
            };
            if skip == Some(id) {
                continue;
            }
            if let Some(t) = found.test(id, ray, exact) {
                if any {
                    return found.closest;
                }
                boxes.shorten(t);
            }
        }
    }
    found.closest
}
