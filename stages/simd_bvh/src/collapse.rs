// BEGIN SOLUTION(part6.task1)
//! From a binary tree to a wide one: which of its nodes become children of the same wide node.

use crate::sah::LANES;
use kit::{Bvh, BvhNode, NodeKind};

/// The cheapest wide tree over a binary one.
///
/// A wide node is tested by every ray that meets its box; so the cheapest tree is the one whose wide nodes have the least
/// surface in all. It is found from the leaves upwards: what is below a node, as at most `i` children of a wide node
/// further up, costs `C(i)`. Either it is one child, a wide node itself, or its two halves share the `i` places in the
/// best way (Ylitie, Karras, Laine, "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017).
pub(crate) struct Collapse {
    /// By node and number of places: how many of them the left half takes; 0 if all of it is one child.
    shares: Vec<[u8; LANES]>,
    /// By node: how many of its eight places the left half takes where it is a wide node itself.
    own: Vec<u8>,
}

impl Collapse {
    /// Children come after their parents in `binary`. A leaf of which `is_mixed` is true takes two places or a wide node
    /// of its own.
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
            // The best way to share `i` places, from two up: its cost, and the share of the left half.
            let share = |i: usize| {
                let ways = (1..i).map(|k| (below[k - 1] + above[i - k - 1], k as u8));
                ways.min_by(|a, b| a.0.total_cmp(&b.0))
                    .expect("two places can be shared")
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
        self.halves(binary, node, self.own[node as usize], LANES, &mut children);
        children
    }

    /// Adds both halves of `node`: the left one takes up to `share` of the `places`.
    fn halves(&self, binary: &Bvh, node: u32, share: u8, places: usize, children: &mut Vec<u32>) {
        let share = usize::from(share);
        match binary.nodes[node as usize].kind {
            NodeKind::Interior { left, right } if share > 0 => {
                self.add(binary, left, share, children);
                self.add(binary, right, places - share, children);
            }
            _ => children.push(node),
        }
    }

    /// Adds what is below `node` as at most so many children. With as many as cost the same, the fewest.
    fn add(&self, binary: &Bvh, node: u32, mut places: usize, children: &mut Vec<u32>) {
        let shares = self.shares[node as usize];
        while places > 1 && shares[places - 1] == 0 {
            places -= 1;
        }
        self.halves(binary, node, shares[places - 1], places, children);
    }
}
// END SOLUTION(part6.task1)
