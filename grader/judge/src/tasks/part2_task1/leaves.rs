//! Judges the leaves of a tree: how many primitives each holds.

use super::judge::aabb;
use super::structure::Walk;
use crate::plural;
use crate::tools::findings::{Aspect, Class, Findings};
use kit::{Aabb, Vec3};
use wire::work::{NodeKind, Tree, Xyz};

/// Judges that no leaf is empty, and that none holds more than `max_leaf_size` primitives.
pub(super) fn judge(
    findings: &mut Findings,
    tree: &Tree,
    walk: &Walk,
    bounds: &[[Xyz; 2]],
    max_leaf_size: u32,
) {
    // 0 counts as 1.
    let max_leaf_size = max_leaf_size.max(1);
    if tree.nodes.is_empty() {
        findings.judge(Aspect::LeafSize, 0, true, 0.0, String::new);
    }
    for (at, node) in walk.nodes(tree) {
        let NodeKind::Leaf { first, count } = node.kind else {
            continue;
        };
        let is_empty = count == 0;
        let class = match count {
            _ if is_empty => Some(Class::Named("empty")),
            _ if count == max_leaf_size + 1 => Some(Class::Named("one too many")),
            _ if count > max_leaf_size => Some(Class::Named("too many")),
            _ => None,
        };
        let badness = f64::from(count);
        findings.judge_class(Aspect::LeafSize, 0, class, badness, || {
            if is_empty && bounds.is_empty() {
                return format!(
                    "leaf {at} is empty: expected a tree without nodes, since there are no primitives"
                );
            }
            if is_empty {
                return format!("leaf {at} is empty: expected at least one primitive");
            }
            let held = &tree.order[first as usize..first as usize + count as usize];
            let held: Vec<Aabb> = held.iter().map(|&id| aabb(&bounds[id as usize])).collect();
            let why = if is_separated(&held) {
                "The middle of its box separates its primitives, so it can be split: is the number of primitives in each node compared with max_leaf_size, before the node becomes a leaf?"
            } else {
                "The middle of its box separates none of its primitives: if one side of a split is empty, split in another way, for example into two halves of equal size."
            };
            format!(
                "leaf {at} holds {}; expected: at most {max_leaf_size}, which is max_leaf_size. {why}",
                plural(count, "primitive", "primitives")
            )
        });
    }
}

/// Whether there are centroids on both sides of the middle of the box around all `boxes`, along its
/// longest axis.
fn is_separated(boxes: &[Aabb]) -> bool {
    let valid = || boxes.iter().filter(|b| !b.is_empty());
    let around = valid().copied().fold(Aabb::EMPTY, Aabb::union);
    let half: Vec3 = 0.5 * around.max - 0.5 * around.min;
    let axis = half.max_position();
    let middle = around.centroid()[axis];
    let left = valid().filter(|b| b.centroid()[axis] < middle).count();
    0 < left && left < boxes.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tasks::part2_task1::structure::walk;
    use wire::work::Node;

    /// The message about a tree that is one leaf over these intervals along x.
    fn message(intervals: &[[f64; 2]], max_leaf_size: u32) -> Option<String> {
        let bounds = intervals
            .iter()
            .map(|[min, max]| [[*min, 0.0, 0.0], [*max, 0.1, 0.1]]);
        let bounds: Vec<[Xyz; 2]> = bounds.collect();
        let count = bounds.len() as u32;
        let leaf = Node {
            bounds: [[-9.0; 3], [9.0; 3]],
            kind: NodeKind::Leaf { first: 0, count },
        };
        let tree = Tree {
            nodes: vec![leaf],
            order: (0..count).collect(),
        };
        let mut findings = Findings::default();
        let walk = walk(&tree, intervals.len()).ok().expect("it is a tree");
        judge(&mut findings, &tree, &walk, &bounds, max_leaf_size);
        let list = findings.into_vec();
        let worst = list[0].worst.as_ref();
        worst.map(|worst| worst.message.to_string())
    }

    #[test]
    fn a_leaf_is_empty_in_no_tree() {
        assert!(message(&[], 4).is_some_and(|text| text.contains("without nodes")));
    }

    #[test]
    fn only_a_leaf_that_no_split_separates_asks_for_another_split() {
        let asks = "if one side of a split is empty";
        let apart = [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0], [6.0, 7.0]];
        assert!(message(&apart, 2).is_some_and(|text| !text.contains(asks)));
        assert!(message(&[[0.0, 1.0]; 4], 2).is_some_and(|text| text.contains(asks)));
        let beside_a_huge_one = [[0.0, 1.0], [1.0, 2.0], [2.0, 3.0], [-1.0, 90.0]];
        // The centroid of the huge box lies at 44.5, which is the middle of all.
        assert!(message(&beside_a_huge_one[1..], 2).is_some_and(|text| !text.contains(asks)));
        assert!(message(&beside_a_huge_one[..3], 2).is_some_and(|text| !text.contains(asks)));
        assert_eq!(message(&apart, 4), None);
    }
}
