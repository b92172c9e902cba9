//! Judges a tree: its bounds and the work that it needs; [`super::structure`] judges its structure,
//! [`super::leaves`] its leaves.
//!
//! The tree comes from code under test: indices may be out of range, and nodes may form a cycle.

use super::leaves;
use super::structure::{Walk, walk};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use crate::tools::plural;
use crate::tools::recorded::TreeWork;
use kit::{Aabb, Vec3};
use std::ops::Range;
use wire::answer::BuildAnswer;
use wire::work::{Node, NodeKind, Tree, Xyz};

/// The cost of a tree may be this many times that of the reference. Median and midpoint splits
/// differ by less than 1.5, and a surface area heuristic is cheaper; splits along the wrong axis or
/// loose boxes cost many times as much.
const COST_FACTOR: f64 = 2.0;

/// A tree saves work if its cost is at most this share of that of testing every primitive. A tree
/// that is split along the wrong axis still saves that much in a mesh.
const MAX_COST_SHARE: f64 = 0.25;

/// A tree may be this many times as deep as the reference's: a few more levels cost little, but a
/// list as deep as its length costs all the gain.
const DEPTH_FACTOR: u32 = 4;

/// Judges the tree that `construct_bvh` built over `bounds`; its cost only if one is `recorded`.
pub(crate) fn build(
    findings: &mut Findings,
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
        findings.expect(aspect);
    }
    if recorded.is_some() {
        findings.expect(Aspect::Work);
    }
    let repeatable = answer.repeatable;
    findings.judge(Aspect::Repeatable, 0, repeatable, 1.0, || {
        "your results: two different trees from the same boxes; expected: the same tree. Does it depend on the order of a hash map or on a random number?"
    });
    let tree = &answer.tree;
    let walk = match walk(tree, bounds.len()) {
        Ok(walk) => walk,
        Err(fault) => {
            let class = Some(Class::Named(fault.name));
            findings.judge_class(Aspect::Structure, 0, class, 1.0, || fault.message);
            return;
        }
    };
    findings.judge(Aspect::Structure, 0, true, 0.0, String::new);
    let tight = tight_boxes(tree, &walk, bounds);
    judge_bounds(findings, tree, &walk, &tight, bounds);
    leaves::judge(findings, tree, &walk, bounds, max_leaf_size);
    if let Some(recorded) = recorded {
        judge_work(findings, tree, &walk, &tight, recorded);
    }
}

/// For each node, the smallest box around the primitives below it.
pub(super) fn tight_boxes(tree: &Tree, walk: &Walk, bounds: &[[Xyz; 2]]) -> Vec<Aabb> {
    let mut tight = vec![Aabb::EMPTY; tree.nodes.len()];
    for &at in walk.parents_first.iter().rev() {
        tight[at] = match tree.nodes[at].kind {
            NodeKind::Interior { left, right } => tight[left as usize].union(tight[right as usize]),
            NodeKind::Leaf { first, count } => tree.order
                [first as usize..first as usize + count as usize]
                .iter()
                .map(|&id| aabb(&bounds[id as usize]))
                .filter(|b| !b.is_empty())
                .fold(Aabb::EMPTY, Aabb::union),
        };
    }
    tight
}

pub(super) fn aabb(&[min, max]: &[Xyz; 2]) -> Aabb {
    Aabb {
        min: Vec3::from(min),
        max: Vec3::from(max),
    }
}

fn judge_bounds(
    findings: &mut Findings,
    tree: &Tree,
    walk: &Walk,
    tight: &[Aabb],
    bounds: &[[Xyz; 2]],
) {
    for (at, node) in walk.nodes(tree) {
        let tight = &tight[at];
        let given = aabb(&node.bounds);
        let right = given.contains(tight);
        let missing = (given.min - tight.min)
            .max(tight.max - given.max)
            .max_element();
        let class = (!right).then(|| match node.kind {
            _ if at == 0 => Class::Named("root"),
            NodeKind::Interior { .. } => Class::Named("inner node"),
            NodeKind::Leaf { first, count } => {
                let held = first as usize..first as usize + count as usize;
                class_of_leaf_box(&given, held, &tree.order, bounds)
            }
        });
        findings.judge_class(Aspect::Bounds, 0, class, missing, || {
            let ends = |b: &Aabb| [b.min.to_array(), b.max.to_array()].concat();
            Message::new(format!(
                "node {at}{}: your result: the box {}; expected: a box that contains the primitives below it, {}",
                over(tree, at),
                show(&given),
                show(tight)
            ))
            .compares(ends(&given), ends(&given.union(*tight)))
        });
    }
    if tree.nodes.is_empty() {
        findings.judge(Aspect::Bounds, 0, true, 0.0, String::new);
    }
}

/// The primitives below a node, by which it is found in a drawing of the tree: ", over primitives
/// 0 and 2". Empty for a node with many.
fn over(tree: &Tree, at: usize) -> String {
    let mut below = Vec::new();
    let mut next = vec![at];
    while let Some(at) = next.pop() {
        match tree.nodes[at].kind {
            NodeKind::Interior { left, right } => next.extend([right as usize, left as usize]),
            NodeKind::Leaf { first, count } => {
                let held = tree.order.iter().skip(first as usize);
                below.extend(held.take(count as usize).copied());
            }
        }
        if below.len() > FEW_PRIMITIVES {
            return String::new();
        }
    }
    let listed: Vec<String> = below.iter().map(u32::to_string).collect();
    match listed.len() {
        0 => String::new(),
        1 => format!(", over primitive {}", listed[0]),
        _ => format!(", over primitives {}", listed.join(" ")),
    }
}

/// The most primitives below a node that are listed.
const FEW_PRIMITIVES: usize = 5;

/// The class of the box `given` of a leaf that holds `held`, places of `order`, if it is too small:
/// of which primitives it is the box, so that the class does not depend on how the tree was split.
fn class_of_leaf_box(
    given: &Aabb,
    held: Range<usize>,
    order: &[u32],
    bounds: &[[Xyz; 2]],
) -> Class {
    let is_box_of =
        |primitive: Option<&u32>| primitive.is_some_and(|&id| *given == aabb(&bounds[id as usize]));
    let primitives = &order[held.clone()];
    let by_place = bounds[held].iter().map(aabb).filter(|b| !b.is_empty());
    Class::Named(if *given == by_place.fold(Aabb::EMPTY, Aabb::union) {
        "leaf by place"
    } else if is_box_of(primitives.first()) {
        "leaf of its first primitive"
    } else if is_box_of(primitives.last()) {
        "leaf of its last primitive"
    } else {
        "leaf"
    })
}

fn show(b: &Aabb) -> String {
    format!(
        "{} .. {}",
        crate::tools::aspects::hits::show(b.min),
        crate::tools::aspects::hits::show(b.max)
    )
}

/// The expected number of tests of a random line through the scene (see [`judge_work`]).
pub(super) fn cost(tree: &Tree, walk: &Walk, tight: &[Aabb]) -> f64 {
    let scene = tight.first().map_or(0.0, Aabb::surface_area);
    let tests = |node: &Node| match node.kind {
        NodeKind::Interior { .. } => 2.0,
        NodeKind::Leaf { count, .. } => f64::from(count),
    };
    let costs = walk.nodes(tree);
    costs
        .map(|(_, node)| tests(node) * aabb(&node.bounds).surface_area() / scene)
        .sum()
}

/// Judges the cost of a tree: the expected number of box and primitive tests of a random line
/// through the scene, by the surface area heuristic (Goldsmith and Salmon, "Automatic creation of
/// object hierarchies for ray tracing", 1987): a line that hits the scene's box hits a convex box
/// inside it with a probability equal to the ratio of their areas.
///
/// The areas are those of the nodes' boxes relative to the tight box of the scene, so that loose
/// boxes increase the cost.
fn judge_work(
    findings: &mut Findings,
    tree: &Tree,
    walk: &Walk,
    tight: &[Aabb],
    recorded: TreeWork,
) {
    let cost = cost(tree, walk, tight);
    let cheap = cost <= COST_FACTOR * recorded.cost;
    let ratio = cost / recorded.cost;
    let why = cause_of_cost(tree, walk, tight);
    let class = (!cheap).then_some(Class::Named(why));
    let message = || {
        format!(
            "your result: {cost:.1} tests per random line, in your tree of {} over {}; the reference's tree: {:.1} (up to {COST_FACTOR} times that passes). {}",
            plural(tree.nodes.len(), "node", "nodes"),
            plural(tree.order.len(), "box", "boxes"),
            recorded.cost,
            question(tree, tight)
        )
    };
    findings.judge_class(Aspect::Work, 0, class, ratio, message);
    let all = tree.order.len() as f64;
    // Where a tree that passes may save less, nothing is judged.
    if COST_FACTOR * recorded.cost <= MAX_COST_SHARE * all {
        findings.expect(Aspect::Savings);
        let saves = cost <= MAX_COST_SHARE * all;
        findings.judge(Aspect::Savings, 0, saves, cost / all, || {
            format!(
                "your result: {cost:.1} tests per random line; without a tree: {all}. A tree saves most of them"
            )
        });
    }
    if !cheap && why == COSTLY_SPLITS {
        // The cost distinguishes mistakes.
        let class = Class::of_size(ratio);
        findings.judge_class(Aspect::Work, 0, Some(class), ratio, message);
    }
    let depth = walk.depth.iter().copied().max().unwrap_or(0);
    let flat = depth <= DEPTH_FACTOR * recorded.depth;
    let class = (!flat).then_some(Class::Named("deep"));
    findings.judge_class(Aspect::Work, 0, class, f64::from(depth) / f64::from(recorded.depth), || {
        format!(
            "your result: a depth of {depth} levels; the reference: {} (up to {DEPTH_FACTOR} times that passes). Does each split leave several primitives on both sides?",
            recorded.depth
        )
    });
}

/// Where to look for the cause of a high cost.
fn question(tree: &Tree, tight: &[Aabb]) -> String {
    let root = tree.nodes.first().map(|node| node.kind);
    if let Some(NodeKind::Interior { left, right }) = root {
        let [left, right] = [left, right].map(|child| tight[child as usize].centroid());
        let extent = tight[0].extent();
        let [split, long] = [(right - left).abs(), extent].map(Vec3::max_position);
        if extent[split] < extent[long] {
            let [split_by, long_by] = [split, long].map(|axis| ["x", "y", "z"][axis]);
            return format!(
                "The children of your root lie beside each other along {split_by}, where all boxes extend over {}; along {long_by} they extend over {}",
                extent[split], extent[long]
            );
        }
    }
    "Is each node split along its longest axis, and is its box as small as possible?".into()
}

/// The cause of a high cost in a tree whose boxes are tight.
const COSTLY_SPLITS: &str = "costly splits";

/// The cause of a high cost: loose boxes or bad splits.
fn cause_of_cost(tree: &Tree, walk: &Walk, tight: &[Aabb]) -> &'static str {
    let boxes = || {
        walk.nodes(tree)
            .map(|(at, node)| (aabb(&node.bounds), &tight[at]))
    };
    let to_origin = |tight: &Aabb| tight.grown_by(Vec3::ZERO);
    if boxes().all(|(given, tight)| given == *tight) {
        COSTLY_SPLITS
    } else if boxes().all(|(given, tight)| given == to_origin(tight)) {
        "boxes that reach to the origin"
    } else {
        "loose boxes"
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tasks::part2_task1::simple;

    /// Four unit cubes in a row along x.
    const ROW: [[Xyz; 2]; 4] = [
        [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]],
        [[2.0, 0.0, 0.0], [3.0, 1.0, 1.0]],
        [[4.0, 0.0, 0.0], [5.0, 1.0, 1.0]],
        [[6.0, 0.0, 0.0], [7.0, 1.0, 1.0]],
    ];

    /// The cost of the tree of [`right`]: 2 for the root, and 2 leaves of 2 primitives with 14/30
    /// of its area each.
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
        let mut findings = Findings::default();
        build(&mut findings, &ROW, 2, &answer, Some(COST));
        findings.wrong_aspects()
    }

    #[test]
    fn a_right_tree_passes() {
        assert_eq!(failed(right()), []);
        let mut with_spare_nodes = right();
        with_spare_nodes.nodes.resize(6, leaf(0, 0, 9.0, -9.0));
        with_spare_nodes.nodes.push(leaf(0, 4, 0.0, 99.0));
        assert_eq!(failed(with_spare_nodes), []);
    }

    #[test]
    fn a_faulty_structure_fails() {
        let fails = |change: fn(&mut Tree)| {
            let mut tree = right();
            change(&mut tree);
            assert!(failed(tree).contains(&Aspect::Structure));
        };
        fails(|tree| tree.nodes.clear());
        fails(|tree| tree.nodes[0].kind = NodeKind::Interior { left: 1, right: 1 });
        fails(|tree| tree.nodes[0].kind = NodeKind::Interior { left: 0, right: 1 });
        fails(|tree| tree.nodes[0].kind = NodeKind::Interior { left: 1, right: 9 });
        fails(|tree| tree.nodes[0] = leaf(0, 2, 0.0, 3.0));
        fails(|tree| tree.nodes[2] = leaf(1, 2, 4.0, 7.0));
        fails(|tree| tree.nodes[2] = leaf(2, 1, 4.0, 7.0));
        fails(|tree| tree.nodes[2] = leaf(2, u32::MAX, 4.0, 7.0));
        fails(|tree| tree.order[3] = 0);
        fails(|tree| tree.order[3] = 4);
        fails(|tree| {
            tree.order.pop();
            tree.nodes[2] = leaf(2, 1, 4.0, 7.0);
        });
    }

    #[test]
    fn a_box_must_contain_the_primitives_below() {
        let mut tree = right();
        tree.nodes[1] = leaf(0, 2, 0.5, 2.5);
        assert_eq!(failed(tree), [Aspect::Bounds]);
        let mut tree = right();
        tree.nodes[1] = leaf(0, 2, f64::NAN, 3.0);
        assert!(failed(tree).contains(&Aspect::Bounds));
    }

    #[test]
    fn the_class_of_a_small_box_of_a_leaf_is_what_it_holds() {
        let order = [2, 0, 3, 1];
        let class = |min_x: f64, max_x: f64| {
            let given = aabb(&leaf(0, 2, min_x, max_x).bounds);
            class_of_leaf_box(&given, 0..2, &order, &ROW)
        };
        assert_eq!(class(4.0, 5.0), Class::Named("leaf of its first primitive"));
        assert_eq!(class(0.0, 1.0), Class::Named("leaf of its last primitive"));
        assert_eq!(class(0.0, 3.0), Class::Named("leaf by place"));
        assert_eq!(class(0.5, 4.5), Class::Named("leaf"));
    }

    #[test]
    fn a_leaf_must_not_be_too_large() {
        let tree = Tree {
            nodes: vec![leaf(0, 4, 0.0, 7.0)],
            order: vec![0, 1, 2, 3],
        };
        assert_eq!(failed(tree), [Aspect::LeafSize]);
    }

    /// The simple question about the axis: pairs of boxes far apart along x. `order` says how the
    /// root divides them.
    fn divided(order: [u32; 4]) -> Option<String> {
        let work = simple::pairs(0);
        let mut nodes = vec![leaf(0, 0, 0.0, 0.0); 7];
        for (at, kind) in [
            NodeKind::Interior { left: 1, right: 2 },
            NodeKind::Interior { left: 3, right: 4 },
            NodeKind::Interior { left: 5, right: 6 },
        ]
        .into_iter()
        .chain((0..4).map(|first| NodeKind::Leaf { first, count: 1 }))
        .enumerate()
        {
            nodes[at].kind = kind;
        }
        let order = order.to_vec();
        let mut tree = Tree { nodes, order };
        let Ok(walk) = walk(&tree, 4) else {
            panic!("it is a tree")
        };
        let tight = tight_boxes(&tree, &walk, &work.bounds);
        for (node, tight) in tree.nodes.iter_mut().zip(&tight) {
            node.bounds = [tight.min.into(), tight.max.into()];
        }
        let answer = BuildAnswer {
            tree,
            repeatable: true,
        };
        let mut findings = Findings::default();
        let recorded = simple::recorded(&work);
        build(&mut findings, &work.bounds, 1, &answer, recorded);
        let list = findings.into_vec();
        let mut failed = list.into_iter().filter(|finding| finding.wrong > 0);
        let worst = failed.next().map(|finding| (finding.aspect, finding.worst));
        assert!(failed.next().is_none());
        let (aspect, worst) = worst?;
        assert_eq!(aspect, Aspect::Work);
        worst.map(|worst| worst.message.to_string())
    }

    #[test]
    fn a_split_along_the_wrong_axis_is_told_with_figures() {
        assert_eq!(divided([0, 2, 1, 3]), None);
        let says = divided([0, 1, 2, 3]).expect("it costs too much");
        let expected = "your result: 4.7 tests per random line, in your tree of 7 nodes over 4 boxes; the reference's tree: 2.1 (up to 2 times that passes). The children of your root lie beside each other along y, where all boxes extend over 2; along x they extend over 91";
        assert_eq!(says, expected);
    }

    #[test]
    fn loose_boxes_cost_work() {
        let mut tree = right();
        tree.nodes[2] = leaf(2, 2, -50.0, 7.0);
        assert_eq!(failed(tree), [Aspect::Work]);
    }
}
