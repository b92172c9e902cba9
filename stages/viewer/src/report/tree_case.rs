//! A tree that the stage built, against the boxes that it has to have.

use driver::bvh::kit_tree;
use judge::exact_boxes;
use kit::{Aabb, Bvh, NodeKind};
use wire::answer::BuildAnswer;
use wire::work::BuildWork;

/// The stage's tree over the boxes of a case.
#[derive(Clone, Debug)]
pub struct TreeCase {
    /// The tree. Children that do not exist are left out, and so are places beyond the order.
    pub tree: Bvh,
    /// The boxes of the primitives.
    pub primitives: Vec<Aabb>,
    /// For each node the smallest box around the primitives below it; empty if the nodes do not form a
    /// tree.
    pub exact: Vec<Aabb>,
    /// Why the nodes do not form a tree over the primitives.
    pub fault: Option<String>,
    /// The nodes that are wrong, and why, in the order of the tree.
    pub wrong: Vec<WrongNode>,
}

/// A wrong node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrongNode {
    /// Its index.
    pub node: u32,
    /// What is wrong, as a sentence.
    pub sentence: String,
}

impl TreeCase {
    /// Compares the stage's tree with what is right.
    pub fn of(work: &BuildWork, answer: &BuildAnswer) -> TreeCase {
        let built = kit_tree(&answer.tree);
        let primitives = work.bounds.iter().map(|[min, max]| Aabb {
            min: (*min).into(),
            max: (*max).into(),
        });
        let mut wrong = Vec::new();
        let mut say = |node: usize, sentence: String| {
            wrong.push(WrongNode {
                node: node as u32,
                sentence,
            });
        };
        let tree = without_dangling(&built, primitives.len(), &mut say);
        let exact = exact_boxes(&answer.tree, &work.bounds);
        for (i, node) in tree.nodes.iter().enumerate() {
            let needed = exact.as_ref().map(|exact| exact[i]);
            if let Ok(needed) = needed
                && !node.bounds.contains(&needed)
            {
                say(
                    i,
                    "its box does not contain the primitives below it".to_owned(),
                );
            }
            let most = work.max_leaf_size.max(1);
            if let NodeKind::Leaf { count, .. } = node.kind
                && count > most
            {
                say(
                    i,
                    format!("a leaf of {count} primitives; at most {most} are allowed"),
                );
            }
        }
        let (exact, fault) = match exact {
            Ok(exact) => (exact, None),
            Err(fault) => (Vec::new(), Some(fault)),
        };
        TreeCase {
            primitives: primitives.collect(),
            tree,
            exact,
            fault,
            wrong,
        }
    }

    /// What is wrong with a node.
    pub fn fault_of(&self, node: u32) -> impl Iterator<Item = &str> {
        let of_node = self.wrong.iter().filter(move |wrong| wrong.node == node);
        of_node.map(|wrong| wrong.sentence.as_str())
    }

    /// Whether the node's box is larger than what it contains: allowed, but slow.
    pub fn is_loose(&self, node: u32) -> bool {
        let (given, needed) = (
            self.tree.nodes.get(node as usize),
            self.exact.get(node as usize),
        );
        given
            .zip(needed)
            .is_some_and(|(given, needed)| given.bounds != *needed && given.bounds.contains(needed))
    }
}

/// The tree with an empty leaf in place of every node whose children, places or primitives do not
/// exist; `say` gets these nodes.
fn without_dangling(tree: &Bvh, primitives: usize, say: &mut dyn FnMut(usize, String)) -> Bvh {
    let mut whole = tree.clone();
    for (i, node) in whole.nodes.iter_mut().enumerate() {
        let fault = match node.kind {
            NodeKind::Interior { left, right } => [left, right]
                .into_iter()
                .find(|child| *child as usize >= tree.nodes.len() || *child as usize == i)
                .map(|child| format!("its child {child} is itself, or does not exist")),
            NodeKind::Leaf { first, count } => {
                let end = u64::from(first) + u64::from(count);
                let run = tree.order.get(first as usize..end as usize);
                match run {
                    None => Some(format!(
                        "a leaf of order[{first} .. {end}], but order has {} entries",
                        tree.order.len()
                    )),
                    Some(run) => run
                        .iter()
                        .find(|id| id.0 as usize >= primitives)
                        .map(|id| format!("it holds primitive {}, which does not exist", id.0)),
                }
            }
        };
        if let Some(fault) = fault {
            say(i, fault);
            node.kind = NodeKind::Leaf { first: 0, count: 0 };
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::{Node, Tree};

    const ROW: [[[f64; 3]; 2]; 2] = [
        [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]],
        [[2.0, 0.0, 0.0], [3.0, 1.0, 1.0]],
    ];

    fn case(change: impl FnOnce(&mut Tree)) -> TreeCase {
        let leaf = |first: u32, bounds| Node {
            bounds,
            kind: wire::work::NodeKind::Leaf { first, count: 1 },
        };
        let root = Node {
            bounds: [ROW[0][0], ROW[1][1]],
            kind: wire::work::NodeKind::Interior { left: 1, right: 2 },
        };
        let mut tree = Tree {
            nodes: vec![root, leaf(0, ROW[0]), leaf(1, ROW[1])],
            order: vec![0, 1],
        };
        change(&mut tree);
        let work = BuildWork {
            bounds: ROW.to_vec(),
            max_leaf_size: 1,
        };
        let answer = BuildAnswer {
            tree,
            repeatable: true,
        };
        TreeCase::of(&work, &answer)
    }

    fn wrong(case: &TreeCase) -> Vec<u32> {
        case.wrong.iter().map(|wrong| wrong.node).collect()
    }

    #[test]
    fn a_right_tree_has_no_wrong_node() {
        let right = case(|_| ());
        assert_eq!(
            (right.wrong.as_slice(), right.fault.as_deref()),
            (&[][..], None)
        );
        assert!((0..3).all(|node| !right.is_loose(node)));
    }

    #[test]
    fn small_boxes_are_wrong_and_large_ones_loose() {
        let small = case(|tree| tree.nodes[0].bounds[1] = [2.5, 1.0, 1.0]);
        assert_eq!(wrong(&small), [0]);
        let large = case(|tree| tree.nodes[2].bounds[1] = [9.0, 1.0, 1.0]);
        assert!(large.wrong.is_empty() && large.is_loose(2) && !large.is_loose(1));
    }

    #[test]
    fn dangling_nodes_are_named_and_do_not_panic() {
        let none = case(|tree| {
            tree.nodes[0].kind = wire::work::NodeKind::Interior { left: 1, right: 7 };
        });
        assert_eq!(wrong(&none), [0]);
        assert!(none.fault.is_some_and(|why| why.contains('7')));
        let beyond = case(|tree| {
            tree.nodes[2].kind = wire::work::NodeKind::Leaf {
                first: 1,
                count: u32::MAX,
            };
        });
        assert_eq!(beyond.wrong[0].node, 2);
        assert_eq!(beyond.tree.leaf(0, 0).len(), 0);
    }
}
