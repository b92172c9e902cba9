//! Writes a tree to a snapshot.

use crate::tools::snapshot::{Forms, field, forms, vector};
use wire::work::{NodeKind, Tree};

/// The children or primitives of each node; full lines also have its box.
pub(super) fn nodes(tree: &Tree) -> Vec<Forms> {
    let nodes = tree.nodes.iter();
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
