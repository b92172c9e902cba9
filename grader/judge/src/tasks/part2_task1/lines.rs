//! How a snapshot shows a tree.

use crate::snapshot::{Forms, field, forms, vector};
use wire::work::{NodeKind, Tree};

/// How many nodes of a tree are written: a change of the recipe shows in the first ones, and in
/// their number.
const TREE_LINES: usize = 512;

/// What is below each node; on full lines its box, too.
pub(super) fn nodes(tree: &Tree) -> Vec<Forms> {
    let nodes = tree.nodes.iter().take(TREE_LINES);
    nodes
        .map(|node| {
            let below = match node.kind {
                NodeKind::Interior { left, right } => {
                    field("children", vector(&[left, right].map(f64::from)))
                }
                NodeKind::Leaf { first, count } => {
                    field("leaf", vector(&[first, count].map(f64::from)))
                }
            };
            let [min, max] = node.bounds;
            let full = vec![
                below.clone(),
                field("min", vector(&min)),
                field("max", vector(&max)),
            ];
            forms(Vec::new(), vec![below], full)
        })
        .collect()
}
