// BEGIN SOLUTION(part6.task1)
//! Collapses a binary tree to a wide one: decides which of its nodes become children of the same
//! wide node.

use crate::sah::LANES;
use kit::{Bvh, BvhNode, NodeKind};

/// The wide tree of least cost over a binary tree.
///
/// Every ray that hits the box of a wide node tests its children, so the cost of a tree is the sum
/// of the surface areas of its wide nodes. Dynamic programming from the leaves upwards minimises
/// it: `C(i)` is the cost of the subtree of a node as at most `i` children of a wide node above.
/// Either it is one child, a wide node itself, or its two children share the `i` lanes in the best
/// way (Ylitie, Karras, Laine, "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", 2017).
pub(crate) struct Collapse {
    /// By node and number of lanes: how many of them the left child gets; 0 if the node is one
    /// child.
    shares: Vec<[u8; LANES]>,
    /// By node: how many of its eight lanes the left child gets if it is a wide node itself.
    own: Vec<u8>,
}

impl Collapse {
    /// Computes the tree of least cost. Children have to come after their parents in `binary`. A
    /// leaf for which `is_mixed` is true needs two lanes or a wide node of its own.
    pub(crate) fn cheapest(binary: &Bvh, is_mixed: impl Fn(&BvhNode) -> bool) -> Collapse {
        let count = binary.nodes.len();
        let mut costs = vec![[0.0_f64; LANES]; count];
        let mut collapse = Collapse {
            shares: vec![[0; LANES]; count],
            own: vec![0; count],
        };
        for (number, node) in binary.nodes.iter().enumerate().rev() {
            let area = node.bounds.surface_area();
            let NodeKind::Interior { left, right } = node.kind else {
                if is_mixed(node) {
                    costs[number][0] = area;
                }
                continue;
            };
            let (below, above) = (costs[left as usize], costs[right as usize]);
            // The best way to share `i >= 2` lanes: its cost and the number of lanes of the left
            // child.
            let share = |i: usize| {
                let ways = (1..i).map(|k| (below[k - 1] + above[i - k - 1], k as u8));
                ways.min_by(|a, b| a.0.total_cmp(&b.0))
                    .expect("two lanes can be shared")
            };
            let (cost, own) = share(LANES);
            collapse.own[number] = own;
            costs[number][0] = cost + area;
            for i in 2..=LANES {
                let (cost, k) = share(i);
                let fewer = costs[number][i - 2];
                (costs[number][i - 1], collapse.shares[number][i - 1]) =
                    if cost < fewer { (cost, k) } else { (fewer, 0) };
            }
        }
        collapse
    }

    /// The children of the wide node that `node` becomes, from left to right.
    pub(crate) fn children(&self, binary: &Bvh, node: u32) -> Vec<u32> {
        let mut children = Vec::with_capacity(LANES);
        self.add_both(binary, node, self.own[node as usize], LANES, &mut children);
        children
    }

    /// Adds what is below both children of `node`: the left one gets `share` of the `lanes`.
    fn add_both(&self, binary: &Bvh, node: u32, share: u8, lanes: usize, children: &mut Vec<u32>) {
        let share = usize::from(share);
        match binary.nodes[node as usize].kind {
            NodeKind::Interior { left, right } if share > 0 => {
                self.add(binary, left, share, children);
                self.add(binary, right, lanes - share, children);
            }
            _ => children.push(node),
        }
    }

    /// Adds what is below `node` as at most `lanes` children; at equal cost as few as possible.
    fn add(&self, binary: &Bvh, node: u32, mut lanes: usize, children: &mut Vec<u32>) {
        let shares = self.shares[node as usize];
        while lanes > 1 && shares[lanes - 1] == 0 {
            lanes -= 1;
        }
        self.add_both(binary, node, shares[lanes - 1], lanes, children);
    }
}
// END SOLUTION(part6.task1)
