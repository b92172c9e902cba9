//! The structure of a tree that the code under test has built: no node is reached twice, and one
//! leaf holds each primitive.

use crate::plural;
use wire::work::{Node, NodeKind, Tree};

/// Why the nodes do not form a tree over the primitives.
pub(super) struct Fault {
    /// The name of its class.
    pub(super) name: &'static str,
    /// For people.
    pub(super) message: String,
}

impl Fault {
    fn new(name: &'static str, message: String) -> Fault {
        Fault { name, message }
    }
}

/// The nodes in an order in which parents come before their children, and the depth of each node (0
/// for the root).
pub(super) struct Walk {
    pub(super) parents_first: Vec<usize>,
    pub(super) depth: Vec<u32>,
}

impl Walk {
    /// The nodes that are reached from the root, with their indices. Others are spare places of a
    /// list, which no traversal sees.
    pub(super) fn nodes<'t>(&self, tree: &'t Tree) -> impl Iterator<Item = (usize, &'t Node)> {
        let nodes = tree.nodes.iter().enumerate();
        nodes.filter(|&(at, _)| at == 0 || self.depth[at] > 0)
    }
}

/// Traverses the tree once. The error is the first fault: the nodes do not form a tree, or its
/// leaves do not hold each primitive once.
pub(super) fn walk(tree: &Tree, primitives: usize) -> Result<Walk, Fault> {
    let mut walk = Walk {
        parents_first: Vec::new(),
        depth: vec![0; tree.nodes.len()],
    };
    let mut reached = vec![false; tree.nodes.len()];
    let mut leaf_of = vec![None; tree.order.len()];
    if tree.nodes.is_empty() && primitives > 0 {
        return Err(Fault::new(
            "no nodes",
            format!(
                "the tree has no nodes; expected: some that hold {}",
                plural(primitives, "primitive", "primitives")
            ),
        ));
    }
    let mut next = Vec::from_iter((!tree.nodes.is_empty()).then_some(0));
    while let Some(at) = next.pop() {
        if std::mem::replace(&mut reached[at], true) {
            return Err(Fault::new(
                "two parents",
                format!(
                    "node {at} has two parents or is its own ancestor: each node must be reached once from node 0"
                ),
            ));
        }
        walk.parents_first.push(at);
        match tree.nodes[at].kind {
            NodeKind::Interior { left, right } => {
                for child in [left as usize, right as usize] {
                    if child >= tree.nodes.len() {
                        return Err(Fault::new(
                            "no such child",
                            format!(
                                "node {at} has the child {child}, but the tree has {}",
                                plural(tree.nodes.len(), "node", "nodes")
                            ),
                        ));
                    }
                    walk.depth[child] = walk.depth[at] + 1;
                    next.push(child);
                }
            }
            NodeKind::Leaf { first, count } => take_run(&mut leaf_of, tree, at, first, count)?,
        }
    }
    let held = each_held(&leaf_of, &tree.order).and_then(|()| each_once(&tree.order, primitives));
    match (held, reached.iter().position(|reached| !reached)) {
        (Err(fault), Some(spare)) => Err(Fault::new(
            "unreachable",
            format!(
                "node {spare} cannot be reached from node 0; {}",
                fault.message
            ),
        )),
        (held, _) => held.map(|()| walk),
    }
}

/// Checks that a leaf holds each place of `order`.
fn each_held(leaf_of: &[Option<usize>], order: &[u32]) -> Result<(), Fault> {
    match leaf_of.iter().position(Option::is_none) {
        None => Ok(()),
        Some(place) => Err(Fault::new(
            "in no leaf",
            format!(
                "no leaf holds order[{place}] (primitive {}): no ray is tested against it",
                order[place]
            ),
        )),
    }
}

/// The class of a leaf that starts at `first` and ends behind the end of `order`.
fn beyond_order(tree: &Tree, first: usize) -> &'static str {
    let counts = tree.nodes.iter().map(|node| match node.kind {
        NodeKind::Leaf { count, .. } => count as usize,
        NodeKind::Interior { .. } => 0,
    });
    let entries = tree.order.len();
    if entries == 0 {
        "no order"
    } else if counts.sum::<usize>() > entries {
        "counts too large"
    } else if first >= entries {
        "begins beyond order"
    } else {
        "beyond order"
    }
}

/// Records that the leaf `at` holds `order[first .. first + count]`.
fn take_run(
    leaf_of: &mut [Option<usize>],
    tree: &Tree,
    at: usize,
    first: u32,
    count: u32,
) -> Result<(), Fault> {
    let (first, count) = (first as usize, count as usize);
    let length = leaf_of.len();
    let run = leaf_of.get_mut(first..first + count).ok_or_else(|| {
        Fault::new(
            beyond_order(tree, first),
            format!(
                "leaf {at} holds order[{first} .. {}], but order has {}",
                first + count,
                plural(length, "entry", "entries")
            ),
        )
    })?;
    for (place, holder) in (first..).zip(run) {
        if let Some(other) = holder.replace(at) {
            return Err(Fault::new(
                "overlap",
                format!(
                    "leaves {other} and {at} both hold order[{place}]: leaves must not overlap"
                ),
            ));
        }
    }
    Ok(())
}

/// Checks that `order` has each of the primitives once.
fn each_once(order: &[u32], primitives: usize) -> Result<(), Fault> {
    let mut seen = vec![false; primitives];
    for &id in order {
        match seen.get_mut(id as usize) {
            None => {
                return Err(Fault::new(
                    "no such primitive",
                    format!("the tree holds primitive {id}, but there are only {primitives}"),
                ));
            }
            Some(seen) if *seen => {
                return Err(Fault::new(
                    "twice",
                    format!(
                        "the tree holds primitive {id} twice: does each go either left or right, even if its centroid lies on the split?"
                    ),
                ));
            }
            Some(seen) => *seen = true,
        }
    }
    match seen.iter().filter(|seen| !**seen).count() {
        0 => Ok(()),
        lost => {
            let id = seen.iter().position(|seen| !seen).unwrap_or_default();
            Err(Fault::new(
                if id + lost == primitives {
                    "last ones lost"
                } else {
                    "lost"
                },
                format!(
                    "{lost} of {} in no leaf, for example primitive {id}: does each go left or right, even if its centroid lies on the split?",
                    plural(primitives, "primitive is", "primitives are")
                ),
            ))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The class of the fault of a tree with a root and these leaves.
    fn class(leaves: &[(u32, u32)], order: u32) -> Option<&'static str> {
        let node = |kind| Node {
            bounds: [[0.0; 3], [1.0; 3]],
            kind,
        };
        let interior = NodeKind::Interior { left: 1, right: 2 };
        let leaves = leaves
            .iter()
            .map(|&(first, count)| node(NodeKind::Leaf { first, count }));
        let tree = Tree {
            nodes: std::iter::once(node(interior)).chain(leaves).collect(),
            order: (0..order).collect(),
        };
        walk(&tree, 5).err().map(|fault| fault.name)
    }

    #[test]
    fn leaves_beyond_the_order_are_distinguished_by_what_is_wrong_about_them() {
        assert_eq!(class(&[(0, 2), (2, 3)], 5), None);
        assert_eq!(class(&[(0, 2), (2, 3)], 0), Some("no order"));
        assert_eq!(class(&[(0, 3), (2, 4)], 5), Some("counts too large"));
        assert_eq!(class(&[(2, 2), (5, 3)], 5), Some("begins beyond order"));
        assert_eq!(class(&[(1, 2), (3, 3)], 5), Some("beyond order"));
    }

    #[test]
    fn spare_nodes_are_wrong_only_where_primitives_are_lost() {
        assert_eq!(class(&[(0, 2), (2, 3), (0, 0)], 5), None);
        assert_eq!(class(&[(0, 2), (2, 3), (0, 5)], 5), None);
        assert_eq!(class(&[(0, 2), (2, 2), (4, 1)], 5), Some("unreachable"));
    }
}
