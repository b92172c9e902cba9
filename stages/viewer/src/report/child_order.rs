//! In which order a traversal went into the two children of each node, beside the order of
//! distance.

use kit::{Bvh, NodeKind};
use pathtracer::replay::{RayRecord, Test, Visit};

/// A child whose box the ray enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnteredChild {
    /// The node.
    pub node: u32,
    /// Where the ray enters its box.
    pub entry: f64,
    /// The index of the first test of something in it; `None` if nothing in it was tested.
    pub first_test: Option<usize>,
}

/// A node of which the ray enters both children.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChildOrder {
    /// The node.
    pub node: u32,
    /// The child that the traversal went into first, and the other one.
    pub visited: [EnteredChild; 2],
}

impl ChildOrder {
    /// Whether the nearer child was first; of two at one distance either may be.
    pub fn is_nearer_first(&self) -> bool {
        self.visited[0].entry <= self.visited[1].entry
    }

    /// What the traversal did, as a sentence.
    pub fn sentence(&self) -> String {
        let [first, second] = self.visited;
        let order = match self.is_nearer_first() {
            true => "nearer child first",
            false => "farther child first",
        };
        format!(
            "node {}: {order}: your code goes into node {} (entered at t = {:?}) before node {} (t = {:?})",
            self.node, first.node, first.entry, second.node, second.entry
        )
    }

    /// The children in the order of their distance.
    pub fn by_distance(&self) -> [EnteredChild; 2] {
        let [first, second] = self.visited;
        if self.is_nearer_first() {
            [first, second]
        } else {
            [second, first]
        }
    }
}

/// The nodes of which the ray enters both children, in the order in which they were visited.
pub fn child_orders(tree: &Bvh, record: &RayRecord) -> Vec<ChildOrder> {
    let entered = |node: u32| {
        let entry =
            record.tests.iter().find_map(|test| match test {
                Test::Box {
                    node: Some(n),
                    visit:
                        Visit::Entered { entry, .. }
                        | Visit::Pruned { entry, .. }
                        | Visit::Behind { entry },
                    ..
                } if *n == node => Some(*entry),
                _ => None,
            });
        entry.map(|entry| EnteredChild {
            node,
            entry,
            first_test: first_test_in(tree, record, node),
        })
    };
    let orders = (0..).zip(&tree.nodes).filter_map(|(i, node)| {
        let NodeKind::Interior { left, right } = node.kind else {
            return None;
        };
        let [left, right] = [entered(left)?, entered(right)?];
        // Where neither was visited there is no order.
        let at = |child: EnteredChild| child.first_test.unwrap_or(usize::MAX);
        let visited = match at(left).cmp(&at(right)) {
            std::cmp::Ordering::Less => [left, right],
            std::cmp::Ordering::Greater => [right, left],
            std::cmp::Ordering::Equal => return None,
        };
        Some(ChildOrder { node: i, visited })
    });
    let mut orders: Vec<ChildOrder> = orders.collect();
    orders.sort_by_key(|order| order.visited[0].first_test);
    orders
}

/// The index of the first test of a child of `node`, or of a primitive in it if it is a leaf.
fn first_test_in(tree: &Bvh, record: &RayRecord, node: u32) -> Option<usize> {
    let is_inside = |test: &Test| match (tree.nodes.get(node as usize)?.kind, test) {
        (NodeKind::Interior { left, right }, Test::Box { node: Some(n), .. }) => {
            Some(*n == left || *n == right)
        }
        (NodeKind::Leaf { first, count }, Test::Primitive { prim, .. }) => {
            Some(tree.leaf(first, count).contains(prim))
        }
        _ => None,
    };
    let mut tests = record.tests.iter();
    tests.position(|test| is_inside(test) == Some(true))
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Aabb, BvhNode, PrimId, Ray, Vec3};
    use pathtracer::RayRole;
    use pathtracer::replay::{Outcome, PrimAnswer};

    /// A root over two leaves of one primitive each.
    fn tree() -> Bvh {
        let node = |kind| BvhNode {
            bounds: Aabb::EMPTY,
            kind,
        };
        Bvh {
            nodes: vec![
                node(NodeKind::Interior { left: 1, right: 2 }),
                node(NodeKind::Leaf { first: 0, count: 1 }),
                node(NodeKind::Leaf { first: 1, count: 1 }),
            ],
            order: vec![PrimId(0), PrimId(1)],
        }
    }

    /// The ray enters node 1 at 5 and node 2 at 2; the primitives are tested in the order `prims`.
    fn record(prims: &[u32]) -> RayRecord {
        let entered = |node, entry| Test::Box {
            node: Some(node),
            bounds: Aabb::EMPTY,
            max_t: 9.0,
            visit: Visit::Entered { entry, exit: 9.0 },
        };
        let tested = |prim: &u32| Test::Primitive {
            prim: PrimId(*prim),
            max_t: 9.0,
            answer: PrimAnswer::Miss,
        };
        let boxes = [entered(0, 1.0), entered(1, 5.0), entered(2, 2.0)];
        RayRecord {
            role: RayRole::Camera,
            depth: 0,
            parent: None,
            ray: Ray::new(Vec3::ZERO, Vec3::Z),
            skip: None,
            outcome: Outcome::Miss,
            tests: boxes.into_iter().chain(prims.iter().map(tested)).collect(),
        }
    }

    #[test]
    fn the_farther_child_first_is_found_with_its_first_test() {
        let orders = child_orders(&tree(), &record(&[0, 1]));
        let [order] = orders.as_slice() else {
            panic!("one node has two children: {orders:?}")
        };
        assert!(!order.is_nearer_first());
        assert_eq!(order.visited.map(|child| child.node), [1, 2]);
        assert_eq!(order.by_distance().map(|child| child.node), [2, 1]);
        assert_eq!(order.visited[0].first_test, Some(3));
    }

    #[test]
    fn the_nearer_child_first_is_right_also_where_the_other_is_left_out() {
        for prims in [&[1, 0][..], &[1]] {
            let orders = child_orders(&tree(), &record(prims));
            assert!(orders[0].is_nearer_first(), "{prims:?}");
        }
        assert_eq!(child_orders(&tree(), &record(&[])), []);
    }
}
