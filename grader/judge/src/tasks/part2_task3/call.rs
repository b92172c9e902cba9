//! One call in words and shown.

use crate::tools::call_text::{few, holding, range_circumstances, ray_and};
use crate::tools::plural;
use crate::tools::shown::{ShownCall, ShownSpans, Span, tree_rows};
use wire::answer::TraverseAnswer;
use wire::work::{Node, NodeKind, ScriptedRay, ScriptedWorld, Tree};

pub(super) fn input(world: &ScriptedWorld, call: usize) -> Option<String> {
    let scripted = world.rays.get(call)?;
    let nodes = plural(world.tree.nodes.len(), "node", "nodes");
    let each = world
        .tree
        .nodes
        .iter()
        .zip(&scripted.spans)
        .enumerate()
        .map(|(at, (node, span))| {
            format!(
                "node {at}: {}",
                self::node(world, node, *span, &scripted.prims)
            )
        });
    let listed = match world.tree.nodes.len() {
        0 => String::new(),
        1..=LISTED_NODES => format!(": {}", each.collect::<Vec<_>>().join("; ")),
        _ => overview(&world.tree),
    };
    Some(ray_and(
        &scripted.ray,
        &format!("a tree of {nodes}{listed}"),
    ))
}

/// The most nodes of a tree that are listed: those of every simple question but the deepest.
const LISTED_NODES: usize = 9;

/// The levels of a tree, in which children come after their parents.
fn levels(tree: &Tree) -> usize {
    let mut level = vec![1; tree.nodes.len()];
    for (at, node) in tree.nodes.iter().enumerate() {
        if let NodeKind::Interior { left, right } = node.kind {
            let below = level[at] + 1;
            for child in [left, right] {
                if let Some(level) = level.get_mut(child as usize) {
                    *level = below;
                }
            }
        }
    }
    level.into_iter().max().unwrap_or(0)
}

/// What is known of a tree that is too large to list: its levels, and whether it is a chain.
fn overview(tree: &Tree) -> String {
    let levels = plural(levels(tree), "level", "levels");
    let is_single_leaf = |at: u32| {
        let node = tree.nodes.get(at as usize);
        node.is_some_and(|node| matches!(node.kind, NodeKind::Leaf { count: 1, .. }))
    };
    let is_chain = tree.nodes.iter().all(|node| match node.kind {
        NodeKind::Interior { right, .. } => is_single_leaf(right),
        NodeKind::Leaf { count, .. } => count == 1,
    });
    let chain = match is_chain {
        true => ", each right child a leaf of one primitive",
        false => "",
    };
    format!(" on {levels}{chain}")
}

/// A node: where the ray is in its box, and its children or where the ray hits its primitives.
fn node(
    world: &ScriptedWorld,
    node: &Node,
    span: Option<[f64; 2]>,
    hits: &[Option<f64>],
) -> String {
    let span = match span {
        Some([from, to]) => format!("box from t = {from:?} to {to:?}"),
        None => "box missed".into(),
    };
    match node.kind {
        NodeKind::Interior { left, right } => format!("{span}, children {left} and {right}"),
        NodeKind::Leaf { first, count } => {
            let order = world.tree.order.iter().skip(first as usize);
            let prims = order
                .take(count as usize)
                .map(|&id| match hits[id as usize] {
                    Some(t) => format!("primitive {id} at t = {t:?}"),
                    None => format!("primitive {id} missed"),
                });
            let prims = few(prims, ", ")
                .unwrap_or_else(|| plural(count as usize, "primitive", "primitives"));
            format!("{span}, {prims}")
        }
    }
}

pub(super) fn circumstances(world: &ScriptedWorld, call: usize) -> Option<Vec<&'static str>> {
    let scripted = world.rays.get(call)?;
    let function = [
        (world.any_hit, "any hit is looked for"),
        (!world.any_hit, "the closest hit is looked for"),
    ];
    Some([holding(&function), range_circumstances(&scripted.ray)].concat())
}

/// Where the ray is in the boxes of the tree and where it hits primitives, and the closest hit.
pub(super) fn shown(
    world: &ScriptedWorld,
    call: usize,
    answers: Option<&Vec<TraverseAnswer>>,
) -> Option<ShownCall> {
    let scripted = world.rays.get(call)?;
    let mut rows = tree_rows(&world.tree, |node| *scripted.spans.get(node)?)?;
    let hits = scripted.prims.iter().enumerate().filter_map(|(id, t)| {
        let t = (*t)?;
        Some(Span {
            ends: [t, t],
            label: id.to_string(),
        })
    });
    rows.push(hits.collect());
    let answer = answers.and_then(|answers| answers.get(call));
    let closest = |t: Option<f64>| t.filter(|_| !world.any_hit);
    Some(ShownCall::Spans(ShownSpans {
        along: "t",
        about: "where the ray is in the boxes; below, its hits",
        rows,
        expected: closest(closest_in_range(scripted)),
        yours: closest(answer.and_then(|answer| Some(answer.hit?.0))),
    }))
}

/// The smallest `t` of a hit in the ray's range.
fn closest_in_range(scripted: &ScriptedRay) -> Option<f64> {
    let range = scripted.ray.min_t..=scripted.ray.max_t;
    let hits = scripted.prims.iter().copied().flatten();
    hits.filter(|t| range.contains(t)).min_by(f64::total_cmp)
}
