//! Judging a tree: whether it is one, holds everything, and saves work.
//!
//! The tree comes from code under test: nothing about it is taken for granted, neither that its
//! indices point somewhere nor that it has an end.

use crate::cases::recorded::TreeWork;
use crate::tally::{Aspect, Class, Tally};
use kit::{Aabb, Vec3};
use wire::answer::BuildAnswer;
use wire::work::{Node, NodeKind, Tree, Xyz};

/// A tree may cost this many times what the reference's costs. Median and midpoint splits differ by
/// less than 1.5, a surface area heuristic gains; the wrong axis or loose boxes cost many times as
/// much.
const COST_FACTOR: f64 = 2.0;

/// A tree may be this many times as deep as the reference's: a leaf of one more level costs nobody
/// anything, a list costs all.
const DEPTH_FACTOR: u32 = 4;

/// Judges what `construct_bvh` made of `bounds`; its work where some is recorded.
pub(crate) fn build(
    tally: &mut Tally,
    bounds: &[[Xyz; 2]],
    max_leaf_size: u32,
    answer: &BuildAnswer,
    recorded: Option<TreeWork>,
) {
    for aspect in [
        Aspect::Structure,
        Aspect::Bounds,
        Aspect::LeafSize,
        Aspect::Repeatable,
    ] {
        tally.expect(aspect);
    }
    if recorded.is_some() {
        tally.expect(Aspect::Work);
    }
    let repeatable = answer.repeatable;
    tally.judge(Aspect::Repeatable, 0, repeatable, 1.0, || {
        "building twice from the same boxes gave two trees: does the order of a hash map or a random number decide?".into()
    });
    let tree = &answer.tree;
    let walk = match walk(tree, bounds.len()) {
        Ok(walk) => walk,
        Err(fault) => {
            let class = Some(Class::Named(fault.name));
            tally.judge_class(Aspect::Structure, 0, class, 1.0, || fault.says);
            return;
        }
    };
    tally.judge(Aspect::Structure, 0, true, 0.0, String::new);
    let held = held_boxes(tree, &walk, bounds);
    judge_bounds(tally, tree, &held);
    judge_leaves(tally, tree, bounds.len(), max_leaf_size);
    if let Some(recorded) = recorded {
        judge_work(tally, tree, &walk, &held, recorded);
    }
}

/// Why what was built is no tree over the primitives.
struct Fault {
    /// For comparing with others.
    name: &'static str,
    /// For people.
    says: String,
}

impl Fault {
    fn new(name: &'static str, says: String) -> Fault {
        Fault { name, says }
    }
}

/// The nodes in an order in which parents come before their children, and how deep each is (the
/// root is at 0).
struct Walk {
    parents_first: Vec<usize>,
    depth: Vec<u32>,
}

/// Goes through the tree once, and says what is wrong with it if it is none or does not hold each
/// primitive once.
fn walk(tree: &Tree, primitives: usize) -> Result<Walk, Fault> {
    let mut walk = Walk {
        parents_first: Vec::new(),
        depth: vec![0; tree.nodes.len()],
    };
    let mut reached = vec![false; tree.nodes.len()];
    let mut placed_by = vec![None; tree.order.len()];
    if tree.nodes.is_empty() && primitives > 0 {
        return Err(Fault::new(
            "no nodes",
            format!("the tree has no nodes, but there are {primitives} primitives"),
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
                                "node {at} names the child {child}, but the tree has {} nodes",
                                tree.nodes.len()
                            ),
                        ));
                    }
                    walk.depth[child] = walk.depth[at] + 1;
                    next.push(child);
                }
            }
            NodeKind::Leaf { first, count } => take_run(&mut placed_by, at, first, count)?,
        }
    }
    if let Some(lost) = reached.iter().position(|reached| !reached) {
        return Err(Fault::new(
            "unreachable",
            format!("node {lost} is below no other: it cannot be reached from node 0"),
        ));
    }
    if let Some(place) = placed_by.iter().position(Option::is_none) {
        return Err(Fault::new(
            "in no leaf",
            format!(
                "no leaf holds order[{place}] (primitive {}): no ray will ever find it",
                tree.order[place]
            ),
        ));
    }
    each_once(&tree.order, primitives)?;
    Ok(walk)
}

/// Notes that the leaf `at` holds `order[first .. first + count]`.
fn take_run(
    placed_by: &mut [Option<usize>],
    at: usize,
    first: u32,
    count: u32,
) -> Result<(), Fault> {
    let (first, count) = (first as usize, count as usize);
    let length = placed_by.len();
    let run = placed_by.get_mut(first..first + count).ok_or_else(|| {
        Fault::new(
            "beyond order",
            format!(
                "leaf {at} holds order[{first} .. {}], but order has {length} entries",
                first + count
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

/// Whether `order` names each of the primitives once.
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
                    format!("the tree holds primitive {id} twice"),
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
                    "{lost} of {primitives} primitives are lost, primitive {id} for one: does every one go left or right, also a centroid that lies on the split?"
                ),
            ))
        }
    }
}

/// For each node the smallest box around the primitives below it.
fn held_boxes(tree: &Tree, walk: &Walk, bounds: &[[Xyz; 2]]) -> Vec<Aabb> {
    let mut held = vec![Aabb::EMPTY; tree.nodes.len()];
    for &at in walk.parents_first.iter().rev() {
        held[at] = match tree.nodes[at].kind {
            NodeKind::Interior { left, right } => held[left as usize].union(held[right as usize]),
            NodeKind::Leaf { first, count } => tree.order
                [first as usize..first as usize + count as usize]
                .iter()
                .map(|&id| aabb(&bounds[id as usize]))
                .filter(|b| !b.is_empty())
                .fold(Aabb::EMPTY, Aabb::union),
        };
    }
    held
}

fn aabb(&[min, max]: &[Xyz; 2]) -> Aabb {
    Aabb {
        min: Vec3::from(min),
        max: Vec3::from(max),
    }
}

fn judge_bounds(tally: &mut Tally, tree: &Tree, held: &[Aabb]) {
    for (at, (node, held)) in tree.nodes.iter().zip(held).enumerate() {
        let given = aabb(&node.bounds);
        let right = given.contains(held);
        let missing = (given.min - held.min)
            .max(held.max - given.max)
            .max_element();
        let class = (!right).then_some(Class::Named(match node.kind {
            _ if at == 0 => "root",
            NodeKind::Interior { .. } => "inner node",
            NodeKind::Leaf { .. } => "leaf",
        }));
        tally.judge_class(Aspect::Bounds, 0, class, missing, || {
            format!(
                "node {at} has the box {}, but the primitives below it reach over {}",
                show(&given),
                show(held)
            )
        });
    }
    if tree.nodes.is_empty() {
        tally.judge(Aspect::Bounds, 0, true, 0.0, String::new);
    }
}

fn show(b: &Aabb) -> String {
    format!(
        "{} .. {}",
        crate::hits::show(b.min),
        crate::hits::show(b.max)
    )
}

fn judge_leaves(tally: &mut Tally, tree: &Tree, primitives: usize, max_leaf_size: u32) {
    // 0 counts as 1.
    let max_leaf_size = max_leaf_size.max(1);
    if tree.nodes.is_empty() {
        tally.judge(Aspect::LeafSize, 0, true, 0.0, String::new);
    }
    for (at, node) in tree.nodes.iter().enumerate() {
        let NodeKind::Leaf { count, .. } = node.kind else {
            continue;
        };
        let too_many = count > max_leaf_size;
        let for_nothing = count == 0 && primitives > 0;
        let class = match count {
            0 if for_nothing => Some(Class::Named("empty")),
            _ if count == max_leaf_size + 1 => Some(Class::Named("one too many")),
            _ if too_many => Some(Class::Named("too many")),
            _ => None,
        };
        tally.judge_class(
            Aspect::LeafSize,
            0,
            class,
            f64::from(count),
            || {
                if for_nothing {
                    return format!("leaf {at} holds nothing: every ray that meets it is asked in vain");
                }
                format!("leaf {at} holds {count} primitives, max_leaf_size is {max_leaf_size}: when one side of a split is empty, split in another way, for example in two equal halves")
            },
        );
    }
}

/// What a tree costs: the box and primitive tests that a random line through the scene has to make,
/// by the surface area heuristic (Goldsmith and Salmon, "Automatic creation of object hierarchies
/// for ray tracing", 1987): a line that meets the scene meets a convex box inside with the ratio of
/// their areas.
///
/// Areas are those of the nodes' own boxes, over that of the scene's true one, so that loose boxes
/// cost.
fn judge_work(tally: &mut Tally, tree: &Tree, walk: &Walk, held: &[Aabb], recorded: TreeWork) {
    let scene = held.first().map_or(0.0, Aabb::surface_area);
    let tests = |node: &Node| match node.kind {
        NodeKind::Interior { .. } => 2.0,
        NodeKind::Leaf { count, .. } => f64::from(count),
    };
    let cost: f64 = tree
        .nodes
        .iter()
        .map(|node| tests(node) * aabb(&node.bounds).surface_area() / scene)
        .sum();
    let cheap = cost <= COST_FACTOR * recorded.cost;
    let ratio = cost / recorded.cost;
    let why = looseness(tree, held);
    let class = (!cheap).then_some(Class::Named(why));
    tally.judge_class(Aspect::Work, 0, class, ratio, || {
        format!(
            "a line through this tree makes {cost:.1} tests on average, through the reference's {:.1} (up to {COST_FACTOR} times that is fine): is each node split along its longest axis, and is its box no larger than needed?",
            recorded.cost
        )
    });
    if !cheap && why == COSTLY_SPLITS {
        // How much they cost tells them from each other.
        let class = Class::of_size(ratio);
        tally.judge_class(Aspect::Work, 0, Some(class), ratio, String::new);
    }
    let depth = walk.depth.iter().copied().max().unwrap_or(0);
    let flat = depth <= DEPTH_FACTOR * recorded.depth;
    let class = (!flat).then_some(Class::Named("deep"));
    tally.judge_class(Aspect::Work, 0, class, f64::from(depth) / f64::from(recorded.depth), || {
        format!(
            "the tree is {depth} levels deep, the reference's {} (up to {DEPTH_FACTOR} times that is fine): do the splits leave a fair share on both sides?",
            recorded.depth
        )
    });
}

/// What costs in a tree whose boxes are as small as they can be.
const COSTLY_SPLITS: &str = "costly splits";

/// What costs in a tree: boxes that are larger than what they hold, or how it was split.
fn looseness(tree: &Tree, held: &[Aabb]) -> &'static str {
    let boxes = || tree.nodes.iter().map(|node| aabb(&node.bounds)).zip(held);
    let to_origin = |held: &Aabb| held.grown_by(Vec3::ZERO);
    if boxes().all(|(given, held)| given == *held) {
        COSTLY_SPLITS
    } else if boxes().all(|(given, held)| given == to_origin(held)) {
        "boxes that reach to the origin"
    } else {
        "loose boxes"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four unit cubes in a row along x.
    const ROW: [[Xyz; 2]; 4] = [
        [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]],
        [[2.0, 0.0, 0.0], [3.0, 1.0, 1.0]],
        [[4.0, 0.0, 0.0], [5.0, 1.0, 1.0]],
        [[6.0, 0.0, 0.0], [7.0, 1.0, 1.0]],
    ];

    /// What the tree of [`right`] costs: 2 for the root, 2 leaves of 2 that fill 14/30 of its area
    /// each.
    const COST: TreeWork = TreeWork {
        cost: 2.0 + 2.0 * 2.0 * 14.0 / 30.0,
        depth: 1,
    };

    fn leaf(first: u32, count: u32, min_x: f64, max_x: f64) -> Node {
        Node {
            bounds: [[min_x, 0.0, 0.0], [max_x, 1.0, 1.0]],
            kind: NodeKind::Leaf { first, count },
        }
    }

    /// A root and two leaves of two cubes each.
    fn right() -> Tree {
        let root = Node {
            bounds: [[0.0, 0.0, 0.0], [7.0, 1.0, 1.0]],
            kind: NodeKind::Interior { left: 1, right: 2 },
        };
        Tree {
            nodes: vec![root, leaf(0, 2, 0.0, 3.0), leaf(2, 2, 4.0, 7.0)],
            order: vec![0, 1, 2, 3],
        }
    }

    fn failed(tree: Tree) -> Vec<Aspect> {
        let answer = BuildAnswer {
            tree,
            repeatable: true,
        };
        let mut tally = Tally::default();
        build(&mut tally, &ROW, 2, &answer, Some(COST));
        let findings = tally.into_findings();
        let failed = findings.iter().filter(|finding| !finding.passed());
        failed.map(|finding| finding.aspect).collect()
    }

    #[test]
    fn a_right_tree_passes() {
        assert_eq!(failed(right()), []);
    }

    #[test]
    fn what_is_no_tree_is_not_judged_further() {
        let is_none = |change: fn(&mut Tree)| {
            let mut tree = right();
            change(&mut tree);
            assert!(failed(tree).contains(&Aspect::Structure));
        };
        is_none(|tree| tree.nodes.clear());
        is_none(|tree| tree.nodes[0].kind = NodeKind::Interior { left: 1, right: 1 });
        is_none(|tree| tree.nodes[0].kind = NodeKind::Interior { left: 0, right: 1 });
        is_none(|tree| tree.nodes[0].kind = NodeKind::Interior { left: 1, right: 9 });
        is_none(|tree| tree.nodes.push(leaf(0, 0, 0.0, 1.0)));
        is_none(|tree| tree.nodes[2] = leaf(1, 2, 4.0, 7.0));
        is_none(|tree| tree.nodes[2] = leaf(2, 1, 4.0, 7.0));
        is_none(|tree| tree.nodes[2] = leaf(2, u32::MAX, 4.0, 7.0));
        is_none(|tree| tree.order[3] = 0);
        is_none(|tree| tree.order[3] = 4);
        is_none(|tree| {
            tree.order.pop();
            tree.nodes[2] = leaf(2, 1, 4.0, 7.0);
        });
    }

    #[test]
    fn a_box_must_hold_what_is_below() {
        let mut tree = right();
        tree.nodes[1] = leaf(0, 2, 0.5, 2.5);
        assert_eq!(failed(tree), [Aspect::Bounds]);
        let mut tree = right();
        tree.nodes[1] = leaf(0, 2, f64::NAN, 3.0);
        assert!(failed(tree).contains(&Aspect::Bounds));
    }

    #[test]
    fn a_leaf_must_not_be_too_large() {
        let tree = Tree {
            nodes: vec![leaf(0, 4, 0.0, 7.0)],
            order: vec![0, 1, 2, 3],
        };
        assert_eq!(failed(tree), [Aspect::LeafSize]);
    }

    #[test]
    fn loose_boxes_cost_work() {
        let mut tree = right();
        tree.nodes[2] = leaf(2, 2, -50.0, 7.0);
        assert_eq!(failed(tree), [Aspect::Work]);
    }
}
